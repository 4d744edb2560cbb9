#pragma once

#include "measured/files/text_lines.hpp"

#include <optional>
#include <span>
#include <string_view>

namespace flexarm::measured {

/// Start and period of the samples of a file without a column of times, as its head tells them.
struct SamplingSettings {
  double start_s = 0.0;
  std::optional<double> period_s;
  int line = 0;  ///< that tells the period
};

/// Reads the settings in the lines in front of the samples: `Sample Interval,0.002,s`, `Sampling
/// rate: 500 Hz`, `XINCR = 2e-3`, `t0 = -0.1, tInc = 0.002`, in s or Hz where no unit is told.
SamplingSettings sampling_settings(std::span<const TextLine> lines, char separator, char decimal);

/// Whether the words, without their unit, name the period of the samples: "Increment", "Delta_X".
bool is_period_name(std::string_view words);
/// "Start", "X0", "t0".
bool is_start_name(std::string_view words);

}  // namespace flexarm::measured
