#include "diagnose/search/predictor_choice.hpp"

#include "arm/input_error.hpp"
#include "diagnose/predictors/noise_estimate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

namespace flexarm::diagnose {

namespace {

/// Flexible modes of a Kalman filter <= this. What leaves no noise by output error is wrong by more
/// than the modes beyond.
constexpr int kMostFilteredModes = 6;

constexpr const char* kNoTime = "the time limit left no time for another";

bool has_time_runs(const Problem& problem) {
  const auto& runs = problem.experiment().runs;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    if (problem.estimation_runs()[r] && runs[r].run.kind == measured::RunKind::time) return true;
  }
  return false;
}

bool shows_hub(const measured::TimeRecord& record) {
  return std::ranges::any_of(record.channels, [](const auto& channel) {
    return channel.sensor.kind == arm::SensorKind::hub_angle ||
           channel.sensor.kind == arm::SensorKind::hub_velocity;
  });
}

/// What a hub sensor shows is the motion that the torque is balanced for, so that the balance does
/// not judge that sensor.
bool is_on_hub_sensor(const Hypothesis& hypothesis) {
  return hypothesis.sensor == "hub_angle" || hypothesis.sensor == "hub_velocity";
}

/// Of the predictors with a noise model: torque balance where each `time` run shows the hub.
PredictorKind filtering_predictor(const Experiment& experiment, const SelectionOptions& options) {
  if (options.predictor) return *options.predictor;
  const bool is_seen = std::ranges::all_of(experiment.runs, [](const auto& run) {
    const auto* record = std::get_if<measured::TimeRecord>(&run.data);
    return record == nullptr || shows_hub(*record);
  });
  return is_seen ? PredictorKind::torque_balance : PredictorKind::grey_box;
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
  const bool is_asked = options.predictor && options.predictor != PredictorKind::output_error;
  PredictedSelection made{Selection{problem}, PredictorKind::output_error, "", problem};
  // Which predictor it will be is not known before the first half is done.
  const auto half = [&progress](double from) {
    return [&progress, from](std::string_view what, double done) {
      return !progress || progress(what, from + 0.5 * done);
    };
  };
  if (!is_asked) {
    made.selection = select(problem, hypotheses, options, half(0.0));
    made.simulated = made.selection.problem;
    if (made.selection.end) {
      made.reason = kNoTime;
      return made;
    }
    if (made.selection.cancelled || options.predictor == PredictorKind::output_error) {
      made.reason = "as asked for";
      return made;
    }
    if (made.selection.chosen.leaves_noise()) {
      made.reason = "its residuals are noise";
      return made;
    }
  }
  const DiagnosisProgress second_half = is_asked ? progress : half(0.5);
  ReportedWork work(second_half, options.deadline);
  const int modes = std::min(kMostFilteredModes, made.simulated.predictor().flexible_modes());
  const Problem unfiltered = made.simulated.with_modes(modes);
  const NoiseEstimator estimator(experiment, unfiltered.observations(), unfiltered.predictor(),
                                 [&work] { work.go_on(); });
  const auto likely_noise = [&](const arm::Arm& arm) {
    return estimator.model(arm, unfiltered.estimation_runs()).model;
  };
  const auto end_by_output_error = [&made](SearchEnd end) {
    made.predictor = PredictorKind::output_error;
    made.reason = kNoTime;
    made.selection.end = std::move(end);
  };
  try {
    work.tell("the noise of a Kalman filter", 0.0);
    const arm::Arm extended = made.selection.chosen.fit.candidate.extend(experiment.arm);
    const double least_N_m = options.least_disturbance * estimator.torque_rms_N_m();
    if (!is_asked && likely_noise(extended).disturbance_N_m <= least_N_m) {
      made.reason = "an unrecorded torque on the hub explains little of what it leaves";
      return made;
    }
    // The search begins with the arm as filed: what output error named may be wrong.
    NoiseModel noise = likely_noise(experiment.arm);
    made.predictor = filtering_predictor(experiment, options);
    if (made.predictor == PredictorKind::torque_balance) {
      noise.balance_unit_N_m = estimated_disturbance_N_m(
          unfiltered.predictor(), experiment.arm, unfiltered.estimation_runs(), noise);
    }
    Problem filtered(experiment, unfiltered.observations(),
                     {.flexible_modes = modes, .noise = noise});
    std::vector<Hypothesis> searched = hypotheses;
    if (made.predictor == PredictorKind::torque_balance) std::erase_if(searched, is_on_hub_sensor);
    Selection selection = select(std::move(filtered), searched, options, second_half);
    if (selection.end && !is_asked && selection.chosen.fit.candidate.effects.empty()) {
      end_by_output_error(*selection.end);
      return made;
    }
    made.selection = std::move(selection);
    made.reason = "as asked for";
    if (!is_asked) {
      made.reason = fmt::format(
          "by output error the residuals are not noise; an unrecorded hub torque of {:.3g} N m "
          "makes them more likely",
          noise.disturbance_N_m);
    }
  } catch (const Cancelled&) {
    if (work.is_out_of_time()) {
      if (is_asked) made.selection = select(problem, hypotheses, options, progress);
      end_by_output_error({std::string(work.what()), {}});
    } else {
      made.selection.cancelled = true;
    }
  } catch (const arm::InputError& error) {
    if (is_asked) throw;
    made.predictor = PredictorKind::output_error;
    made.reason = fmt::format("no Kalman filter can be formed ({})", error.what());
  }
  return made;
}

}  // namespace flexarm::diagnose
