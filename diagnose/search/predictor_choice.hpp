#pragma once

#include "diagnose/search/selection.hpp"

#include <string>
#include <vector>

namespace flexarm::diagnose {

/// A selection with the predictor of `time` runs that it was made by, and why by that one.
struct PredictedSelection {
  Selection selection;
  PredictorKind predictor = PredictorKind::output_error;
  std::string reason;  ///< a sentence; empty without `time` runs
  /// The torque balance, where one was formed: with the noise of what was selected by it.
  std::optional<Problem> balance = {};
  /// By simulation, the noise of its channels as the selection by simulation left it: what
  /// simulations are compared with the data by.
  Problem simulated;
};

/// Selects effects by output error, in closed loop where runs state their controllers and the loop
/// can be simulated with the arm file. Where that does not leave noise, but does so if numbers of
/// the arm file that state no uncertainty are refitted, by themselves or beside one effect, that is
/// taken: the problem's arm then has uncertainties for them. Else, where the most likely
/// disturbance of the hub torque of the arm that it made is options.least_disturbance or more,
/// effects are also selected by torque balance at the hub, or by a stochastic grey box where a
/// `time` run does not show the hub's motion. Of both selections that one is taken with which
/// simulations of validation runs (estimation runs without these) are nearer to the data. After
/// options.deadline that by output error, unless the other names a cause.
///
/// With options.predictor by that one; throws InputError where it cannot be formed, or no run has a
/// controller for it.
PredictedSelection select_by_evidence(const Experiment& experiment,
                                      const std::vector<Hypothesis>& hypotheses,
                                      const SelectionOptions& options,
                                      const DiagnosisProgress& progress);

}  // namespace flexarm::diagnose
