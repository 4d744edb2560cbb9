#include "response/time/simulation.hpp"

#include "arm/input_error.hpp"
#include "arm/linear_arm.hpp"
#include "response/time/sensor_readings.hpp"
#include "response/time/simulation_input.hpp"
#include "response/time/time_stepper.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace flexarm::response {

namespace {

using Eigen::Index;

/// Samples between two looks at whether to go on.
constexpr std::size_t kProgressInterval = 1 << 14;

arm::InputError too_large(const std::string& what, double time_s) {
  return arm::InputError(
      fmt::format("{} at {:.6g} s: too large for a number; the torque must be smaller, or the time "
                  "shorter",
                  what, time_s));
}

/// Writes what is seen of a TimeStepper at the samples.
class Recorder {
 public:
  Recorder(const ModalDynamics& arm, const ArmParts& parts, std::span<const arm::Sensor> sensors,
           std::size_t samples)
      : sensors_(sensors.begin(), sensors.end()), readings_(arm, parts, sensors) {
    made_.time_s.reserve(samples);
    made_.commanded_torque_N_m.reserve(samples);
    made_.hub_torque_N_m.reserve(samples);
    made_.channels.resize(sensors.size());
    for (auto& channel : made_.channels) channel.reserve(samples);
  }

  void record(const TimeStepper& stepper, double time_s, double command_N_m, double actuator_N_m) {
    made_.time_s.push_back(time_s);
    made_.commanded_torque_N_m.push_back(command_N_m);
    made_.hub_torque_N_m.push_back(stepper.hub_torque_N_m(actuator_N_m));
    if (!std::isfinite(made_.hub_torque_N_m.back())) throw too_large("torque at the hub", time_s);
    const Eigen::VectorXd& now = readings_.read(stepper, actuator_N_m);
    for (std::size_t j = 0; j < made_.channels.size(); ++j) {
      const double reading = now(static_cast<Index>(j));
      if (!std::isfinite(reading)) throw too_large(arm::to_string(sensors_[j]), time_s);
      made_.channels[j].push_back(reading);
    }
  }

  Simulation& made() { return made_; }

 private:
  std::vector<arm::Sensor> sensors_;
  SensorReadings readings_;
  Simulation made_;
};

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

double EnergyBalance::dissipated_J() const {
  return viscous_J + material_air_J + dry_friction_J + drag_J;
}

double EnergyBalance::residual_J() const {
  return work_in_J - kinetic_J - potential_J - dissipated_J();
}

Simulation simulate(const arm::ModalModel& model, const ArmParts& parts,
                    std::span<const arm::Sensor> sensors, std::span<const double> torque_N_m,
                    const SimulationOptions& options, const SimulationProgress& progress) {
  require_simulable(parts, torque_N_m, options);
  const bool has_drag = parts.quadratic_drag_N_s2_per_m3 > 0.0;
  const ModalDynamics arm = modal_dynamics(model, parts, sensors, has_drag);
  std::optional<QuadraticDrag> drag;
  if (has_drag) drag.emplace(model, parts.linear.beam.length_m, parts.quadratic_drag_N_s2_per_m3);
  const AddedForces forces(arm, parts, std::move(drag));
  const TorquePath path(parts.actuator, torque_N_m, options.sample_time_s, options.hold);
  std::optional<EnergyLedger> ledger;
  if (options.energy) {
    ledger.emplace(arm, forces, arm::linear_arm(parts.linear).hub_viscous_friction_N_m_s_per_rad);
  }
  TimeStepper stepper(arm, forces, !parts.friction.is_zero(), path, options,
                      ledger ? &*ledger : nullptr);
  Recorder recorder(arm, parts, sensors, torque_N_m.size());
  TorquePath::Pieces pieces;
  bool go_on = true;
  for (std::size_t k = 0; k < torque_N_m.size() && go_on; ++k) {
    const double time_s = static_cast<double>(k) * options.sample_time_s;
    path.pieces(k, pieces);
    stepper.take_up(pieces.front().begin_N_m, time_s);
    recorder.record(stepper, time_s, torque_N_m[k], pieces.front().begin_N_m);
    if (ledger) {
      ledger->close_sample(stepper.state());
      const double energy_J = ledger->balance().residual_J();
      if (!std::isfinite(energy_J)) throw too_large("energy", time_s);
    }
    if (k + 1 == torque_N_m.size()) break;
    for (const TorquePiece& piece : pieces) {
      const double begin_s = time_s + piece.begin * options.sample_time_s;
      if (piece.begin > 0.0) stepper.take_up(piece.begin_N_m, begin_s);
      stepper.advance(piece, begin_s);
    }
    if (progress && k % kProgressInterval == 0) {
      go_on = progress(static_cast<double>(k) / static_cast<double>(torque_N_m.size()));
    }
  }
  Simulation made = std::move(recorder.made());
  if (ledger) made.energy = ledger->balance();
  made.summary = stepper.summary();
  made.summary.most_iterations = stepper.most_iterations();
  made.summary.completed = go_on;
  made.summary.steps = static_cast<std::int64_t>(made.time_s.size()) - (go_on ? 1 : 0);
  made.summary.samples_per_period = samples_per_period(arm, options.sample_time_s);
  made.summary.sampling = sampling(made.summary.samples_per_period);
  return made;
}

}  // namespace flexarm::response
