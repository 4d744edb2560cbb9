#include "response/time/arm_simulator.hpp"

#include "arm/linear_arm.hpp"
#include "response/time/orthogonal_complement.hpp"
#include "response/time/propagator.hpp"
#include "response/time/sensor_readings.hpp"
#include "response/time/simulation_input.hpp"
#include "response/time/simulator_commands.hpp"
#include "response/time/time_stepper.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

namespace flexarm::response {

namespace {

using Eigen::Index;

/// Samples between two looks at whether to go on.
constexpr std::ptrdiff_t kProgressInterval = 1 << 10;

/// Of the forces of an inner step in a fit: far below any noise, and small enough that quotients of
/// differences over 1e-5 of a parameter's range have four digits.
constexpr double kFitForceTolerance = 1e-9;
/// Of a run of some thousand samples: more than one in each. A longer run may have one in each.
constexpr std::int64_t kMostHalvedStepsOfFit = 5000;
/// Friction that sticks and slips takes two or three inner steps a sample.
constexpr double kMostStepsPerSampleOfFit = 100.0;

/// Of an unknown initial state: the rotation and the first flexible mode.
constexpr Index kFewestResolvedModes = 2;

/// Samples per period of the highest mode.
double samples_per_period(const ModalDynamics& arm, double sample_time_s) {
  const double omega = std::sqrt(std::max(0.0, arm.stiffness.maxCoeff()));
  return omega > 0.0 ? 2.0 * std::numbers::pi / (omega * sample_time_s)
                     : std::numeric_limits<double>::infinity();
}

Sampling sampling(double samples_per_period) {
  if (samples_per_period <= kAliasedSamplesPerPeriod) return Sampling::aliased;
  return samples_per_period < kFineSamplesPerPeriod ? Sampling::coarse : Sampling::fine;
}

}  // namespace

ArmSimulator::ArmSimulator(const arm::ModalModel& model, const ArmParts& parts,
                           std::span<const arm::Sensor> sensors, const SimulationOptions& options)
    : parts_(parts),
      sensors_(sensors.begin(), sensors.end()),
      options_(options),
      arm_(modal_dynamics(model, parts, sensors)),
      forces_(added_forces(arm_, model, parts)),
      ledger_(options.energy ? std::optional<EnergyLedger>(
                                   std::in_place, arm_, forces_,
                                   arm::linear_arm(parts.linear).hub_viscous_friction_N_m_s_per_rad)
                             : std::nullopt),
      times_(reading_times(parts.sensor_chains, sensors, options.sample_time_s)),
      plan_(arm_, forces_, parts.actuator, options, ledger_ ? &*ledger_ : nullptr, times_.cuts()) {
  if (ledger_) return;
  const TorquePath path(parts.actuator, {}, options.sample_time_s, options.hold, times_.cuts());
  const bool can_turn_in_blocks = TurningBlocks::are_possible(plan_, path);
  if (!plan_.is_linear() && !can_turn_in_blocks) return;
  interval_ = interval_map(plan_, parts_, sensors_, path, times_);
  if (plan_.is_linear()) lifted_.emplace(interval_, times_);
  if (can_turn_in_blocks) blocks_.emplace(plan_, interval_, times_);
}

std::ptrdiff_t ArmSimulator::lead(std::size_t samples) const {
  return std::min(times_.longest_samples(), static_cast<std::ptrdiff_t>(samples));
}

Eigen::MatrixXd ArmSimulator::rigid_states() const {
  Eigen::MatrixXd made = Eigen::MatrixXd::Zero(states(), 2);
  made(0, 0) = arm_.scale_rad_per_s(0) / arm_.hub_slope(0);
  made(arm_.modes, 1) = 1.0 / arm_.hub_slope(0);
  return made;
}

Index ArmSimulator::resolved_modes() const {
  const double nyquist_rad_per_s = std::numbers::pi / options_.sample_time_s;
  const auto below = (arm_.stiffness.array() < nyquist_rad_per_s * nyquist_rad_per_s).count();
  return std::min<Index>(arm_.modes, std::max<Index>(kFewestResolvedModes, below));
}

Eigen::MatrixXd ArmSimulator::resolved_states() const {
  const Index n = arm_.modes;
  const Index resolved = resolved_modes();
  const Index others = states() - 2 * n;
  Eigen::MatrixXd made = Eigen::MatrixXd::Zero(states(), 2 * resolved + others);
  made.topLeftCorner(resolved, resolved).setIdentity();
  made.block(n, resolved, resolved, resolved).setIdentity();
  made.bottomRightCorner(others, others).setIdentity();
  return made;
}

Eigen::MatrixXd ArmSimulator::resolved_states_of_resting_hub() const {
  const Index n = arm_.modes;
  const Index resolved = resolved_modes();
  const Index others = states() - 2 * n;
  // What is orthogonal to the rows that show the hub.
  Eigen::MatrixXd made = Eigen::MatrixXd::Zero(states(), 2 * (resolved - 1) + others);
  made.topLeftCorner(resolved, resolved - 1) =
      orthogonal_complement(arm_.hub_slope.cwiseQuotient(arm_.scale_rad_per_s).head(resolved));
  made.block(n, resolved - 1, resolved, resolved - 1) =
      orthogonal_complement(arm_.hub_slope.head(resolved));
  made.bottomRightCorner(others, others).setIdentity();
  return made;
}

Simulation ArmSimulator::run(std::span<const double> torque_N_m,
                             const SimulationProgress& progress) const {
  Commands commands(*this, torque_N_m);
  return run(commands, progress);
}

Simulation ArmSimulator::run(const ClosedLoop& loop, const SimulationProgress& progress) const {
  Commands commands(*this, loop);
  return run(commands, progress);
}

Simulation ArmSimulator::run(Commands& commands, const SimulationProgress& progress) const {
  const std::span<const double> torque_N_m = commands.torque_N_m();
  const ReadingPlan reading_plan = commands.reading_plan();
  std::optional<EnergyLedger> ledger = ledger_;
  TimeStepper stepper(plan_, ledger ? &*ledger : nullptr);
  SensorReadings readings(arm_, parts_, sensors_);
  Simulation made;
  for (const arm::Sensor& sensor : sensors_) {
    made.channels.emplace_back(torque_N_m.size(), chain_of(parts_.sensor_chains, sensor).offset);
  }
  bool go_on = true;
  const auto record = [&](const ReadingInstant& now) {
    if (now.part == 0) {
      made.time_s.push_back(now.time_s);
      made.commanded_torque_N_m.push_back(torque_N_m[static_cast<std::size_t>(now.sample)]);
      made.hub_torque_N_m.push_back(stepper.hub_torque_N_m(now.actuator_N_m));
      if (!std::isfinite(made.hub_torque_N_m.back())) {
        throw too_large("torque at the hub", now.time_s);
      }
    }
    reading_plan.at(now, stepper, readings, [&](std::size_t j, std::size_t k, double reading) {
      if (!std::isfinite(reading)) throw too_large(arm::to_string(sensors_[j]), now.time_s);
      made.channels[j][k] = reading;
    });
    if (now.part > 0) return true;
    if (ledger) {
      ledger->close_sample(stepper.state());
      if (!std::isfinite(ledger->balance().residual_J())) throw too_large("energy", now.time_s);
    }
    const std::ptrdiff_t k = now.sample;
    if (progress && k % kProgressInterval == 0 && k + 1 < std::ssize(torque_N_m)) {
      go_on = progress(static_cast<double>(k) / static_cast<double>(torque_N_m.size()));
    }
    return go_on;
  };
  commands.step_through(stepper, 0, record);
  for (auto& channel : made.channels) channel.resize(made.time_s.size());
  if (ledger) made.energy = ledger->balance();
  made.summary = stepper.summary();
  made.summary.most_iterations = stepper.most_iterations();
  made.summary.completed = go_on;
  made.summary.steps = static_cast<std::int64_t>(made.time_s.size()) - (go_on ? 1 : 0);
  made.summary.samples_per_period = samples_per_period(arm_, options_.sample_time_s);
  made.summary.sampling = sampling(made.summary.samples_per_period);
  return made;
}

Eigen::MatrixXd ArmSimulator::readings(std::span<const double> torque_N_m,
                                       const Eigen::VectorXd& initial,
                                       const arm::Deadline& deadline) const {
  Commands commands(*this, torque_N_m);
  if (!lifted_ && !blocks_) return readings(commands, initial, nullptr, deadline);
  const std::ptrdiff_t first = first_interval(torque_N_m.size(), initial);
  const auto torques = commands.path().whole_parts(first);
  if (!lifted_ || !torques) {
    return readings(commands, initial, torques ? &*torques : nullptr, deadline);
  }
  Eigen::MatrixXd made = unread(torque_N_m.size());
  lifted_->read(*torques, first, initial.size() > 0 ? initial : Eigen::VectorXd::Zero(states()),
                made);
  for (Index k = 0; k < made.rows(); ++k) {
    if (made.row(k).allFinite()) continue;
    throw too_large("reading", static_cast<double>(k) * options_.sample_time_s);
  }
  return made;
}

ClosedLoopReadings ArmSimulator::closed_loop_readings(const ClosedLoop& loop,
                                                      const Eigen::VectorXd& initial,
                                                      const arm::Deadline& deadline) const {
  Commands commands(*this, loop);
  ClosedLoopReadings made;
  made.readings = readings(commands, initial, nullptr, deadline);
  made.torque_N_m = commands.take_torque_N_m();
  return made;
}

std::ptrdiff_t ArmSimulator::first_interval(std::size_t samples,
                                            const Eigen::VectorXd& initial) const {
  return initial.size() > 0 ? -lead(samples) : 0;
}

Eigen::MatrixXd ArmSimulator::readings(Commands& commands, const Eigen::VectorXd& initial,
                                       const Eigen::MatrixXd* torques,
                                       const arm::Deadline& deadline) const {
  const std::size_t samples = commands.torque_N_m().size();
  const ReadingPlan reading_plan = commands.reading_plan();
  TimeStepper stepper(plan_, nullptr);
  if (initial.size() > 0) stepper.put(initial, false);
  const std::ptrdiff_t first = first_interval(samples, initial);
  SensorReadings readings(arm_, parts_, sensors_);
  Eigen::MatrixXd made = unread(samples);
  std::ptrdiff_t next_look = first;
  const auto at = [&](const ReadingInstant& now) {
    if (now.sample >= next_look) {
      arm::require_time(deadline);
      next_look = now.sample + kProgressInterval;
    }
    const auto take = [&](std::size_t j, std::size_t k, double reading) {
      if (!std::isfinite(reading)) throw too_large("reading", now.time_s);
      made(static_cast<Index>(k), static_cast<Index>(j)) = reading;
    };
    reading_plan.at(now, stepper, readings, take);
    return true;
  };
  if (torques == nullptr) {
    commands.step_through(stepper, first, at);
    return made;
  }
  TurningBlocks::Run blocks(*blocks_);
  std::ptrdiff_t next_try = first;
  Eigen::VectorXd x;
  commands.step_through(stepper, first, at, [&](std::ptrdiff_t k) -> std::ptrdiff_t {
    const double turning = direction(stepper.motion());
    const bool is_inside = k + TurningBlocks::kSamples < std::ssize(commands.torque_N_m());
    if (k < next_try || turning == 0.0 || !is_inside) return 0;
    x = stepper.state();
    if (!blocks.go(*torques, first, k, turning, x, made)) {
      next_try = k + TurningBlocks::kSamples / 2;
      return 0;
    }
    stepper.put(x, false);
    return TurningBlocks::kSamples;
  });
  return made;
}

Eigen::MatrixXd ArmSimulator::unread(std::size_t samples) const {
  Eigen::MatrixXd made(static_cast<Index>(samples), static_cast<Index>(sensors_.size()));
  for (std::size_t j = 0; j < sensors_.size(); ++j) {
    made.col(static_cast<Index>(j)).setConstant(chain_of(parts_.sensor_chains, sensors_[j]).offset);
  }
  return made;
}

Eigen::MatrixXd ArmSimulator::transition(double fraction) const {
  return propagator(arm_.turning, fraction * options_.sample_time_s, options_.precision).state;
}

Eigen::MatrixXd ArmSimulator::sample_transition() const {
  Eigen::MatrixXd made = transition(1.0);
  if (parts_.disturbance && parts_.disturbance->is_white()) {
    made.row(arm_.disturbance.value()).setZero();
  }
  return made;
}

Eigen::MatrixXd ArmSimulator::linear_readings() const {
  Eigen::MatrixXd made(static_cast<Index>(sensors_.size()), states());
  for (std::size_t j = 0; j < sensors_.size(); ++j) {
    const auto row = static_cast<Index>(j);
    made.row(row) = arm_.turning.sensors[j].state;
    const double at = times_.sensors[j].at;
    if (at > 0.0) made.row(row) = made.row(row) * transition(at);
  }
  return made;
}

Eigen::MatrixXd ArmSimulator::free_readings(std::size_t samples) const {
  const auto n = static_cast<Index>(samples);
  const Eigen::MatrixXd taken = linear_readings();
  Eigen::MatrixXd made = Eigen::MatrixXd::Zero(n * taken.rows(), states());
  // Powers 1, 2, 4, ... of the step: they double the number of rows that are known.
  std::vector<Eigen::MatrixXd> powers = {sample_transition()};
  for (Index known = 2; known < n; known *= 2) powers.push_back(powers.back() * powers.back());
  // From where it is first read on, the row of a sensor is its row of readings times a power of the
  // step.
  for (Index j = 0; j < taken.rows(); ++j) {
    Eigen::RowVectorXd row = taken.row(j);
    Index first = times_.sensors[static_cast<std::size_t>(j)].samples_later - lead(samples);
    for (; first < 0; ++first) row = row * powers.front();
    if (first >= n) continue;
    auto of_sensor = made.middleRows(j * n + first, n - first);
    of_sensor.row(0) = row;
    Index known = 1;
    for (const Eigen::MatrixXd& power : powers) {
      const Index more = std::min(known, of_sensor.rows() - known);
      of_sensor.middleRows(known, more).noalias() = of_sensor.topRows(more) * power;
      known += more;
    }
  }
  return made;
}

SimulationOptions options_of_fit(double sample_time_s, TorqueHold hold) {
  return {.sample_time_s = sample_time_s,
          .hold = hold,
          .energy = false,
          .force_tolerance = kFitForceTolerance,
          .most_halved_steps = kMostHalvedStepsOfFit,
          .most_steps_per_sample = kMostStepsPerSampleOfFit,
          .resolve_every_mode = false,
          .precision = Precision::working};
}

}  // namespace flexarm::response
