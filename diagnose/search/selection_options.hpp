#pragma once

#include "diagnose/search/candidate.hpp"
#include "diagnose/search/policy.hpp"
#include "diagnose/search/reported_work.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace flexarm::diagnose {

/// How `time` runs are predicted (predictors/predictor.hpp); closed_loop is output error with the
/// controllers of the runs simulated too. frequency_response compares the responses that are
/// estimated of the runs (predictors/response_runs.hpp).
enum class PredictorKind {
  output_error,
  closed_loop,
  grey_box,
  torque_balance,
  driven_by_motion,
  frequency_response
};
inline constexpr std::array kPredictors = {
    PredictorKind::output_error,     PredictorKind::closed_loop,
    PredictorKind::grey_box,         PredictorKind::torque_balance,
    PredictorKind::driven_by_motion, PredictorKind::frequency_response};

/// Runs are simulated in time, without a noise model.
constexpr bool is_simulation(PredictorKind kind) {
  return kind == PredictorKind::output_error || kind == PredictorKind::closed_loop ||
         kind == PredictorKind::driven_by_motion;
}

/// "grey_box".
constexpr std::string_view to_string(PredictorKind kind) {
  switch (kind) {
    case PredictorKind::output_error:
      return "output_error";
    case PredictorKind::closed_loop:
      return "closed_loop";
    case PredictorKind::grey_box:
      return "grey_box";
    case PredictorKind::torque_balance:
      return "torque_balance";
    case PredictorKind::driven_by_motion:
      return "driven_by_motion";
    case PredictorKind::frequency_response:
      return "frequency_response";
  }
  return "";
}

/// How effects are selected.
struct SelectionOptions {
  /// Causes named <= this; any number unless given.
  std::optional<int> most_causes = {};
  /// Chosen by evidence (predictor_choice.hpp) unless given.
  std::optional<PredictorKind> predictor = {};
  Policy policy = {};
  /// Sets that the search begins with, beside the arm as filed.
  std::vector<Candidate> starts = {};
  /// A filter is tried where what output error leaves is a disturbance of the hub torque >= this
  /// part of the commanded torque's root mean square.
  double least_disturbance = 0.03;
  /// Samples of each run that a filter follows <= this: it is decimated for that.
  std::size_t filtered_samples = 4000;

  /// The search ends here with the best so far.
  Deadline deadline = {};
  /// Where not even the arm as filed has been simulated by then, Cancelled is thrown.
  Deadline last = {};

  /// Standard errors that are stated include the shift of the estimate by so many modes more
  /// (parameter_errors.hpp).
  int further_modes = 8;

  // Sampling jitter of the torque (torque_timing.hpp) is a nuisance.
  /// It is looked into where the excess residual relative to the signal <= this,
  double largest_timing_error = 0.03;
  /// and corrected where the residual is noise after that, and it explains >= this part of the
  /// excess residual.
  double least_timing_share = 0.5;
};

}  // namespace flexarm::diagnose
