#pragma once

#include "diagnose/search/predicted_selection.hpp"

#include <vector>

namespace flexarm::diagnose {

/// Selects effects by the predictor of `time` runs that the data ask for:
///
/// - a stochastic grey box with noise of the recorded torques, where these show some and that
///   leaves noise beside no effect;
/// - else output error, in closed loop where runs state their controllers and the loop can be
///   simulated with the arm file; where effects are found that do not leave noise, again with noise
///   of the recorded torques beside these effects;
/// - where it supports no effect, or what it finds leaves half of the signal: responses, where
///   torques are rich (response_runs.hpp); then a torque balance at the hub, or, where a run does
///   not show the hub's motion and the most likely disturbance of the hub torque is
///   options.least_disturbance or more, a stochastic grey box. That is taken where it leaves less
///   of the torque of validation runs (estimation runs without these) than a simulation leaves of
///   their signals, or where its effects simulate them better; where it names nothing, with the law
///   of hub torque that it shows (empirical_law.hpp), which PredictedSelection::law keeps;
/// - where a simulation of the arm as filed runs away, the torque balance before it: the search by
///   simulation begins with its effects. Of an arm without a beam the balance shows all, so that
///   its effects are the result where the validation runs support one, and it leaves less than the
///   torque itself.
///
/// With options.predictor by that one; throws InputError where it cannot be formed, or no run has a
/// controller for it.
PredictedSelection select_by_evidence(const Experiment& experiment,
                                      const std::vector<Hypothesis>& hypotheses,
                                      const SelectionOptions& options,
                                      const DiagnosisProgress& progress);

}  // namespace flexarm::diagnose
