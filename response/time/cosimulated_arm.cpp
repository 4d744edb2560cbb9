#include "response/time/cosimulated_arm.hpp"

#include "response/time/reading_times.hpp"
#include "response/time/sample_delay.hpp"
#include "response/time/sensor_readings.hpp"
#include "response/time/simulation_input.hpp"
#include "response/time/torque_path.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace flexarm::response {

namespace {

/// The instant with its fraction from 0 to below 1, rounding aside.
SampleInstant whole(SampleInstant instant) {
  const double samples = std::floor(instant.fraction);
  instant.sample += static_cast<std::int64_t>(samples);
  instant.fraction -= samples;
  if (instant.fraction > 1.0 - kSameInstant) return {instant.sample + 1, 0.0};
  if (instant.fraction < kSameInstant) instant.fraction = 0.0;
  return instant;
}

/// How far `to` is behind `from`, in samples.
double samples_between(SampleInstant from, SampleInstant to) {
  return static_cast<double>(to.sample - from.sample) + (to.fraction - from.fraction);
}

/// The whole numbers that a double can count.
constexpr double kMostSamples = 9007199254740992.0;

arm::InputError not_of_this_arm() {
  return arm::InputError("state: not of this arm");
}

bool is_before(SampleInstant one, SampleInstant other) {
  return samples_between(one, other) > kSameInstant;
}

}  // namespace

struct CosimulatedArm::Model {
  Model(const arm::ModalModel& model, const ArmParts& of, std::span<const arm::Sensor> of_sensors,
        const SimulationOptions& with)
      : parts(of),
        sensors(of_sensors.begin(), of_sensors.end()),
        options(with),
        arm(modal_dynamics(model, of, of_sensors)),
        forces(added_forces(arm, model, of)),
        times(reading_times(of.sensor_chains, of_sensors, with.sample_time_s)),
        plan(arm, forces, of.actuator, with, nullptr, times.cuts()),
        edges(TorquePath(of.actuator, {}, with.sample_time_s, TorqueHold::zero, times.cuts())
                  .edges()),
        delay(sample_delay(of.actuator.delay_s, with.sample_time_s)),
        readings(arm, of, of_sensors) {}
  Model(const Model&) = delete;
  Model& operator=(const Model&) = delete;

  ArmParts parts;
  std::vector<arm::Sensor> sensors;
  SimulationOptions options;
  ModalDynamics arm;
  AddedForces forces;
  ReadingTimes times;
  StepPlan plan;
  std::vector<double> edges;  ///< of the parts of a sample interval
  SampleDelay delay;          ///< of the torque
  SensorReadings readings;    ///< to copy

  /// The part of a sample interval that the fraction is in, or at the beginning of.
  std::size_t part_of(double fraction) const {
    const auto next = std::ranges::upper_bound(edges, fraction + 0.5 * kSameInstant);
    return static_cast<std::size_t>(next - edges.begin()) - 1;
  }
  /// A fraction as the edge that it is at, if at any.
  double at_edge(double fraction) const {
    const double edge = edges[part_of(fraction)];
    return std::abs(edge - fraction) < kSameInstant ? edge : fraction;
  }
};

CosimulatedArm::CosimulatedArm(const arm::ModalModel& model, const ArmParts& parts,
                               std::span<const arm::Sensor> sensors,
                               const SimulationOptions& options) {
  require_options(options);
  if (parts.actuator.delay_s < 0.0) {
    throw arm::out_of_range("stepped arm: delay of the torque", parts.actuator.delay_s, "s",
                            "0 or more, as the command is not known before");
  }
  model_ = std::make_shared<const Model>(model, parts, sensors, options);
  if (sensors.empty()) throw arm::InputError("sensors: there are none");
  for (std::size_t j = 0; j < sensors.size(); ++j) {
    const auto& [at, samples_later] = model_->times.sensors[j];
    const auto same = std::ranges::find_if(motions_, [&](const Delayed& motion) {
      return motion.samples_later == samples_later && motion.at == at;
    });
    if (same != motions_.end()) {
      same->sensors.push_back(j);
    } else {
      motions_.push_back({{j}, samples_later, at, {}, 0.0, TimeStepper(model_->plan, nullptr)});
    }
  }
}

