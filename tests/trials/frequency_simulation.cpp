#include "tests/trials/frequency_simulation.hpp"

#include "fem/fem_arm.hpp"
#include "tests/trials/plant.hpp"

#include <Eigen/LU>

#include <cmath>
#include <numbers>

namespace flexarm::trials {

namespace {

using Complex = std::complex<double>;

fem::FemArm full_model(const World& world) {
  return {linear_part(world.arm), {.mesh = {.elements = PlantOptions{}.elements}, .degree = 3}};
}

/// T/tau.
Complex chain_response(const arm::Arm& arm, Complex s) {
  return effect_value(arm, "torque_gain", "factor", 1.0) *
         std::exp(-s * effect_value(arm, "time_delay", "delay", 0.0)) /
         (1.0 + s * effect_value(arm, "actuator_lag", "time_constant", 0.0));
}

Complex lag_response(const arm::Arm& arm, const arm::Sensor& sensor, Complex s) {
  const auto lag = arm.effects.find("sensor_lag");
  if (lag == arm.effects.end()) return 1.0;
  const std::string name = lag->second.sensor.empty() ? "tip_acceleration" : lag->second.sensor;
  if (arm::to_string(sensor) != name) return 1.0;
  return 1.0 / (1.0 + s * lag->second.parameters.at("time_constant"));
}

/// (s^2 + s D + W) q = hub/I.
Eigen::VectorXcd modal_response(const Plant& plant, Complex s) {
  const Eigen::Index n = plant.hub.size();
  const Eigen::MatrixXcd dynamic = s * s * Eigen::MatrixXcd::Identity(n, n) + s * plant.damping +
                                   plant.stiffness.cast<Complex>();
  return dynamic.partialPivLu().solve(plant.hub.cast<Complex>()) / plant.modal_mass_kg_m2;
}

measured::ModalEntry entry(measured::Feature feature, int order, double omega_rad_per_s) {
  measured::ModalEntry made;
  made.sensor = arm::Sensor{arm::SensorKind::hub_angle, 0.0};
  made.feature = feature;
  made.order = order;
  made.frequency_Hz = omega_rad_per_s / (2.0 * std::numbers::pi);
  return made;
}

}  // namespace

std::vector<std::vector<Complex>> frequency_responses(const World& world,
                                                      std::span<const arm::Sensor> sensors,
                                                      std::span<const double> frequency_Hz) {
  const bool by_modes = !world.outside.empty();
  const fem::FemArm model = full_model(world);
  const Plant plant = make_plant(world, sensors, {.flexible_modes = 20});
  std::vector<std::vector<Complex>> responses(sensors.size());
  for (const double frequency : frequency_Hz) {
    const Complex s(0.0, 2.0 * std::numbers::pi * frequency);
    const Eigen::VectorXcd q = by_modes ? modal_response(plant, s) : Eigen::VectorXcd();
    for (std::size_t i = 0; i < sensors.size(); ++i) {
      const auto row = plant.readings.row(static_cast<Eigen::Index>(i));
      const Complex value =
          by_modes ? std::pow(s, arm::derivative_order(sensors[i])) * (row.cast<Complex>() * q)(0)
                   : model.transfer_function(sensors[i], s);
      responses[i].push_back(value * chain_response(world.arm, s) *
                             lag_response(world.arm, sensors[i], s));
    }
  }
  return responses;
}

measured::ModalTable poles_and_zeros(const World& world, int count) {
  const fem::FemArm model = full_model(world);
  measured::ModalTable table;
  int order = 0;
  for (const auto& pair : model.damped_poles(count).flexible) {
    const double omega = std::abs(pair.first_rad_per_s);
    table.push_back(entry(measured::Feature::pole, ++order, omega));
    table.back().damping_ratio = -pair.first_rad_per_s.real() / omega;
  }
  order = 0;
  for (const auto& zero : model.zeros({arm::SensorKind::hub_angle, 0.0}, count).s_rad_per_s) {
    table.push_back(entry(measured::Feature::zero, ++order, std::abs(zero)));
  }
  return table;
}

}  // namespace flexarm::trials
