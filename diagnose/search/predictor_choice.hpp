#pragma once

#include "diagnose/search/selection.hpp"

#include <optional>
#include <string>
#include <vector>

namespace flexarm::diagnose {

/// A selection with the predictor of `time` runs that it was made by, and why by that one.
struct PredictedSelection {
  Selection selection;
  PredictorKind predictor = PredictorKind::output_error;
  std::string reason;  ///< a sentence; empty without `time` runs
  /// By output error, the noise of its channels as the selection by output error left it: what
  /// simulations are compared with the data by.
  Problem simulated;
};

/// Selects effects by output error and, where that does not leave noise, by torque balance at the
/// hub, or by a stochastic grey box where a `time` run does not show the hub's motion: if the most
/// likely disturbance of the hub torque of the arm that output error made is
/// options.least_disturbance or more. With options.predictor by that one; throws InputError where
/// no Kalman filter can be formed for it. After options.deadline by output error, unless another
/// had been asked for or names a cause.
PredictedSelection select_by_evidence(const Experiment& experiment,
                                      const std::vector<Hypothesis>& hypotheses,
                                      const SelectionOptions& options,
                                      const DiagnosisProgress& progress);

}  // namespace flexarm::diagnose
