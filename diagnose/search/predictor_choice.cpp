#include "diagnose/search/predictor_choice.hpp"

#include "arm/input_error.hpp"
#include "diagnose/predictors/noise_estimate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

namespace flexarm::diagnose {

namespace {

bool has_time_runs(const Problem& problem) {
  const auto& runs = problem.experiment().runs;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    if (problem.estimation_runs()[r] && runs[r].run.kind == measured::RunKind::time) return true;
  }
  return false;
}

}  // namespace

PredictedSelection select_by_evidence(const Experiment& experiment,
                                      const std::vector<Hypothesis>& hypotheses,
                                      const SelectionOptions& options,
                                      const DiagnosisProgress& progress) {
  const Problem problem(experiment);
  if (!has_time_runs(problem)) {
    return {select(problem, hypotheses, options, progress), PredictorKind::output_error, "",
            problem};
  }
  // Which predictor it will be is not known before the first half is done.
  const auto half = [&progress](double from) {
    return [&progress, from](std::string_view what, double done) {
      return !progress || progress(what, from + 0.5 * done);
    };
  };
  PredictedSelection made{select(problem, hypotheses, options, half(0.0)),
                          PredictorKind::output_error, "", problem};
  made.simulated = made.selection.problem;
  if (made.selection.cancelled || options.predictor == PredictorKind::output_error) {
    made.reason = "as asked for";
    return made;
  }
  const bool is_asked = options.predictor == PredictorKind::grey_box;
  if (!is_asked && made.selection.chosen.leaves_noise()) {
    made.reason = "its residuals are noise";
    return made;
  }
  const DiagnosisProgress second_half = half(0.5);
  const ReportedWork work(second_half);
  const NoiseEstimator estimator(experiment, made.simulated.observations(),
                                 made.simulated.predictor(), [&work] { work.go_on(); });
  const auto likely_noise = [&](const arm::Arm& arm) {
    return estimator.model(arm, made.simulated.estimation_runs()).model;
  };
  try {
    const arm::Arm extended = made.selection.chosen.fit.candidate.extend(experiment.arm);
    const double least_N_m = options.least_disturbance * estimator.torque_rms_N_m();
    if (!is_asked && likely_noise(extended).disturbance_N_m <= least_N_m) {
      made.reason = "an unrecorded torque on the hub explains little of what it leaves";
      return made;
    }
    // The search begins with the arm as filed: what output error named may be wrong.
    const NoiseModel noise = likely_noise(experiment.arm);
    Problem filtered(
        experiment, made.simulated.observations(),
        {.flexible_modes = made.simulated.predictor().flexible_modes(), .noise = noise});
    made.selection = select(std::move(filtered), hypotheses, options, second_half);
    made.predictor = PredictorKind::grey_box;
    made.reason = is_asked ? "as asked for"
                           : fmt::format(
                                 "by output error the residuals are not noise; an "
                                 "unrecorded hub torque of {:.3g} N m makes them more "
                                 "likely",
                                 noise.disturbance_N_m);
  } catch (const Cancelled&) {
    made.selection.cancelled = true;
  } catch (const arm::InputError&) {
    made.reason = "no Kalman filter can be formed for the arm as filed";
  }
  return made;
}

}  // namespace flexarm::diagnose
