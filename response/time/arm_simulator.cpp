#include "response/time/arm_simulator.hpp"

#include "arm/input_error.hpp"
#include "arm/linear_arm.hpp"
#include "response/time/controller_run.hpp"
#include "response/time/propagator.hpp"
#include "response/time/sensor_readings.hpp"
#include "response/time/simulation_input.hpp"
#include "response/time/time_stepper.hpp"
#include "response/time/torque_path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

namespace flexarm::response {

namespace {

using Eigen::Index;

/// Samples between two looks at whether to go on.
constexpr std::size_t kProgressInterval = 1 << 14;

/// Of the forces of an inner step in a fit: far below any noise, and small enough that quotients of
/// differences over 1e-5 of a parameter's range have four digits.
constexpr double kFitForceTolerance = 1e-9;

arm::InputError too_large(const std::string& what, double time_s) {
  return arm::InputError(fmt::format(
      "{} at {:.6g} s: numeric overflow; reduce the torque or the duration", what, time_s));
}

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

/// The commanded torque of a run, sample by sample: given, or made by a controller on the way.
class ArmSimulator::Commands {
 public:
  /// Of an open loop. `torque_N_m` must outlive the object.
  Commands(const ArmSimulator& arm, std::span<const double> torque_N_m)
      : arm_(&arm), torque_N_m_(torque_N_m) {
    require_simulable(arm.parts_, torque_N_m, arm.options_);
  }

  /// Of a closed loop. `loop` must outlive the object.
  Commands(const ArmSimulator& arm, const ClosedLoop& loop)
      : arm_(&arm),
        loop_(&loop),
        made_N_m_(loop.reference.size()),
        torque_N_m_(made_N_m_),
        readings_(std::in_place, arm.arm_, arm.parts_, arm.sensors_) {
    const auto& options = arm.options_;
    require_options(options);
    if (options.hold != TorqueHold::zero) {
      throw arm::InputError("torque hold: must be zero-order in a closed loop");
    }
    if (loop.reference.empty()) throw arm::InputError("reference: there are no samples");
    for (std::size_t k = 0; k < loop.reference.size(); ++k) {
      if (std::isfinite(loop.reference[k])) continue;
      throw arm::InputError(fmt::format("reference = {} at sample {} (from 0): must be finite",
                                        loop.reference[k], k));
    }
    arm::require_valid(loop.controller);
    for (const arm::Sensor& sensor : loop.controller.sensors) {
      const auto found = std::ranges::find(arm.sensors_, sensor);
      if (found == arm.sensors_.end()) {
        throw arm::InputError(
            fmt::format("controller: its sensor {} is not simulated", arm::to_string(sensor)));
      }
      places_.push_back(found - arm.sensors_.begin());
    }
    period_ = static_cast<std::size_t>(
        arm::samples_per_period(loop.controller, options.sample_time_s));
    run_.emplace(loop.controller, static_cast<double>(period_) * options.sample_time_s,
                 loop.controller_state);
    read_.resize(places_.size());
  }
  Commands(const Commands&) = delete;
  Commands& operator=(const Commands&) = delete;

  /// As many as samples; up to the sample that was reached.
  std::span<const double> torque_N_m() const { return torque_N_m_; }
  std::vector<double> take_torque_N_m() { return std::move(made_N_m_); }

  /// Before the torque of sample `k` is taken up; `actuator_N_m` is that of the actuator until now.
  void reach(std::size_t k, const TimeStepper& stepper, double actuator_N_m) {
    if (loop_ == nullptr) return;
    if (k % period_ != 0) {
      made_N_m_[k] = made_N_m_[k - 1];
      return;
    }
    const Eigen::VectorXd& now = readings_->read(stepper, actuator_N_m);
    for (std::size_t j = 0; j < places_.size(); ++j) read_[j] = now(places_[j]);
    made_N_m_[k] = run_->command(loop_->reference[k], read_);
    const double sample_time_s = arm_->options_.sample_time_s;
    if (!std::isfinite(made_N_m_[k])) {
      throw too_large("torque of the controller", static_cast<double>(k) * sample_time_s);
    }
    require_command(arm_->parts_, made_N_m_[k], k, sample_time_s);
  }

