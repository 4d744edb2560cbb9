#include "fem/modal_model.hpp"

#include "fem/sensor_row.hpp"

#include <algorithm>
#include <cmath>

namespace flexarm::fem {

arm::ModalModel modal_model(const Discretisation& discretisation, const VibrationModes& vibration,
                            std::span<const arm::Sensor> sensors,
                            std::span<const double> stations_m) {
  const arm::LinearArm& arm = discretisation.arm();
  const Eigen::Index count = 1 + vibration.omega_squared.size();
  const double omega_scale = arm::omega_scale_rad_per_s(arm);
  Eigen::VectorXd omega_squared(count);
  omega_squared << vibration.lowest_omega_squared, vibration.omega_squared;
  Eigen::MatrixXd shapes(discretisation.size(), count);
  shapes << vibration.lowest.u, vibration.shapes;
  Eigen::MatrixXd deformations(discretisation.clamped_size(), count);
  deformations << vibration.lowest.d, vibration.deformations;
  // A positive hub slope; from unit modal mass to the total inertia below.
  for (Eigen::Index j = 0; j < count; ++j) {
    if (shapes(0, j) >= 0.0) continue;
    shapes.col(j) *= -1.0;
    deformations.col(j) *= -1.0;
  }
  std::vector<SensorRow> rows;
  for (const arm::Sensor& sensor : sensors) {
    rows.emplace_back(discretisation, sensor);
  }
  const Eigen::MatrixXd damping =
      omega_scale * discretisation.damping_products<double>(shapes, deformations);

  arm::ModalModel model;
  model.modal_mass_kg_m2 = arm::total_inertia_kg_m2(arm);
  model.lowest_omega_squared_rad2_per_s2 =
      vibration.lowest_omega_squared * omega_scale * omega_scale;
  const double size = std::sqrt(discretisation.total_inertia());
  for (Eigen::Index j = 0; j < count; ++j) {
    const Eigen::VectorXd phi = size * shapes.col(j);
    arm::Mode mode;
    mode.omega_rad_per_s = omega_scale * std::sqrt(std::max(omega_squared[j], 0.0));
    mode.hub_slope = phi[0];
    if (mode.omega_rad_per_s > 0.0) {
      mode.damping_ratio = damping(j, j) / (2.0 * mode.omega_rad_per_s);
    }
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const double reading = rows[i].undamped_reading(phi, -omega_squared[j]);
      mode.sensor_values.push_back(reading * si_reading(arm, sensors[i]));
    }
    for (const double station_m : stations_m) {
      const double deflection = discretisation.deflection(phi, station_m / arm.length_m);
      mode.displacement_m.push_back(arm.length_m * deflection);
    }
    model.modes.push_back(std::move(mode));
  }
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index j = 0; j < count; ++j) {
      // Symmetric to the last bit.
      model.damping_rad_per_s.push_back((damping(i, j) + damping(j, i)) / 2.0);
    }
  }
  return model;
}

}  // namespace flexarm::fem
