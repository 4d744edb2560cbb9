#include "diagnose/predictors/predictor.hpp"

#include "diagnose/predictors/predicted_roots.hpp"
#include "response/formulation_maker.hpp"
#include "response/frequency/frequency_response.hpp"
#include "response/time/time_model.hpp"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>

namespace flexarm::diagnose {

namespace {

using Eigen::Index;

std::vector<arm::Sensor> sensors_of(const measured::TimeRecord& record) {
  std::vector<arm::Sensor> sensors;
  for (const auto& channel : record.channels) sensors.push_back(channel.sensor);
  return sensors;
}

/// What a run from an unknown state shows, `simulated` from rest being known: its state is that
/// which brings the readings nearest to those `measured`, in standard deviations. With forces that
/// are not linear by Gauss-Newton steps, with the linear arm's derivatives.
Eigen::MatrixXd from_nearest_state(const response::ArmSimulator& simulation,
                                   const std::vector<double>& torque_N_m,
                                   const Eigen::MatrixXd& from_rest,
                                   const Eigen::VectorXd& measured,
                                   const Eigen::VectorXd& deviations) {
  constexpr int kSteps = 20;
  constexpr double kShorter = 0.3;
  constexpr double kNearEnough = 1e-6;  // the sum of squares falls by less than this part of it
  const Eigen::MatrixXd free = simulation.free_readings(torque_N_m.size());
  const Eigen::VectorXd scale = (deviations.cwiseInverse().asDiagonal() * free)
                                    .colwise()
                                    .norm()
                                    .transpose()
                                    .cwiseMax(std::numeric_limits<double>::min());
  const Eigen::MatrixXd weighted =
      deviations.cwiseInverse().asDiagonal() * free * scale.cwiseInverse().asDiagonal();
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> nearest(weighted);
  const auto off = [&](const Eigen::MatrixXd& readings) {
    return Eigen::VectorXd((measured - readings.reshaped()).cwiseQuotient(deviations));
  };
  const auto towards = [&](const Eigen::MatrixXd& readings) {
    return Eigen::VectorXd(nearest.solve(off(readings)).cwiseQuotient(scale));
  };
  if (simulation.is_linear()) {
    const Eigen::VectorXd made = from_rest.reshaped() + free * towards(from_rest);
    return made.reshaped(from_rest.rows(), from_rest.cols());
  }
  Eigen::VectorXd state = Eigen::VectorXd::Zero(simulation.states());
  Eigen::MatrixXd made = from_rest;
  double length = 1.0;
  for (int step = 0; step < kSteps; ++step) {
    const Eigen::VectorXd further = state + length * towards(made);
    const Eigen::MatrixXd there = simulation.readings(torque_N_m, further);
    const double before = off(made).squaredNorm();
    const double after = off(there).squaredNorm();
    if (after < before) {
      state = further;
      made = there;
      length = std::min(1.0, length / kShorter);
      if (before - after < kNearEnough * before) break;
    } else {
      length *= kShorter;
    }
  }
  return made;
}

void predict(const arm::Arm& arm, const measured::FrequencyRecord& record,
             Eigen::Ref<Eigen::VectorXd> values) {
  const response::ArmParts parts = response::take_apart(arm);
  const auto formulation = response::make_formulation("exact_tf", arm, 1);
  const auto chain = response::linear_chain(parts);
  Index at = 0;
  for (auto first = record.channels.begin(); first != record.channels.end();) {
    // Neighbours with the same frequencies at once, as they mostly are.
    const auto last = std::find_if(first, record.channels.end(), [&](const auto& channel) {
      return channel.frequency_Hz != first->frequency_Hz;
    });
    std::vector<arm::Sensor> sensors;
    for (auto channel = first; channel != last; ++channel) sensors.push_back(channel->sensor);
    const auto made =
        response::frequency_response(formulation, chain, sensors, first->frequency_Hz);
    for (const auto& of_sensor : made.values) {
      for (const auto& value : of_sensor) {
        values(at++) = value.real();
        values(at++) = value.imag();
      }
    }
    first = last;
  }
}

}  // namespace

response::TorqueHold simulated_hold(measured::TorqueHold hold) {
  return hold == measured::TorqueHold::zero ? response::TorqueHold::zero
                                            : response::TorqueHold::first;
}

Predictor::Predictor(const Experiment& experiment, const Observations& observations,
                     int flexible_modes)
    : experiment_(&experiment), flexible_modes_(flexible_modes), observations_(observations) {
  for (std::size_t r = 0; r < experiment.runs.size(); ++r) {
    const auto& [run, data] = experiment.runs[r];
    const auto* record = std::get_if<measured::TimeRecord>(&data);
    if (record == nullptr) continue;
    const arm::Payload payload = run.payload.value_or(experiment.arm.payload);
    const auto sensors = sensors_of(*record);
    const response::SimulationOptions options = response::options_of_fit(
        measured::sampling_period_s(*record), simulated_hold(run.torque_hold));
    auto at = std::ranges::find_if(conditions_, [&](const Condition& condition) {
      return condition.payload == payload && condition.sensors == sensors &&
             condition.options.sample_time_s == options.sample_time_s &&
             condition.options.hold == options.hold;
    });
    if (at == conditions_.end()) at = conditions_.insert(at, {payload, sensors, options, {}});
    at->runs.push_back(r);
  }
}

Eigen::VectorXd Predictor::operator()(const arm::Arm& arm, const std::vector<bool>& runs) const {
  const auto& first = observations_.first_of_run;
  Eigen::VectorXd values = Eigen::VectorXd::Zero(first.back());
  const auto stretch = [&](std::size_t r) {
    return values.segment(first[r], first[r + 1] - first[r]);
  };
  arm::Arm with_payload = arm;
  for (const Condition& condition : conditions_) {
    if (std::ranges::none_of(condition.runs, [&](std::size_t r) { return runs[r]; })) continue;
    with_payload.payload = condition.payload;
    const response::ArmParts parts = response::take_apart(with_payload);
    const auto model =
        response::time_model(response::make_formulation("exact_tf", parts.linear, flexible_modes_),
                             parts, flexible_modes_, condition.sensors);
    const response::ArmSimulator simulation(model, parts, condition.sensors, condition.options);
    for (const std::size_t r : condition.runs) {
      if (!runs[r]) continue;
      const auto& [run, data] = experiment_->runs[r];
      const auto& torque_N_m = std::get<measured::TimeRecord>(data).torque_N_m;
      Eigen::MatrixXd readings = simulation.readings(torque_N_m);
      if (run.initial == measured::InitialState::free) {
        const Eigen::Index n = first[r + 1] - first[r];
        readings = from_nearest_state(simulation, torque_N_m, readings,
                                      observations_.values.segment(first[r], n),
                                      observations_.deviations.segment(first[r], n));
      }
      stretch(r) = readings.reshaped();
    }
  }
  for (std::size_t r = 0; r < experiment_->runs.size(); ++r) {
    const auto& [run, data] = experiment_->runs[r];
    if (!runs[r]) continue;
    with_payload.payload = run.payload.value_or(arm.payload);
    if (const auto* record = std::get_if<measured::FrequencyRecord>(&data)) {
      predict(with_payload, *record, stretch(r));
    } else if (const auto* table = std::get_if<measured::ModalTable>(&data)) {
      predict_roots(with_payload, *table, stretch(r));
    }
  }
  return values;
}

ModeChoice modes_needed(const Experiment& experiment, const Observations& observations) {
  std::vector<bool> runs;
  for (const auto& run : experiment.runs) {
    runs.push_back(run.run.kind == measured::RunKind::time);
  }
  ModeChoice choice{kFewestModes, std::vector<double>(observations.channels.size(), 0.0)};
  if (std::ranges::count(runs, true) == 0) return choice;
  const Eigen::VectorXd most =
      Predictor(experiment, observations, kMostModes)(experiment.arm, runs);
  for (; choice.flexible_modes < kMostModes; choice.flexible_modes += 2) {
    const Eigen::VectorXd off =
        Predictor(experiment, observations, choice.flexible_modes)(experiment.arm, runs) - most;
    bool is_enough = true;
    for (std::size_t c = 0; c < observations.channels.size(); ++c) {
      const ObservedChannel& channel = observations.channels[c];
      if (!runs[channel.run]) continue;
      const auto size = [&channel](const Eigen::VectorXd& all) {
        const auto signal = all.segment(channel.first, channel.count).array();
        return (signal - signal.mean()).matrix().norm();
      };
      const double error = off.segment(channel.first, channel.count).norm();
      const double simulated = size(most);
      // A hub that friction holds for the whole run has no signal of its own.
      const double signal = simulated > 0.0 ? simulated : size(observations.values);
      choice.errors[c] = error > 0.0 ? error / signal : 0.0;
      is_enough = is_enough && choice.errors[c] <= std::max(kModeError, 0.1 * channel.noise);
    }
    if (is_enough) return choice;
  }
  return choice;
}

}  // namespace flexarm::diagnose
