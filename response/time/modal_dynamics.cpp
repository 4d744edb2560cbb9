#include "response/time/modal_dynamics.hpp"

#include "arm/input_error.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>

namespace flexarm::response {

namespace {

using Eigen::Index;

void require_complete(const arm::ModalModel& model, std::size_t sensors) {
  const std::size_t n = model.modes.size();
  if (n == 0) throw arm::InputError("modes: the modal model has none");
  if (model.damping_rad_per_s.size() != n * n) {
    throw arm::InputError(fmt::format("modes: the modal model has {} damping entries: must be {}",
                                      model.damping_rad_per_s.size(), n * n));
  }
  arm::require_in_range("modal mass", model.modal_mass_kg_m2, "kg m^2", arm::kPositive);
  for (const auto& mode : model.modes) {
    if (mode.sensor_values.size() != sensors) {
      throw arm::InputError(fmt::format("modes: a mode has {} sensor values: must be {}",
                                        mode.sensor_values.size(), sensors));
    }
  }
}

/// Where Z, W, d and the laws' own states stand in X.
struct Layout {
  Index n = 0;
  bool modal_forces = false;  // f is n modal forces, else one torque on the hub
  std::optional<Index> lagged_torque;
  std::vector<std::optional<Index>> lagged_readings;  // one a sensor
  std::optional<Index> disturbance;
  Index law_states = 0;  // of laws of hub torque, at the end of X and f
  Index size = 0;

