#pragma once

#include "diagnose/experiment.hpp"

#include <optional>

namespace flexarm::diagnose {

/// The experiment with the frequency responses of its `time` runs in their place, as `flexarm
/// identify` estimates them; `frf` and `modal` runs stay. A channel is left out whose torque is not
/// rich enough: fewer than `kLeastLines` lines with a standard deviation of `kLargestLineError` or
/// less, or lines that span less than `kLeastSpan` in frequency. A run without a channel is left
/// out.
///
/// Empty where no `time` run for estimation is left, and where all that are for validation are left
/// out.
std::optional<Experiment> as_responses(const Experiment& experiment);
inline constexpr int kLeastLines = 40;
inline constexpr double kLargestLineError = 0.1;  ///< relative
inline constexpr double kLeastSpan = 10.0;        ///< highest over lowest frequency

}  // namespace flexarm::diagnose