  /// Steps through the samples; `at_sample(k, time, actuator torque)`, called at each, says whether
  /// to go on. The last sample is looked at, not stepped from.
  template <class AtSample>
  void step_through(TimeStepper& stepper, AtSample at_sample) {
    const auto& options = arm_->options_;
    const TorquePath path(arm_->parts_.actuator, torque_N_m_, options.sample_time_s, options.hold);
    TorquePath::Pieces pieces;
    double actuator_N_m = 0.0;
    for (std::size_t k = 0; k < torque_N_m_.size(); ++k) {
      const double time_s = static_cast<double>(k) * options.sample_time_s;
      reach(k, stepper, actuator_N_m);
      path.pieces(k, pieces);
      stepper.take_up(pieces.front().begin_N_m, time_s);
      if (!at_sample(k, time_s, pieces.front().begin_N_m) || k + 1 == torque_N_m_.size()) return;
      for (const TorquePiece& piece : pieces) {
        const double begin_s = time_s + piece.begin * options.sample_time_s;
        if (piece.begin > 0.0) stepper.take_up(piece.begin_N_m, begin_s);
        stepper.advance(piece, begin_s);
      }
      actuator_N_m = pieces.back().end_N_m;
    }
  }

 private:
  const ArmSimulator* arm_;
  const ClosedLoop* loop_ = nullptr;
  std::vector<double> made_N_m_;
  std::span<const double> torque_N_m_;
  std::optional<SensorReadings> readings_;
  std::vector<Index> places_;  // of the controller's sensors
  std::size_t period_ = 1;     // of the controller, in samples
  std::optional<ControllerRun> run_;
  std::vector<double> read_;
};

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
      plan_(arm_, forces_, parts.actuator, options, ledger_ ? &*ledger_ : nullptr) {}

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
  const std::size_t samples = commands.torque_N_m().size();
  std::optional<EnergyLedger> ledger = ledger_;
  TimeStepper stepper(plan_, ledger ? &*ledger : nullptr);
  SensorReadings readings(arm_, parts_, sensors_);
  Simulation made;
  made.channels.resize(sensors_.size());
  bool go_on = true;
  const auto record = [&](std::size_t k, double time_s, double actuator_N_m) {
    made.time_s.push_back(time_s);
    made.commanded_torque_N_m.push_back(commands.torque_N_m()[k]);
    made.hub_torque_N_m.push_back(stepper.hub_torque_N_m(actuator_N_m));
    if (!std::isfinite(made.hub_torque_N_m.back())) throw too_large("torque at the hub", time_s);
    const Eigen::VectorXd& now = readings.read(stepper, actuator_N_m);
    for (std::size_t j = 0; j < made.channels.size(); ++j) {
      const double reading = now(static_cast<Index>(j));
      if (!std::isfinite(reading)) throw too_large(arm::to_string(sensors_[j]), time_s);
      made.channels[j].push_back(reading);
    }
    if (ledger) {
      ledger->close_sample(stepper.state());
      if (!std::isfinite(ledger->balance().residual_J())) throw too_large("energy", time_s);
    }
    if (progress && k % kProgressInterval == 0 && k + 1 < samples) {
      go_on = progress(static_cast<double>(k) / static_cast<double>(samples));
    }
    return go_on;
  };
  commands.step_through(stepper, record);
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
                                       const Eigen::VectorXd& initial) const {
  Commands commands(*this, torque_N_m);
  return readings(commands, initial);
}

ClosedLoopReadings ArmSimulator::closed_loop_readings(const ClosedLoop& loop,
                                                      const Eigen::VectorXd& initial) const {
  Commands commands(*this, loop);
  ClosedLoopReadings made;
  made.readings = readings(commands, initial);
  made.torque_N_m = commands.take_torque_N_m();
  return made;
}

Eigen::MatrixXd ArmSimulator::readings(Commands& commands, const Eigen::VectorXd& initial) const {
  TimeStepper stepper(plan_, nullptr);
  if (initial.size() > 0) stepper.put(initial, false);
  SensorReadings readings(arm_, parts_, sensors_);
  Eigen::MatrixXd made(static_cast<Index>(commands.torque_N_m().size()),
                       static_cast<Index>(sensors_.size()));
  commands.step_through(stepper, [&](std::size_t k, double time_s, double actuator_N_m) {
    const Eigen::VectorXd& now = readings.read(stepper, actuator_N_m);
    if (!now.allFinite()) throw too_large("reading", time_s);
    made.row(static_cast<Index>(k)) = now.transpose();
    return true;
  });
  return made;
}

Eigen::MatrixXd ArmSimulator::transition() const {
  return propagator(arm_.turning, options_.sample_time_s, 1.0, options_.precision).state;
}

Eigen::MatrixXd ArmSimulator::linear_readings() const {
  Eigen::MatrixXd made(static_cast<Index>(sensors_.size()), states());
  for (Index j = 0; j < made.rows(); ++j) {
    made.row(j) = arm_.turning.sensors[static_cast<std::size_t>(j)].state;
  }
  return made;
}

Eigen::MatrixXd ArmSimulator::free_readings(std::size_t samples) const {
  const auto n = static_cast<Index>(samples);
  const Eigen::MatrixXd step = transition();
  const Eigen::MatrixXd at_once = linear_readings();
  Eigen::MatrixXd made(n * at_once.rows(), states());
  // Row k of a sensor is its row of readings times the k-th power of the step.
  for (Index j = 0; j < at_once.rows(); ++j) {
    Eigen::RowVectorXd row = at_once.row(j);
    for (Index k = 0; k < n; ++k) {
      made.row(j * n + k) = row;
      row = row * step;
    }
  }
  return made;
}

SampledSystem ArmSimulator::sampled(double disturbance_N_m,
                                    const Eigen::VectorXd& deviations) const {
  const Index d = arm_.disturbance.value();
  SampledSystem made{transition(), linear_readings(),
                     Eigen::MatrixXd::Zero(states(), states()), deviations.cwiseAbs2()};
  // From sample to sample a stationary disturbance forgets 1 - e^(-2 h/T) of its variance.
  const double kept = made.transition(d, d);
  made.process_covariance(d, d) =
      std::pow(disturbance_N_m / arm_.disturbance_N_m, 2) * (1.0 - kept * kept);
  return made;
}

FilteredRun ArmSimulator::filtered(std::span<const double> torque_N_m,
                                   const Eigen::MatrixXd& measured,
                                   const FilterGains& gains) const {
  Commands commands(*this, torque_N_m);
  TimeStepper stepper(plan_, nullptr);
  SensorReadings readings(arm_, parts_, sensors_);
  FilteredRun made{.innovations = {measured.rows(), measured.cols()}};
  Eigen::VectorXd state;
  Eigen::VectorXd innovation;
  commands.step_through(stepper, [&](std::size_t k, double time_s, double actuator_N_m) {
    const auto row = static_cast<Index>(k);
    innovation = measured.row(row).transpose() - readings.read(stepper, actuator_N_m);
    innovation = innovation.array().isNaN().select(0.0, innovation);
    state = stepper.state();
    state.noalias() += gains.at(k).gain * innovation;
    if (!state.allFinite()) throw too_large("filtered state", time_s);
    stepper.put(state, stepper.motion() == HubMotion::held);
    stepper.take_up(actuator_N_m, time_s);
    made.innovations.row(row) = innovation.transpose();
    made.disturbance_N_m.push_back(
        arm_.disturbance ? arm_.disturbance_N_m * state(*arm_.disturbance) : 0.0);
    const bool is_held = stepper.motion() == HubMotion::held;
    made.hub_velocity_rad_per_s.push_back(is_held ? 0.0 : arm_.hub_velocity(stepper.state()));
    return true;
  });
  return made;
}

SimulationOptions options_of_fit(double sample_time_s, TorqueHold hold) {
  return {.sample_time_s = sample_time_s,
          .hold = hold,
          .energy = false,
          .force_tolerance = kFitForceTolerance,
          .resolve_every_mode = false,
          .precision = Precision::working};
}

}  // namespace flexarm::response