  Index forces() const { return arm_forces() + law_states; }
  Index arm_forces() const { return modal_forces ? n : 1; }
};

/// The equations of motion without lags: modal accelerations p' = state X + actuator u + force f.
struct Accelerations {
  Eigen::MatrixXd state;
  Eigen::VectorXd actuator;
  Eigen::MatrixXd force;
};

/// Torque per unit of Z and of d: the column of A is then as long as sigma_0.
double torque_scale(const ModalDynamics& arm) {
  return arm.scale_rad_per_s(0) * arm.modal_mass_kg_m2 / arm.hub_slope.norm();
}

Accelerations accelerations(const ModalDynamics& arm, const Layout& layout) {
  const Eigen::VectorXd per_torque = arm.hub_slope / arm.modal_mass_kg_m2;
  Accelerations made;
  made.state.setZero(layout.n, layout.size);
  made.state.leftCols(layout.n) =
      (-arm.stiffness.array() / arm.scale_rad_per_s.array()).matrix().asDiagonal();
  made.state.middleCols(layout.n, layout.n) = -arm.damping;
  made.actuator.setZero(layout.n);
  if (layout.lagged_torque) {
    made.state.col(*layout.lagged_torque) = per_torque * torque_scale(arm);
  } else {
    made.actuator = per_torque;
  }
  if (layout.disturbance) made.state.col(*layout.disturbance) = per_torque * torque_scale(arm);
  made.force.setZero(layout.n, layout.forces());
  if (layout.modal_forces) {
    made.force.leftCols(layout.n).setIdentity();
  } else {
    made.force.col(0) = per_torque;
  }
  return made;
}

Accelerations held_hub(const Accelerations& free, const Eigen::VectorXd& hub_slope,
                       const Layout& layout) {
  const Index n = layout.n;
  const Eigen::VectorXd b = hub_slope.normalized();
  const Eigen::MatrixXd project = Eigen::MatrixXd::Identity(n, n) - b * b.transpose();
  // Torque on the hub is taken out to the last bit, not to rounding.
  return {project * free.state, Eigen::VectorXd::Zero(n),
          layout.modal_forces ? Eigen::MatrixXd(project * free.force)
                              : Eigen::MatrixXd::Zero(n, layout.forces()).eval()};
}

/// The hub's acceleration is the command.
Accelerations driven_hub(const Accelerations& held, const Eigen::VectorXd& hub_slope) {
  return {held.state, hub_slope / hub_slope.squaredNorm(), held.force};
}

Reading zero_reading(const Layout& layout) {
  return {Eigen::RowVectorXd::Zero(layout.size), 0.0, Eigen::RowVectorXd::Zero(layout.forces())};
}

/// What a sensor with these modal values shows before gain and lag.
Reading reading(const ModalDynamics& arm, const Layout& layout, const Accelerations& motion,
                const Eigen::RowVectorXd& values, int derivatives) {
  Reading made = zero_reading(layout);
  if (derivatives == 0) {
    made.state.head(layout.n) = values.array() / arm.scale_rad_per_s.transpose().array();
  } else if (derivatives == 1) {
    made.state.segment(layout.n, layout.n) = values;
  } else {
    made = {values * motion.state, values * motion.actuator, values * motion.force};
  }
  return made;
}

Reading amplified(Reading reading, double gain) {
  reading.state *= gain;
  reading.actuator *= gain;
  reading.force *= gain;
  return reading;
}

/// The system with these accelerations; `sensors` are the readings with gain and lag.
LinearSystem assemble(const ModalDynamics& arm, const ArmParts& parts, const Layout& layout,
                      const Accelerations& motion, std::span<const arm::Sensor> sensors,
                      const arm::ModalModel& model) {
  LinearSystem system;
  system.a.setZero(layout.size, layout.size);
  system.a.block(0, layout.n, layout.n, layout.n) = arm.scale_rad_per_s.asDiagonal();
  system.a.middleRows(layout.n, layout.n) = motion.state;
  system.actuator.setZero(layout.size);
  system.actuator.segment(layout.n, layout.n) = motion.actuator;
  system.force.setZero(layout.size, layout.forces());
  system.force.middleRows(layout.n, layout.n) = motion.force;
  system.force.bottomRightCorner(layout.law_states, layout.law_states).setIdentity();
  if (layout.disturbance && !parts.disturbance->is_white()) {
    system.a(*layout.disturbance, *layout.disturbance) =
        -1.0 / parts.disturbance->correlation_time_s;
  }
  if (layout.lagged_torque) {
    const double rate = 1.0 / parts.actuator.lag_s;
    system.a(*layout.lagged_torque, *layout.lagged_torque) = -rate;
    system.actuator(*layout.lagged_torque) = rate / torque_scale(arm);
  }
  system.hub_acceleration = {arm.hub_slope.transpose() * motion.state,
                             arm.hub_slope.dot(motion.actuator),
                             arm.hub_slope.transpose() * motion.force};
  for (std::size_t j = 0; j < sensors.size(); ++j) {
    Eigen::RowVectorXd values(layout.n);
    for (Index i = 0; i < layout.n; ++i) {
      values(i) = model.modes[static_cast<std::size_t>(i)].sensor_values[j];
    }
    const SensorChain chain = chain_of(parts.sensor_chains, sensors[j]);
    Reading read = amplified(
        reading(arm, layout, motion, values, arm::derivative_order(sensors[j])), chain.gain);
    if (layout.lagged_readings[j]) {
      const Index w = *layout.lagged_readings[j];
      const double rate = 1.0 / chain.lag_s;
      const double sum = read.state.cwiseAbs().sum();
      const double scale = sum > 0.0 ? sum : 1.0;
      system.a.row(w) = read.state * (rate / scale);
      system.a(w, w) = -rate;
      system.actuator(w) = read.actuator * rate / scale;
      system.force.row(w) = read.force * (rate / scale);
      read = zero_reading(layout);
      read.state(w) = scale;
      system.lagged_readings.push_back(w);
    }
    system.sensors.push_back(std::move(read));
  }
  return system;
}

Layout layout_of(const arm::ModalModel& model, const ArmParts& parts,
                 std::span<const arm::Sensor> sensors, bool modal_forces) {
  Layout layout;
  layout.n = static_cast<Index>(model.modes.size());
  layout.modal_forces = modal_forces;
  layout.size = 2 * layout.n;
  if (parts.actuator.lag_s > 0.0) layout.lagged_torque = layout.size++;
  for (const arm::Sensor& sensor : sensors) {
    const bool is_lagged = chain_of(parts.sensor_chains, sensor).lag_s > 0.0;
    layout.lagged_readings.push_back(is_lagged ? std::optional(layout.size++) : std::nullopt);
  }
  if (parts.disturbance) layout.disturbance = layout.size++;
  for (const auto& [effect, law] : parts.hub.smooth) layout.law_states += law.states;
  layout.size += layout.law_states;
  return layout;
}

/// The coordinates and their numbers.
ModalDynamics coordinates(const arm::ModalModel& model, const Layout& layout) {
  ModalDynamics arm;
  arm.modes = layout.n;
  arm.modal_mass_kg_m2 = model.modal_mass_kg_m2;
  arm.hub_slope.resize(layout.n);
  arm.stiffness.resize(layout.n);
  for (Index i = 0; i < layout.n; ++i) {
    const auto& mode = model.modes[static_cast<std::size_t>(i)];
    arm.hub_slope(i) = mode.hub_slope;
    arm.stiffness(i) = mode.omega_rad_per_s * mode.omega_rad_per_s;
  }
  arm.stiffness(0) = model.lowest_omega_squared_rad2_per_s2;
  arm.damping =
      Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
          model.damping_rad_per_s.data(), layout.n, layout.n);
  arm.scale_rad_per_s = arm.stiffness.cwiseAbs().cwiseSqrt();
  const double least = layout.n > 1 ? arm.scale_rad_per_s(1) : arm.scale_rad_per_s(0);
  arm.scale_rad_per_s = arm.scale_rad_per_s.cwiseMax(least > 0.0 ? least : 1.0);
  if (!arm.hub_slope.allFinite() || !arm.stiffness.allFinite() || !arm.damping.allFinite() ||
      arm.hub_slope.norm() == 0.0) {
    throw arm::InputError("modes: the modal model is not finite, or no torque reaches it");
  }
  return arm;
}

}  // namespace

