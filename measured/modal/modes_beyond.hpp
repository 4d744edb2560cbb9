#pragma once

#include "measured/modal/start_spectra.hpp"
#include "measured/modal/variable_projection.hpp"

namespace flexarm::measured {

/// Blocks with held ones for the modes that a fit has none for, and what is known of these.
struct ModesBeyond {
  BlockSet blocks;
  ColumnChoices choices;
};

/// Modes beyond the band are there, whether data show them or not, and zeros are where all modes
/// together come to nothing. A fit that leaves out those which the noise hides states errors as if
/// they were not there: too small by any factor. So kHeldAt blocks stand for them beyond the band,
/// whose coefficients are 0 give or take what modes there may have (stochastic embedding
/// [GoodwinGeversNinness1992]). Where data tell more than that they
/// are fitted; where not, they widen what hangs on them.
///
/// Give or take: coefficients of displacement b0 over the power of omega that they grow with in a
/// beam are as large as those of the band's blocks in root mean square, sensor by sensor.
///
/// Of a fit without a block in the band, no held ones.
ModesBeyond with_modes_beyond(const BlockFit& fit, const ColumnChoices& choices,
                              const FitBand& band);

/// Over the upper end of the band; modes of a beam are about as far apart.
inline constexpr double kHeldAt[] = {1.3, 2.0, 3.0, 4.5, 7.0, 10.5, 16.0};
/// Heavy enough not to ring at samples, light enough to answer in phase within the band.
inline constexpr double kHeldDamping = 0.05;

}  // namespace flexarm::measured
