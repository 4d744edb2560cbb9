#pragma once

#include "response/frequency/frequency_grid.hpp"
#include "response/frequency/frequency_response.hpp"
#include "response/frequency/resonance.hpp"
#include "response/frequency/transfer_forms.hpp"
#include "response/state_space.hpp"
#include "response/truncation.hpp"

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace flexarm::response {

/// What `study_response` is asked.
struct ResponseOptions {
  std::vector<arm::Sensor> sensors;
  int modes = 5;  ///< flexible poles, and zeros of each sensor
  /// Flexible modes of the state space; empty: chosen for the frequencies
  /// (response/truncation.hpp).
  std::optional<int> state_space_modes = {};
  std::optional<double> from_Hz;     ///< empty: well below the first pole
  std::optional<double> to_Hz;       ///< empty: midway between the last pole and the next
  int points = 400;                  ///< of the logarithmic grid that is refined
  std::vector<double> frequency_Hz;  ///< in place of the grid unless empty
  bool state_space = false;
  bool static_correction = true;  ///< a residual mode in the state space
  /// Is called with the fraction of the frequency responses that is computed, in (0, 1].
  std::function<void(double fraction)> progress = {};
};

/// The linear response of an arm from commanded torque to its sensors' readings.
struct ResponseStudy {
  std::vector<std::string> left_out;  ///< nonlinear effects of the arm
  LinearChain chain;                  ///< with the chains of sensors that are among `sensors`
  arm::PoleSet poles;
  arm::DampedPoleSet damped_poles;
  arm::ModalModel modes;                                ///< without residual mode
  std::vector<ProductFactors> products;                 ///< one a sensor
  std::vector<std::vector<PartialFraction>> fractions;  ///< one list a sensor
  FrequencyResponse response;
  std::vector<std::vector<Resonance>> resonances;  ///< one list a sensor
  std::optional<StateSpace> state_space;
  bool residual_mode = false;            ///< the state space has one
  std::optional<Truncation> truncation;  ///< of the state space
  std::optional<FrequencyResponse> state_space_response;
};

/// Upper bound of the poles and zeros at which a grid is refined.
inline constexpr int kMostFeatures = 200;

/// How many roots a formulation has to be fine enough for: the modes and one more, and those up to
/// the highest frequency by lambda_n ~ (n + 1/4) pi of the plain arm, and a few.
int roots_needed(const arm::Arm& arm, const ResponseOptions& options);

/// The frequencies of `options`: those given, or the range from well below the first pole to above
/// the last of options.modes poles. Throws InputError for counts that cannot be used.
FrequencyGrid frequency_range(const AnyFormulation& formulation, const ResponseOptions& options);

/// `formulation` is of the linear part of `arm`, whose other effects are looked up here: the linear
/// ones of actuator and sensor are in the response and the state space, the others named.
/// Throws InputError for sensors, counts, limits and frequencies that cannot be used.
ResponseStudy study_response(const arm::Arm& arm, const AnyFormulation& formulation,
                             const ResponseOptions& options);

/// |G_ss - G|/|G| of a state space over the frequencies.
struct StateSpaceError {
  double largest = 0.0;
  double largest_at_Hz = 0.0;
  double median = 0.0;
};

/// One a sensor; empty without state space.
std::vector<StateSpaceError> state_space_errors(const ResponseStudy& study);

}  // namespace flexarm::response