double fastest_rate_rad_per_s(const LinearSystem& system) {
  Eigen::VectorXd rates = system.a.cwiseAbs().rowwise().sum();
  rates(system.lagged_readings).setZero();
  return rates.maxCoeff();
}

double ModalDynamics::hub_angle(const Eigen::VectorXd& x) const {
  return (hub_slope.array() * x.head(modes).array() / scale_rad_per_s.array()).sum();
}

void ModalDynamics::stop_hub(Eigen::VectorXd& x) const {
  auto p = x.segment(modes, modes);
  p -= hub_slope * (hub_slope.dot(p) / hub_slope.squaredNorm());
}

void ModalDynamics::set_hub_angle(Eigen::VectorXd& x, double angle_rad) const {
  const double excess = hub_angle(x) - angle_rad;
  x.head(modes).array() -=
      scale_rad_per_s.array() * hub_slope.array() * (excess / hub_slope.squaredNorm());
}

ModalDynamics with_settled_torque(const ModalDynamics& arm) {
  ModalDynamics made = arm;
  const Index z = *arm.lagged_torque;
  for (LinearSystem* system : {&made.turning, &made.held}) {
    system->actuator_rate.setZero(system->a.rows());
    system->actuator_rate(z) = -system->actuator(z) / system->a(z, z);
    system->actuator(z) = 0.0;
    system->a.row(z).setZero();
  }
  made.fastest_rate_rad_per_s = fastest_rate_rad_per_s(made.turning);
  return made;
}

ModalDynamics modal_dynamics(const arm::ModalModel& model, const ArmParts& parts,
                             std::span<const arm::Sensor> sensors) {
  const bool modal_forces = !parts.beam_forces.empty();
  require_complete(model, sensors.size());
  if (parts.disturbance) {
    arm::require_in_range("correlation time", parts.disturbance->correlation_time_s, "s",
                          arm::kNotNegative);
  }
  const Layout layout = layout_of(model, parts, sensors, modal_forces);
  ModalDynamics arm = coordinates(model, layout);
  const Accelerations free = accelerations(arm, layout);
  const Accelerations held = held_hub(free, arm.hub_slope, layout);
  const Accelerations turning = parts.hub_is_driven ? driven_hub(held, arm.hub_slope) : free;
  arm.turning = assemble(arm, parts, layout, turning, sensors, model);
  arm.held = assemble(arm, parts, layout, held, sensors, model);
  arm.first_law_state = layout.size - layout.law_states;
  arm.law_state_count = layout.law_states;
  arm.lagged_torque = layout.lagged_torque;
  arm.disturbance = layout.disturbance;
  if (layout.disturbance) arm.disturbance_N_m = torque_scale(arm);
  arm.hub_force.setZero(layout.forces());
  if (modal_forces) {
    arm.hub_force.head(layout.n) = arm.hub_slope / arm.modal_mass_kg_m2;
  } else {
    arm.hub_force(0) = 1.0;
  }
  arm.hub_torque = zero_reading(layout);
  if (layout.lagged_torque) {
    arm.hub_torque.state(*layout.lagged_torque) = torque_scale(arm);
  } else {
    arm.hub_torque.actuator = 1.0;
  }
  arm.reaction = arm.turning.hub_acceleration;
  const double inertia = arm.modal_mass_kg_m2 / arm.hub_slope.squaredNorm();
  arm.reaction.state *= inertia;
  arm.reaction.force *= inertia;
  // Torque on the hub counts to the last bit: friction holds against just its size.
  arm.reaction.actuator = arm.hub_torque.actuator;
  if (layout.lagged_torque) arm.reaction.state(*layout.lagged_torque) = torque_scale(arm);
  if (layout.disturbance) arm.reaction.state(*layout.disturbance) = torque_scale(arm);
  if (!modal_forces) arm.reaction.force(0) = 1.0;
  arm.fastest_rate_rad_per_s = fastest_rate_rad_per_s(arm.turning);
  return arm;
}

}  // namespace flexarm::response
