#include "response/time/arm_simulator.hpp"

#include "arm/input_error.hpp"
#include "arm/linear_arm.hpp"
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

/// Steps through the samples of a torque; `at_sample(k, time, actuator torque)`, called at each,
/// says whether to go on. The last sample is looked at, not stepped from.
template <class AtSample>
void step_through(TimeStepper& stepper, const TorquePath& path, double sample_time_s,
                  std::size_t samples, AtSample at_sample) {
  TorquePath::Pieces pieces;
  for (std::size_t k = 0; k < samples; ++k) {
    const double time_s = static_cast<double>(k) * sample_time_s;
    path.pieces(k, pieces);
    stepper.take_up(pieces.front().begin_N_m, time_s);
    if (!at_sample(k, time_s, pieces.front().begin_N_m) || k + 1 == samples) return;
    for (const TorquePiece& piece : pieces) {
      const double begin_s = time_s + piece.begin * sample_time_s;
      if (piece.begin > 0.0) stepper.take_up(piece.begin_N_m, begin_s);
      stepper.advance(piece, begin_s);
    }
  }
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
      plan_(arm_, forces_, parts.actuator, options, ledger_ ? &*ledger_ : nullptr) {}

Simulation ArmSimulator::run(std::span<const double> torque_N_m,
                             const SimulationProgress& progress) const {
  require_simulable(parts_, torque_N_m, options_);
  const TorquePath path(parts_.actuator, torque_N_m, options_.sample_time_s, options_.hold);
  std::optional<EnergyLedger> ledger = ledger_;
  TimeStepper stepper(plan_, ledger ? &*ledger : nullptr);
  SensorReadings readings(arm_, parts_, sensors_);
  Simulation made;
  made.channels.resize(sensors_.size());
  bool go_on = true;
  const auto record = [&](std::size_t k, double time_s, double actuator_N_m) {
    made.time_s.push_back(time_s);
    made.commanded_torque_N_m.push_back(torque_N_m[k]);
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
    if (progress && k % kProgressInterval == 0 && k + 1 < torque_N_m.size()) {
      go_on = progress(static_cast<double>(k) / static_cast<double>(torque_N_m.size()));
    }
    return go_on;
  };
  step_through(stepper, path, options_.sample_time_s, torque_N_m.size(), record);
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
  require_simulable(parts_, torque_N_m, options_);
  const TorquePath path(parts_.actuator, torque_N_m, options_.sample_time_s, options_.hold);
  TimeStepper stepper(plan_, nullptr);
  if (initial.size() > 0) stepper.put(initial, false);
  SensorReadings readings(arm_, parts_, sensors_);
  Eigen::MatrixXd made(static_cast<Index>(torque_N_m.size()), static_cast<Index>(sensors_.size()));
  step_through(stepper, path, options_.sample_time_s, torque_N_m.size(),
               [&](std::size_t k, double time_s, double actuator_N_m) {
                 const Eigen::VectorXd& now = readings.read(stepper, actuator_N_m);
                 if (!now.allFinite()) throw too_large("reading", time_s);
                 made.row(static_cast<Index>(k)) = now.transpose();
                 return true;
               });
  return made;
}

Eigen::MatrixXd ArmSimulator::free_readings(std::size_t samples) const {
  const auto n = static_cast<Index>(samples);
  const Eigen::MatrixXd step =
      propagator(arm_.turning, options_.sample_time_s, 1.0, options_.precision).state;
  const auto& sensors = arm_.turning.sensors;
  Eigen::MatrixXd made(n * static_cast<Index>(sensors.size()), states());
  // Row k of a sensor is its row of readings times the k-th power of the step.
  for (std::size_t j = 0; j < sensors.size(); ++j) {
    Eigen::RowVectorXd row = sensors[j].state;
    for (Index k = 0; k < n; ++k) {
      made.row(static_cast<Index>(j) * n + k) = row;
      row = row * step;
    }
  }
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
