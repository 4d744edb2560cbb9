#include "diagnose/predictors/predictor.hpp"

#include "arm/input_error.hpp"
#include "compare/simulated_run.hpp"
#include "diagnose/parallel.hpp"
#include "diagnose/predictors/predicted_roots.hpp"
#include "response/frequency/frequency_response.hpp"
#include "response/truncation.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <variant>

namespace flexarm::diagnose {

namespace {

using Eigen::Index;

/// Arms whose readings are kept for each run: a search begins with the arm that it was decided by,
/// and a report with the one that the search ended with.
constexpr std::size_t kKeptReadings = 1;

std::vector<arm::Sensor> sensors_of(const measured::TimeRecord& record) {
  std::vector<arm::Sensor> sensors;
  for (const auto& channel : record.channels) sensors.push_back(channel.sensor);
  return sensors;
}

/// Sets `values` to the run's responses, from the torque or from the motion of the hub.
void predict(const arm::Arm& arm, std::size_t run, const measured::FrequencyRecord& record,
             ArmResponses& responses, Eigen::Ref<Eigen::VectorXd> values) {
  const auto chain = response::linear_chain(response::take_apart(arm));
  Index at = 0;
  for (auto first = record.channels.begin(); first != record.channels.end();) {
    // Neighbours with the same frequencies at once, as they mostly are.
    const auto last = std::find_if(first, record.channels.end(), [&](const auto& channel) {
      return channel.frequency_Hz != first->frequency_Hz;
    });
    std::vector<arm::Sensor> sensors;
    for (auto channel = first; channel != last; ++channel) sensors.push_back(channel->sensor);
    if (record.input) sensors.push_back(*record.input);
    auto made = response::with_chain(*responses.of(run, arm, sensors, first->frequency_Hz), chain);
    if (record.input) made = response::per_last_sensor(std::move(made));
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
                     int flexible_modes, std::optional<NoiseModel> noise,
                     const arm::Deadline& deadline)
    : experiment_(&experiment),
      flexible_modes_(flexible_modes),
      observations_(observations),
      noise_(std::move(noise)),
      deadline_(deadline),
      models_(std::make_shared<ModalModels>(flexible_modes)),
      filters_(std::make_shared<RunFilters>(experiment.runs.size())),
      responses_(std::make_shared<ArmResponses>(experiment.runs.size())),
      shown_(std::make_shared<KeptReadings>()) {
  for (std::size_t r = 0; r < experiment.runs.size(); ++r) {
    shown_->emplace_back(kKeptReadings);
    const auto& [run, data] = experiment.runs[r];
    const auto* record = std::get_if<measured::TimeRecord>(&data);
    if (record == nullptr) continue;
    const arm::Payload payload = run.payload.value_or(experiment.arm.payload);
    const auto sensors = sensors_of(*record);
    if (sensors.empty()) continue;  // a run whose torque alone is judged
    // A hub that is driven has an acceleration that is linear between samples.
    const auto hold = is_driven_by_motion(experiment) ? response::TorqueHold::first
                                                      : simulated_hold(run.torque_hold);
    const response::SimulationOptions options =
        response::options_of_fit(measured::sampling_period_s(*record), hold);
    auto at = std::ranges::find_if(conditions_, [&](const Condition& condition) {
      return condition.payload == payload && condition.sensors == sensors &&
             condition.is_in_closed_loop == run.controller.has_value() &&
             condition.options.sample_time_s == options.sample_time_s &&
             condition.options.hold == options.hold;
    });
    if (at == conditions_.end())
      at = conditions_.insert(at, {payload, sensors, options, run.controller.has_value(), {}});
    at->runs.push_back(r);
  }
  if (!noise_) return;
  log_determinants_.resize(experiment.runs.size());
  for_each_time_run(experiment.arm, std::vector<bool>(experiment.runs.size(), true), &*noise_,
                    [&](std::size_t r, const response::ArmSimulator& simulation) {
                      const RecordedRun run = recorded(r, *noise_);
                      log_determinants_[r] = filters_->of(r, simulation, run)->log_determinant;
                    });
}

void Predictor::for_each_time_run(const arm::Arm& arm, const std::vector<bool>& runs,
                                  const NoiseModel* noise, const UseSimulation& use) const {
  in_parallel(conditions_.size(), [&](std::size_t c) {
    const Condition& condition = conditions_[c];
    std::vector<std::size_t> simulated;
    std::ranges::copy_if(condition.runs, std::back_inserter(simulated),
                         [&](std::size_t r) { return runs[r]; });
    if (simulated.empty()) return;
    arm::Arm with_payload = arm;
    with_payload.payload = condition.payload;
    response::ArmParts parts = response::take_apart(with_payload);
    // A torque that is logged late acts at once in a loop.
    double& delay_s = parts.actuator.delay_s;
    if (condition.is_in_closed_loop) delay_s = std::max(0.0, delay_s);
    if (noise != nullptr) {
      parts.disturbance = {noise->is_torque_noise() ? 0.0 : noise->correlation_time_s};
    }
    if (is_driven_by_motion(*experiment_)) parts = response::with_driven_hub(std::move(parts));
    const auto model = models_->of(parts, condition.sensors);
    const response::ArmSimulator simulation(*model, parts, condition.sensors, condition.options);
    in_parallel(simulated.size(), [&](std::size_t i) {
      arm::require_time(deadline_);
      use(simulated[i], simulation);
    });
  });
}

void Predictor::predict_other_runs(const arm::Arm& arm, const std::vector<bool>& runs,
                                   Eigen::VectorXd& values) const {
  arm::Arm with_payload = arm;
  for (std::size_t r = 0; r < experiment_->runs.size(); ++r) {
    const auto& [run, data] = experiment_->runs[r];
    if (!runs[r]) continue;
    arm::require_time(deadline_);
    with_payload.payload = run.payload.value_or(arm.payload);
    const auto [first, count] = stretch(r);
    if (const auto* record = std::get_if<measured::FrequencyRecord>(&data)) {
      predict(with_payload, r, *record, *responses_, values.segment(first, count));
    } else if (const auto* table = std::get_if<measured::ModalTable>(&data)) {
      predict_roots(with_payload, *table, values.segment(first, count));
    }
  }
}

Eigen::VectorXd Predictor::operator()(const arm::Arm& arm, const std::vector<bool>& runs) const {
  Eigen::VectorXd values = Eigen::VectorXd::Zero(observations_.values.size());
  const Eigen::VectorXd weights = weighing_deviations(observations_);
  const double logged_late_s = std::max(0.0, -response::take_apart(arm).actuator.delay_s);
  const auto simulated = [&](std::size_t r, const response::ArmSimulator& simulation) {
    const auto [first, count] = simulated_stretch(r);
    const Eigen::VectorXd measured = observations_.values.segment(first, count);
    const Eigen::VectorXd deviations = weights.segment(first, count);
    const auto& run = experiment_->runs[r];
    if (!is_driven_by_motion(*experiment_)) {
      return compare::simulated_run(simulation, run, logged_late_s, measured, deviations,
                                    deadline_);
    }
    const PrescribedMotion& hub = experiment_->motions[r].motion;
    return compare::driven_run(simulation, {hub.angle_rad, hub.velocity_rad_per_s},
                               hub.acceleration_rad_per_s2, run, measured, deviations, deadline_);
  };
  for_each_time_run(
      arm, runs, nullptr, [&](std::size_t r, const response::ArmSimulator& simulation) {
        const auto [first, count] = simulated_stretch(r);
        values.segment(first, count) =
            *(*shown_)[r].of(arm, [&](const arm::Arm&) { return simulated(r, simulation); });
      });
  if (experiment_->judges_torque) predict_torques(arm, runs, values);
  predict_other_runs(arm, runs, values);
  return values;
}

std::optional<Index> Predictor::hub_sensor(std::size_t r) const {
  const auto& channels = std::get<measured::TimeRecord>(experiment_->runs[r].data).channels;
  for (const auto kind : {arm::SensorKind::hub_angle, arm::SensorKind::hub_velocity}) {
    const auto found = std::ranges::find_if(
        channels, [kind](const auto& channel) { return channel.sensor.kind == kind; });
    if (found != channels.end()) return found - channels.begin();
  }
  return std::nullopt;
}

RecordedRun Predictor::recorded(std::size_t r, const NoiseModel& noise) const {
  const auto& [run, data] = experiment_->runs[r];
  const auto [first, count] = stretch(r);
  std::vector<double> deviations;
  std::vector<Index> missing;
  for (const ObservedChannel& channel : observations_.channels) {
    if (channel.run != r) continue;
    for (const std::size_t k : channel.left_out) {
      missing.push_back(channel.first - first + static_cast<Index>(k));
    }
    deviations.push_back(observations_.deviations(channel.first) *
                         noise.reading_factor(channel.sensor));
  }
  return {std::get<measured::TimeRecord>(data).torque_N_m,
          observations_.values.segment(first, count),
          Eigen::VectorXd::Map(deviations.data(), std::ssize(deviations)),
          {noise.is_torque_noise() ? noise.torque_noise_N_m[r] : noise.disturbance_N_m,
           noise.modal_force_N_m},
          run.initial == measured::InitialState::free,
          hub_sensor(r),
          missing};
}

Eigen::VectorXd Predictor::residuals(const arm::Arm& arm, const std::vector<bool>& runs) const {
  if (!noise_) {
    return (observations_.values - (*this)(arm, runs)).cwiseQuotient(observations_.deviations);
  }
  Eigen::VectorXd made = observations_.values;
  predict_other_runs(arm, runs, made);
  made = (observations_.values - made).cwiseQuotient(observations_.deviations);
  const auto innovated = innovations(arm, runs, *noise_);
  for (std::size_t r = 0; r < innovated.size(); ++r) {
    const auto [first, count] = stretch(r);
    if (innovated[r].standardised.size() == 0) continue;
    const double more = innovated[r].log_determinant - log_determinants_[r];
    auto part = made.segment(first, count);
    part = innovated[r].standardised;
    part *= std::exp(more / (2.0 * static_cast<double>(innovated[r].count)));
  }
  return made;
}

std::vector<RunInnovations> Predictor::innovations(const arm::Arm& arm,
                                                   const std::vector<bool>& runs,
                                                   const NoiseModel& noise) const {
  std::vector<RunInnovations> made(runs.size());
  for_each_time_run(arm, runs, &noise,
                    [&](std::size_t r, const response::ArmSimulator& simulation) {
                      const RecordedRun run = recorded(r, noise);
                      made[r] = filter_run(simulation, run, *filters_->of(r, simulation, run));
                    });
  return made;
}

std::vector<response::ErrorsAhead> Predictor::errors_ahead(
    const arm::Arm& arm, const std::vector<bool>& runs,
    const std::vector<response::StartsAhead>& starts) const {
  std::vector<response::ErrorsAhead> made(runs.size());
  for_each_time_run(
      arm, runs, &*noise_, [&](std::size_t r, const response::ArmSimulator& simulation) {
        const RecordedRun run = recorded(r, *noise_);
        made[r] = run_ahead(simulation, run, *filters_->of(r, simulation, run), starts[r]);
      });
  return made;
}

BalancedRun Predictor::balanced(const arm::Arm& arm, std::size_t r) const {
  const auto& [run, data] = experiment_->runs[r];
  arm::Arm with_payload = arm;
  with_payload.payload = run.payload.value_or(arm.payload);
  const response::ArmParts parts = response::take_apart(with_payload);
  return balance(*models_->of(parts, {}), parts, std::get<measured::TimeRecord>(data),
                 simulated_hold(run.torque_hold), experiment_->motions[r]);
}

void Predictor::predict_torques(const arm::Arm& arm, const std::vector<bool>& runs,
                                Eigen::VectorXd& values) const {
  std::vector<BalancedRun> balances(runs.size());
  in_parallel(runs.size(), [&](std::size_t r) {
    arm::require_time(deadline_);
    if (runs[r]) balances[r] = balanced(arm, r);
  });
  double recorded = 0.0;
  double transmitted = 0.0;
  const auto map = [](const std::vector<double>& torque_N_m) {
    return Eigen::VectorXd::Map(torque_N_m.data(), std::ssize(torque_N_m));
  };
  for (std::size_t r = 0; r < runs.size(); ++r) {
    if (!runs[r]) continue;
    recorded +=
        map(std::get<measured::TimeRecord>(experiment_->runs[r].data).torque_N_m).squaredNorm();
    transmitted += map(balances[r].transmitted_N_m).squaredNorm();
  }
  for (std::size_t r = 0; r < runs.size(); ++r) {
    if (!runs[r]) continue;
    const auto [first, count] = simulated_stretch(r);
    const Index at = first + count;
    const auto samples = std::ssize(balances[r].missing_N_m);
    values.segment(at, samples) = observations_.values.segment(at, samples) +
                                  std::sqrt(recorded / transmitted) * map(balances[r].missing_N_m);
  }
}

std::pair<Index, Index> Predictor::stretch(std::size_t run) const {
  const auto& first = observations_.first_of_run;
  return {first[run], first[run + 1] - first[run]};
}

std::pair<Index, Index> Predictor::simulated_stretch(std::size_t run) const {
  auto [first, count] = stretch(run);
  if (experiment_->judges_torque) {
    count -= std::ssize(std::get<measured::TimeRecord>(experiment_->runs[run].data).torque_N_m);
  }
  return {first, count};
}

// Moves are not what the likelihood of a smoothing assumes: those of simulated arms were off by up
// to 1.2 times what it says.
constexpr double kMotionDoubt = 1.2;

Eigen::VectorXd change_by_motion_error(const Experiment& experiment,
                                       const Observations& observations, int flexible_modes,
                                       const arm::Deadline& deadline) {
  Experiment displaced = experiment;
  for (auto& [sensor, noise, motion, error, filtered] : displaced.motions) {
    motion.angle_rad += error.angle_rad;
    motion.velocity_rad_per_s += error.velocity_rad_per_s;
    for (std::size_t k = 0; k < motion.acceleration_rad_per_s2.size(); ++k) {
      motion.acceleration_rad_per_s2[k] += error.acceleration_rad_per_s2[k];
    }
  }
  const std::vector<bool> all(experiment.runs.size(), true);
  try {
    return kMotionDoubt *
           (Predictor(displaced, observations, flexible_modes, {}, deadline)(experiment.arm, all) -
            Predictor(experiment, observations, flexible_modes, {}, deadline)(experiment.arm, all));
  } catch (const std::runtime_error&) {
    // An arm that is none, or a simulation that overflows.
  } catch (const arm::Cancelled&) {
  }
  return Eigen::VectorXd::Zero(observations.values.size());
}

std::vector<double> errors_of_motion(const Experiment& experiment, const Observations& observations,
                                     int flexible_modes, const arm::Deadline& deadline) {
  const Eigen::VectorXd off =
      change_by_motion_error(experiment, observations, flexible_modes, deadline);
  std::vector<double> made;
  for (const ObservedChannel& channel : observations.channels) {
    const auto signal = observations.values.segment(channel.first, channel.count).array();
    made.push_back(off.segment(channel.first, channel.count).norm() /
                   (signal - signal.mean()).matrix().norm());
  }
  return made;
}

/// `choice` with the errors of modes beyond kMostModes, too, for runs and arms that
/// response::truncation_in_time takes.
ModeChoice with_truncation(const Experiment& experiment, const Observations& observations,
                           const arm::Deadline& deadline, ModeChoice choice) {
  if (is_driven_by_motion(experiment)) return choice;
  for (std::size_t r = 0; r < experiment.runs.size() && !arm::is_over(deadline); ++r) {
    const auto& [run, data] = experiment.runs[r];
    if (run.kind != measured::RunKind::time) continue;
    const auto& record = std::get<measured::TimeRecord>(data);
    std::vector<double> errors;
    try {
      errors = response::truncation_in_time(arm_in(experiment, run), sensors_of(record),
                                            record.torque_N_m, measured::sampling_period_s(record),
                                            simulated_hold(run.torque_hold),
                                            {.given = choice.flexible_modes})
                   .errors;
    } catch (const arm::InputError&) {
      continue;
    }
    // The torque of a closed loop stands behind the sensors.
    std::size_t sensor = 0;
    for (std::size_t c = 0; c < observations.channels.size() && sensor < errors.size(); ++c) {
      if (observations.channels[c].run != r) continue;
      choice.errors[c] = std::max(choice.errors[c], errors[sensor++]);
    }
  }
  return choice;
}

ModeChoice modes_needed(const Experiment& experiment, const Observations& observations,
                        const arm::Deadline& deadline) {
  std::vector<bool> runs;
  for (const auto& run : experiment.runs) {
    runs.push_back(run.run.kind == measured::RunKind::time);
  }
  ModeChoice choice{kFewestModes, std::vector<double>(observations.channels.size(), 0.0)};
  if (std::ranges::count(runs, true) == 0) return choice;
  const auto shown = [&](int flexible_modes) {
    return Predictor(experiment, observations, flexible_modes, {}, deadline)(experiment.arm, runs);
  };
  ModeChoice known = choice;  // the last one whose errors are
  try {
    const Eigen::VectorXd most = shown(kMostModes);
    for (; choice.flexible_modes < kMostModes; choice.flexible_modes += 2) {
      const Eigen::VectorXd off = shown(choice.flexible_modes) - most;
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
      if (is_enough) break;
      known = choice;
    }
  } catch (const arm::Cancelled&) {
    return known;
  }
  return with_truncation(experiment, observations, deadline, std::move(choice));
}

}  // namespace flexarm::diagnose
