#pragma once

#include "diagnose/search/problem.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace flexarm::diagnose {

/// How far a channel is from what was predicted of it so many samples before: root mean square over
/// the standard deviation of the signal.
struct PredictionError {
  std::string run;
  std::string sensor;
  /// Empty for a simulation of the whole run from its initial state.
  std::optional<std::size_t> samples_ahead = {};
  double ahead_s = 0.0;  ///< 0 for a simulation
  double before = 0.0;   ///< by the arm file; infinite for an arm that cannot be computed
  double after = 0.0;    ///< by the extended arm, likewise
};

/// Errors of predictions k samples ahead on the judged `time` runs of a problem with a noise model,
/// channel by channel. At regular instants, `kMostStarts` of a run or fewer, a free simulation
/// begins in the state of the Kalman filter; the recorded torque drives it, and the filter's
/// disturbance of the hub torque decays with its correlation time. With k = 1 its errors are the
/// filter's innovations. k is each of `kSamplesAhead` up to half of the run.
std::vector<PredictionError> prediction_errors(const Problem& filtered, const arm::Arm& before,
                                               const arm::Arm& after);
inline constexpr std::array<std::size_t, 3> kSamplesAhead = {1, 10, 100};
inline constexpr std::size_t kMostStarts = 400;

}  // namespace flexarm::diagnose
