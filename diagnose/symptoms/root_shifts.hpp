#pragma once

#include "diagnose/symptoms/symptom.hpp"
#include "diagnose/symptoms/symptoms_input.hpp"

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace flexarm::diagnose {

/// A natural frequency or a damping ratio of a pole or zero, measured beside simulated.
struct RootNumber {
  double measured = 0.0;
  double std_error = 0.0;
  double before = 0.0;  ///< simulated without causes
  double after = 0.0;   ///< with them

  double deviates() const { return (measured - before) / std_error; }
  /// NaN where the baseline has none.
  double shift_percent() const {
    return before == 0.0 ? std::numeric_limits<double>::quiet_NaN()
                         : 100.0 * (measured - before) / before;
  }
};

/// A pole, or a zero of one sensor, of one run.
struct RootShift {
  std::string run;
  double payload_kg = 0.0;
  std::optional<arm::Sensor> zero_of;  ///< empty: a pole
  int order = 1;
  std::optional<RootNumber> frequency_Hz;
  std::optional<RootNumber> damping_ratio;
};

/// Of `modal` runs as their tables have them, of `frf` runs by a rational fit of the measured
/// responses (measured/modal/modal_fit.hpp), weighted as they are in the diagnosis; a run whose fit
/// fails is left out. Standard errors of a fit are never below `kFitFrequency`, `kFitDamping` of
/// the number: what other blocks than the fitted ones would make of it. Runs in time are not
/// fitted.
std::vector<RootShift> root_shifts(const SymptomsInput& input);
inline constexpr double kFitFrequency = 2e-4;
inline constexpr double kFitDamping = 5e-3;

/// What all together say: on which side of the root the cause is. Then what moved and what did not,
/// in standard deviations and per cent, a statement for the poles and one for the zeros of each
/// sensor.
std::vector<Symptom> root_symptoms(const std::vector<RootShift>& shifts);

}  // namespace flexarm::diagnose
