#pragma once

#include "diagnose/search/predicted_selection.hpp"

#include <vector>

namespace flexarm::diagnose {

/// Selects effects by output error, in closed loop where runs state their controllers and the loop
/// can be simulated with the arm file. Where that does not leave noise, but does so if numbers of
/// the arm file that state no uncertainty are refitted, by themselves or beside one effect, that is
/// taken: the problem's arm then has uncertainties for them. That is not tried where single effects
/// leave the data out of reach (is_out_of_reach, admission.hpp). Else responses are tried where
/// torques are rich (response_runs.hpp). Else, where the most likely disturbance of the hub torque
/// of the arm that it made is options.least_disturbance or more, effects are also selected by
/// torque balance at the hub, or by a stochastic grey box where a `time` run does not show the
/// hub's motion. Where runs have other sensors too, what acts on beam, payload and sensors is
/// selected by the measured motion before, and the torque balance is for the rest. Of both
/// selections that one is taken with which simulations of validation runs (estimation runs without
/// these) are nearer to the data; where the torque balance names nothing, with the law of hub
/// torque that it shows (empirical_law.hpp), which PredictedSelection::law keeps. After
/// options.deadline that by output error, unless the other names a cause.
///
/// With options.predictor by that one; throws InputError where it cannot be formed, or no run has a
/// controller for it.
PredictedSelection select_by_evidence(const Experiment& experiment,
                                      const std::vector<Hypothesis>& hypotheses,
                                      const SelectionOptions& options,
                                      const DiagnosisProgress& progress);

}  // namespace flexarm::diagnose
