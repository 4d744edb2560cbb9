#pragma once

#include "measured/modal/variable_projection.hpp"

#include <complex>
#include <vector>

namespace flexarm::measured {

/// A sensor's residue at a complex pole, as that of a displacement: (b1 p + b0)/(2 i Im p). Of a
/// mode whose shape is real it is nearly imaginary, and at the hub b0/(2 i omega) with b0 above 0.
struct FittedResidue {
  std::complex<double> value;
  double weight = 0.0;  ///< square of its signal-to-noise ratio
  int derivatives = 0;  ///< that the sensor shows
  bool hub = false;
};

/// One a sensor; `pole` is that of the block with Im > 0.
std::vector<FittedResidue> fitted_residues(const BlockFit& fit, std::size_t block,
                                           std::complex<double> pole);

/// Square of the sine of a residue's angle to the imaginary axis; 1 for a hub's of the wrong sign.
double turn_squared(std::complex<double> residue, bool hub);

/// How far a complex pole's residues stand off the imaginary axis, a delay of `delay_s` taken off:
/// root mean square over the sensors of the sine of their angle to it, weighted by what each knows
/// of them. Small for a mode whose shape is real, near 0.7 for a block that stands for several
/// others; 0 for real poles.
double residue_turn(const BlockFit& fit, std::size_t block, double delay_s);

/// How much later than the torque all sensors answer, by how far their residues are turned:
/// exp(-p delay) at every pole p. `blocks` are those of modes. 0 where they are turned by less than
/// kTurnOfDelay (root mean square over the modes) or no delay up to kLongestDelay_s takes it below,
/// and of fewer than two modes. A lag of the torque is found as a delay like it.
double residue_delay_s(const BlockFit& fit, const std::vector<std::size_t>& blocks);
inline constexpr double kTurnOfDelay = 0.15;
inline constexpr double kLongestDelay_s = 0.1;

}  // namespace flexarm::measured
