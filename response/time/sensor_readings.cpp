#include "response/time/sensor_readings.hpp"

namespace flexarm::response {

using Eigen::Index;

SensorReadings::Stack::Stack(const LinearSystem& system)
    : state(static_cast<Index>(system.sensors.size()), system.a.rows()),
      actuator(state.rows()),
      force(state.rows(), system.force.cols()) {
  for (Index j = 0; j < state.rows(); ++j) {
    const Reading& reading = system.sensors[static_cast<std::size_t>(j)];
    state.row(j) = reading.state;
    actuator(j) = reading.actuator;
    force.row(j) = reading.force;
  }
}

SensorReadings::SensorReadings(const ModalDynamics& arm, const ArmParts& parts,
                               std::span<const arm::Sensor> sensors)
    : turning_(arm.turning),
      held_(arm.held),
      gain_(turning_.state.rows()),
      offset_(turning_.state.rows()),
      now_(turning_.state.rows()) {
  for (std::size_t j = 0; j < sensors.size(); ++j) {
    const auto row = static_cast<Index>(j);
    const SensorChain chain = chain_of(parts.sensor_chains, sensors[j]);
    gain_(row) = chain.gain;
    offset_(row) = chain.offset;
    if (chain.lag_s > 0.0) continue;
    if (sensors[j].kind == arm::SensorKind::hub_angle) hub_angles_.push_back(row);
    if (sensors[j].kind == arm::SensorKind::hub_velocity) hub_velocities_.push_back(row);
  }
}

const Eigen::VectorXd& SensorReadings::read(const TimeStepper& stepper, double actuator_N_m) {
  const bool is_held = stepper.motion() == HubMotion::held;
  stepper.form_force(actuator_N_m, force_);
  return read(stepper.state(), force_, actuator_N_m,
              is_held ? std::optional(stepper.hub_angle()) : std::nullopt);
}

const Eigen::VectorXd& SensorReadings::read(const Eigen::VectorXd& x, const Eigen::VectorXd& f,
                                            double actuator_N_m,
                                            std::optional<double> held_angle_rad) {
  const Stack& readings = held_angle_rad ? held_ : turning_;
  now_.noalias() = readings.state * x;
  now_ += readings.actuator * actuator_N_m;
  now_.noalias() += readings.force * f;
  if (held_angle_rad) {
    for (const Index j : hub_angles_) now_(j) = gain_(j) * *held_angle_rad;
    for (const Index j : hub_velocities_) now_(j) = 0.0;
  }
  now_ += offset_;
  return now_;
}

}  // namespace flexarm::response
