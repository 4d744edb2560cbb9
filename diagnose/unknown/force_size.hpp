#pragma once

#include "diagnose/unknown/tried_places.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace flexarm::diagnose {

/// A third octave of a force's spectrum: mean of the runs' mean squares on lines in [from_Hz,
/// to_Hz).
struct ForceBand {
  double from_Hz = 0.0;
  double to_Hz = 0.0;
  double mean_square = 0.0;              ///< less that of noise, which may leave a value below 0
  std::optional<double> std_error = {};  ///< by the spread of the segments; empty for one

  double rms() const { return rms_at(0.0); }
  /// Root of the mean square plus so many of its standard errors, 0 where that is below 0.
  double rms_at(double std_errors) const;
};

/// How large a force is, by the lines on which a sensor is beyond noise.
struct ForceSize {
  std::string unit;
  double rms = 0.0;                      ///< mean of the runs' mean squares
  std::optional<double> std_error = {};  ///< by the spread of the segments; empty for one
  double from_Hz = 0.0;                  ///< a tenth of its mean square is below,
  double to_Hz = 0.0;                    ///< and a tenth above
  std::vector<ForceBand> spectrum = {};  ///< ascending, bands without a line left out
};

/// Of the force that a place would have. The limits of bands are 10^((2 n + 1)/20) Hz.
ForceSize force_size(const TriedPlaces& tried, std::size_t place);

}  // namespace flexarm::diagnose
