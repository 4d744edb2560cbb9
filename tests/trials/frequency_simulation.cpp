#include "tests/trials/frequency_simulation.hpp"

#include "tests/trials/element_modes.hpp"
#include "tests/trials/plant.hpp"

#include <cmath>
#include <numbers>

namespace flexarm::trials {

namespace {

using Complex = std::complex<double>;

/// T/tau.
Complex chain_response(const TrueArm& arm, Complex s) {
  double gain = 1.0;
  for (const auto& curve : arm.torque_curves) gain *= curve.slope;
  return gain * std::exp(-s * arm.torque_delay_s) / (1.0 + s * arm.torque_lag_s);
}

/// What is recorded per value of the sensor; an offset does not come back with the torque.
Complex recorded(const TrueArm& arm, const arm::Sensor& sensor, Complex s) {
  const TrueArm::SensorPath path = known_path(arm, sensor);
  return path.gain * std::exp(-s * path.delay_s) / (1.0 + s * path.time_constant_s);
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
  const TrueArm arm = true_arm(world);
  const ElementModel model(arm, PlantOptions{}.elements, really_placed(arm, sensors));
  std::vector<std::vector<Complex>> responses(sensors.size());
  for (const double frequency : frequency_Hz) {
    const Complex s(0.0, 2.0 * std::numbers::pi * frequency);
    const Eigen::VectorXcd u = motion_per_torque(model, s);
    for (std::size_t i = 0; i < sensors.size(); ++i) {
      const Complex value =
          std::pow(s, arm::derivative_order(sensors[i])) * model.reading(i).of(u, s);
      responses[i].push_back(value * chain_response(arm, s) * recorded(arm, sensors[i], s));
    }
  }
  return responses;
}

measured::ModalTable poles_and_zeros(const World& world, int count) {
  const ElementModel model(true_arm(world), PlantOptions{}.elements);
  measured::ModalTable table;
  int order = 0;
  for (const Complex pole : damped_poles_rad_per_s(model, count)) {
    table.push_back(entry(measured::Feature::pole, ++order, std::abs(pole)));
    table.back().damping_ratio = -pole.real() / std::abs(pole);
  }
  order = 0;
  for (const double omega : held_omegas_rad_per_s(model, count)) {
    table.push_back(entry(measured::Feature::zero, ++order, omega));
  }
  return table;
}

}  // namespace flexarm::trials
