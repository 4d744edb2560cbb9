#pragma once

#include "arm/arm.hpp"

#include <span>
#include <string>
#include <vector>

namespace flexarm::diagnose {

/// A stretch of frequencies, `from_Hz` belongs to it and `to_Hz` does not.
struct FrequencyBand {
  std::string name;  ///< "below mode 1", "around mode 2", "above mode 4"
  double from_Hz = 0.0;
  double to_Hz = 0.0;
};

/// The bands from 0 to `top_Hz` that the arm's flexible modes divide: around each of the lowest
/// `kMostBandModes` below the top, meeting at geometric means of neighbours, with half an octave to
/// the outer sides; what is below and what is above. One band where no mode is below the top.
std::vector<FrequencyBand> frequency_bands(const arm::Arm& arm, double top_Hz);
inline constexpr int kMostBandModes = 4;

/// Mean square of samples `period_s` apart in each band, from a Hann-windowed periodogram;
/// together the mean square of what does not grow or fall over the record. The bands begin at 0 and
/// follow each other.
struct BandPower {
  double mean_square = 0.0;
  double lines = 0.0;  ///< of the transform, complex ones
};
std::vector<BandPower> band_powers(std::span<const double> samples, double period_s,
                                   std::span<const FrequencyBand> bands);

}  // namespace flexarm::diagnose