void CosimulatedArm::set_torque(double torque_N_m) {
  require_command(model_->parts, torque_N_m, static_cast<std::size_t>(now_.sample),
                  model_->options.sample_time_s);
  torque_N_m_ = torque_N_m;
  is_torque_new_ = true;
}

double CosimulatedArm::time_of(SampleInstant instant) const {
  const double sample_time_s = model_->options.sample_time_s;
  return static_cast<double>(instant.sample) * sample_time_s + instant.fraction * sample_time_s;
}

/// Now, less the delay.
SampleInstant CosimulatedArm::shown_by(const Delayed& motion) const {
  SampleInstant shown = whole({now_.sample - motion.samples_later, now_.fraction + motion.at});
  shown.fraction = model_->at_edge(shown.fraction);
  return shown;
}

/// The command that acts behind the delay at an instant, which is not after now.
double CosimulatedArm::command_at(SampleInstant instant) const {
  const auto& delay = model_->delay;
  const SampleInstant given = whole({instant.sample - static_cast<std::int64_t>(delay.samples),
                                     instant.fraction - delay.fraction});
  if (!is_before(given, now_)) return torque_N_m_;
  const auto next = std::ranges::find_if(
      commands_, [&](const Command& command) { return is_before(given, command.from); });
  return next == commands_.begin() ? 0.0 : std::prev(next)->torque_N_m;
}

/// When the next command arrives behind the delay.
std::optional<SampleInstant> CosimulatedArm::next_arrival(SampleInstant after) const {
  const auto& delay = model_->delay;
  for (const Command& command : commands_) {
    SampleInstant arrival = whole({command.from.sample + static_cast<std::int64_t>(delay.samples),
                                   command.from.fraction + delay.fraction});
    arrival.fraction = model_->at_edge(arrival.fraction);
    if (is_before(after, arrival)) return arrival;
  }
  return std::nullopt;
}

void CosimulatedArm::advance(Delayed& motion, SampleInstant to) {
  while (is_before(motion.now, to)) {
    const SampleInstant from = motion.now;
    const std::size_t part = model_->part_of(from.fraction);
    const double edge = model_->edges[part + 1];
    SampleInstant stop =
        edge == 1.0 ? SampleInstant{from.sample + 1, 0.0} : SampleInstant{from.sample, edge};
    const auto arrival = next_arrival(from);
    if (arrival && is_before(*arrival, stop)) stop = *arrival;
    if (is_before(to, stop)) stop = to;
    const double end = stop.sample > from.sample ? 1.0 : stop.fraction;
    motion.actuator_N_m = model_->parts.actuator.mapped(command_at(from));
    const TorquePiece piece{
        from.fraction,       end,  motion.actuator_N_m,
        motion.actuator_N_m, part, from.fraction == model_->edges[part] && end == edge};
    const double begin_s = time_of(from);
    motion.stepper.take_up(motion.actuator_N_m, begin_s);
    motion.stepper.advance(piece, begin_s);
    motion.now = stop;
  }
  motion.stepper.forget_event_times();
}

void CosimulatedArm::advance(double duration_s) {
  double samples = duration_s / model_->options.sample_time_s;
  if (!(samples >= 0.0) || !std::isfinite(samples)) {
    throw arm::out_of_range("duration", duration_s, "s", "0 or more");
  }
  if (samples == 0.0) return;
  const double nearest = std::round(samples);
  if (std::abs(samples - nearest) <= kWholeSamples && nearest > 0.0) samples = nearest;
  if (commands_.empty() || commands_.back().torque_N_m != torque_N_m_) {
    commands_.push_back({now_, torque_N_m_});
  }
  const double complete = std::floor(samples);
  now_ = whole(
      {now_.sample + static_cast<std::int64_t>(complete), now_.fraction + (samples - complete)});
  now_.fraction = model_->at_edge(now_.fraction);
  for (Delayed& motion : motions_) advance(motion, shown_by(motion));
  is_torque_new_ = false;
  forget_commands();
}

