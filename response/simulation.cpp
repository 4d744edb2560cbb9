#include "response/simulation.hpp"

#include "arm/input_error.hpp"
#include "response/modal_dynamics.hpp"
#include "response/propagator.hpp"
#include "response/torque_path.hpp"

#include <cmath>

namespace flexarm::response {

double EnergyBalance::dissipated_J() const {
  return viscous_J + material_air_J + dry_friction_J + drag_J;
}

double EnergyBalance::residual_J() const {
  return work_in_J - kinetic_J - potential_J - dissipated_J();
}

Simulation simulate(const arm::ModalModel& model, const ArmParts& parts,
                    std::span<const arm::Sensor> sensors, std::span<const double> torque_N_m,
                    const SimulationOptions& options, const SimulationProgress&) {
  if (!parts.friction.is_zero() || parts.quadratic_drag_N_s2_per_m3 != 0.0 ||
      parts.actuator.ripple || std::isfinite(parts.actuator.saturation_N_m) ||
      parts.actuator.dead_zone_N_m != 0.0) {
    throw arm::InputError("effects: only linear ones are simulated");
  }
  const double h = options.sample_time_s;
  const ModalDynamics arm = modal_dynamics(model, parts, sensors, false);
  const TorquePath path(parts.actuator, torque_N_m, h, options.hold);
  const double phi = path.delay_fraction();
  const Propagator whole = propagator(arm.turning, h);
  const Propagator before = phi > 0.0 ? propagator(arm.turning, phi * h) : whole;
  const Propagator after = phi > 0.0 ? propagator(arm.turning, (1.0 - phi) * h) : whole;
  const double bias = parts.actuator.bias_N_m;

  Simulation made;
  made.channels.resize(sensors.size());
  Eigen::VectorXd x = Eigen::VectorXd::Zero(arm.size());
  TorquePath::Pieces pieces;
  for (std::size_t k = 0; k < torque_N_m.size(); ++k) {
    path.pieces(k, pieces);
    const double u = pieces.front().begin_N_m;
    made.time_s.push_back(static_cast<double>(k) * h);
    made.commanded_torque_N_m.push_back(torque_N_m[k]);
    made.hub_torque_N_m.push_back(arm.hub_torque.state * x + arm.hub_torque.actuator * u + bias);
    for (std::size_t j = 0; j < sensors.size(); ++j) {
      const Reading& read = arm.turning.sensors[j];
      made.channels[j].push_back(read.state.dot(x) + read.actuator * u + read.force(0) * bias);
    }
    for (const auto& piece : pieces) {
      const Propagator& step = piece.length == TorquePiece::Length::whole          ? whole
                               : piece.length == TorquePiece::Length::before_delay ? before
                                                                                   : after;
      x = (step.state * x + step.actuator_begin * piece.begin_N_m +
           step.actuator_end * piece.end_N_m + step.constant_force() * bias)
              .eval();
    }
  }
  return made;
}

}  // namespace flexarm::response
