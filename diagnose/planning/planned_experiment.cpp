#include "diagnose/planning/planned_experiment.hpp"

#include "arm/input_error.hpp"
#include "diagnose/search/fit.hpp"
#include "diagnose/search/hypothesis.hpp"

#include <Eigen/QR>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>

namespace flexarm::diagnose {

namespace {

using Eigen::Index;

/// Inner steps a sample with forces that are not linear: both of two arms that are compared are
/// A damping ratio below this is not measured better than this.
constexpr double kLeastDampingRatio = 1e-3;

measured::RunData skeleton_of(const PlannedRun& run) {
  if (run.kind == measured::RunKind::time) {
    measured::TimeRecord record;
    record.torque_N_m = torque_of(run);
    for (std::size_t k = 0; k < record.torque_N_m.size(); ++k) {
      record.time_s.push_back(static_cast<double>(k) * run.sample_time_s);
    }
    for (const auto& sensor : run.sensors) {
      record.channels.push_back({sensor.sensor, std::vector<double>(record.time_s.size())});
    }
    return record;
  }
  if (run.kind == measured::RunKind::frf) {
    measured::FrequencyRecord record;
    const std::vector<double> frequencies = frequencies_of(run);
    for (const auto& sensor : run.sensors) {
      record.channels.push_back({sensor.sensor, frequencies,
                                 std::vector<std::complex<double>>(frequencies.size(), 1.0),
                                 std::vector<double>(frequencies.size(), 1.0)});
    }
    return record;
  }
  measured::ModalTable table;
  for (int k = 1; k <= run.poles; ++k) {
    table.push_back({{}, measured::Feature::pole, k, 1.0, {}, 0.0, {}});
  }
  for (const auto& sensor : run.sensors) {
    for (int k = 1; k <= sensor.zeros; ++k) {
      table.push_back({sensor.sensor, measured::Feature::zero, k, 1.0, {}, 0.0, {}});
    }
  }
  return table;
}

Experiment experiment_of(const arm::Arm& arm, const std::vector<PlannedRun>& runs,
                         std::string& notice) {
  Experiment experiment;
  experiment.arm = arm;
  for (const PlannedRun& run : runs) {
    for (const PlannedSensor& sensor : run.sensors) {
      try {
        arm::require_valid(sensor.sensor, arm);
      } catch (const arm::InputError& error) {
        throw arm::InputError(fmt::format("run {}: {}", run.id, error.what()));
      }
    }
    measured::MeasuredRun planned;
    planned.run.id = run.id;
    planned.run.kind = run.kind;
    planned.run.purpose = run.purpose;
    planned.run.payload = run.payload;
    planned.run.torque_hold = run.torque_hold;
    planned.data = skeleton_of(run);
    experiment.runs.push_back(std::move(planned));
  }
  const std::string split = split_purposes(experiment.runs);
  if (experiment.runs.size() > 1) notice = split;
  return experiment;
}

/// These effects where they do nothing.
Candidate nothing_of(const std::vector<std::string>& names, const Experiment& experiment) {
  const std::vector<Hypothesis> possible = hypotheses(experiment);
  Candidate made;
  for (const std::string& name : names) {
    const auto at = std::ranges::find(possible, name, &Hypothesis::effect);
    if (at == possible.end() || at->parameters.size() != 1 ||
        !at->parameters[0].neutral_coordinate()) {
      throw arm::InputError(fmt::format(
          "{}: cannot be a nuisance parameter: no influence on these runs, or no parameter of size",
          name));
    }
    const SearchedParameter& parameter = at->parameters[0];
    made = made.with(*at, {parameter.value(*parameter.neutral_coordinate())});
  }
  return made;
}

/// The relative noise of a channel.
double noise_of(const PlannedRun& run, const std::string& channel) {
  for (const PlannedSensor& sensor : run.sensors) {
    const std::string name = arm::to_string(sensor.sensor);
    if (channel == name || channel == name + " zero") return sensor.noise;
  }
  return run.noise;  // of poles
}

}  // namespace

PlannedExperiment::PlannedExperiment(const arm::Arm& arm, std::vector<PlannedRun> runs,
                                     const std::vector<std::string>& unknown)
    : experiment_(experiment_of(arm, runs, notice_)),
      runs_(std::move(runs)),
      layout_(observe(experiment_)),
      as_described_(problem_of_the_arm()),
      unknowns_(nothing_of(unknown, experiment_)) {
  if (unknown.empty()) return;
  const Eigen::MatrixXd jacobian = fit(as_described_, unknowns_, {.most_steps = 0}).jacobian;
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(jacobian);
  taken_ = Eigen::MatrixXd::Identity(jacobian.rows(), qr.rank());
  taken_ = qr.householderQ() * taken_;
}

std::optional<Eigen::VectorXd> PlannedExperiment::change_by(const Candidate& candidate) const {
  auto change = as_described_.residuals(candidate, as_described_.estimation_runs());
  if (!change) return change;
  *change = -*change;
  if (taken_.cols() > 0) *change -= taken_ * (taken_.transpose() * *change);
  return change;
}

Problem PlannedExperiment::problem_of_the_arm() {
  for (ObservedChannel& channel : layout_.channels) {
    channel.noise = noise_of(runs_[channel.run], channel.sensor);
    channel.logarithmic = false;  // what effects change is to add up
  }
  options_ = {.flexible_modes = modes_needed(experiment_, layout_).flexible_modes};
  const Predictor predict(experiment_, layout_, *options_.flexible_modes);
  const auto values = predict(experiment_.arm, std::vector<bool>(experiment_.runs.size(), true));
  fill_in(values);
  return problem(values);
}

void PlannedExperiment::fill_in(const Eigen::VectorXd& values) {
  std::vector<std::size_t> next(experiment_.runs.size(), 0);  // channel of a run
  for (const ObservedChannel& channel : layout_.channels) {
    auto* record = std::get_if<measured::TimeRecord>(&experiment_.runs[channel.run].data);
    if (record == nullptr) continue;
    const auto part = values.segment(channel.first, channel.count);
    record->channels[next[channel.run]++].values.assign(part.begin(), part.end());
  }
}

Problem PlannedExperiment::problem(const Eigen::VectorXd& values) const {
  return {experiment_, observations(values), options_};
}

Observations PlannedExperiment::observations(const Eigen::VectorXd& values) const {
  Observations made = layout_;
  made.values = values;
  for (const ObservedChannel& channel : made.channels) {
    const auto part = values.segment(channel.first, channel.count);
    auto deviations = made.deviations.segment(channel.first, channel.count);
    const measured::RunKind kind = experiment_.runs[channel.run].run.kind;
    if (kind == measured::RunKind::time) {
      const double variance =
          (part.array() - part.mean()).square().sum() / static_cast<double>(channel.count);
      deviations.setConstant(channel.noise * std::sqrt(variance));
    } else if (kind == measured::RunKind::frf) {
      for (Index k = 0; k + 1 < channel.count; k += 2) {
        deviations.segment(k, 2).setConstant(channel.noise * std::hypot(part(k), part(k + 1)));
      }
    } else {
      // Frequencies and damping ratios in turn.
      for (Index k = 0; k + 1 < channel.count; k += 2) {
        deviations(k) = channel.noise * part(k);
        deviations(k + 1) =
            runs_[channel.run].damping_noise * std::max(std::abs(part(k + 1)), kLeastDampingRatio);
      }
    }
    deviations = deviations.cwiseMax(std::numeric_limits<double>::min());
  }
  return made;
}

}  // namespace flexarm::diagnose