/// Those that no motion comes to any more.
void CosimulatedArm::forget_commands() {
  const SampleInstant last =
      std::ranges::min_element(motions_, [](const auto& one, const auto& other) {
        return is_before(one.now, other.now);
      })->now;
  const auto& delay = model_->delay;
  const SampleInstant given = whole(
      {last.sample - static_cast<std::int64_t>(delay.samples), last.fraction - delay.fraction});
  while (commands_.size() > 1 && !is_before(given, commands_[1].from)) commands_.pop_front();
}

std::vector<double> CosimulatedArm::readings() const {
  std::vector<double> made(model_->sensors.size());
  SensorReadings readings = model_->readings;
  for (const Delayed& motion : motions_) {
    const SampleInstant shown = shown_by(motion);
    const bool is_shown = shown.sample >= 0;
    const Eigen::VectorXd* values = nullptr;
    if (is_shown && is_torque_new_) {
      const double actuator_N_m = model_->parts.actuator.mapped(command_at(shown));
      TimeStepper behind_jump = motion.stepper;
      behind_jump.take_up(actuator_N_m, time_of(shown));
      values = &readings.read(behind_jump, actuator_N_m);
    } else if (is_shown) {
      values = &readings.read(motion.stepper, motion.actuator_N_m);
    }
    for (const std::size_t j : motion.sensors) {
      const arm::Sensor& sensor = model_->sensors[j];
      made[j] = is_shown ? (*values)(static_cast<Eigen::Index>(j))
                         : chain_of(model_->parts.sensor_chains, sensor).offset;
      if (!std::isfinite(made[j])) throw too_large(arm::to_string(sensor), time_s());
    }
  }
  return made;
}

std::vector<double> CosimulatedArm::state() const {
  std::vector<double> made = {static_cast<double>(now_.sample), now_.fraction, torque_N_m_,
                              is_torque_new_ ? 1.0 : 0.0, static_cast<double>(commands_.size())};
  for (const Command& command : commands_) {
    made.insert(made.end(), {static_cast<double>(command.from.sample), command.from.fraction,
                             command.torque_N_m});
  }
  for (const Delayed& motion : motions_) {
    made.insert(made.end(),
                {static_cast<double>(motion.now.sample), motion.now.fraction, motion.actuator_N_m});
    const Eigen::VectorXd snapshot = motion.stepper.snapshot();
    made.insert(made.end(), snapshot.begin(), snapshot.end());
  }
  return made;
}

void CosimulatedArm::restore(std::span<const double> state) {
  std::size_t at = 0;
  const auto next = [&] {
    if (at == state.size() || !std::isfinite(state[at])) throw not_of_this_arm();
    return state[at++];
  };
  const auto instant = [&] {
    const double sample = next();
    const double fraction = next();
    const bool is_sample = sample == std::floor(sample) && std::abs(sample) <= kMostSamples;
    if (!is_sample || fraction < 0.0 || fraction >= 1.0) throw not_of_this_arm();
    return SampleInstant{static_cast<std::int64_t>(sample), fraction};
  };
  CosimulatedArm made = *this;
  made.now_ = instant();
  made.torque_N_m_ = next();
  made.is_torque_new_ = next() != 0.0;
  const double commands = next();
  made.commands_.clear();
  for (double i = 0.0; i < commands; i += 1.0) {
    const SampleInstant from = instant();
    made.commands_.push_back({from, next()});
  }
  const Eigen::Index numbers = model_->arm.size() + TimeStepper::kSnapshotNumbers;
  for (Delayed& motion : made.motions_) {
    motion.now = instant();
    motion.actuator_N_m = next();
    Eigen::VectorXd snapshot(numbers);
    for (double& number : snapshot) number = next();
    motion.stepper.restore(snapshot);
  }
  if (at != state.size()) throw not_of_this_arm();
  *this = std::move(made);
}

}  // namespace flexarm::response
