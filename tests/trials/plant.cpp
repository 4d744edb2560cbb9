#include "tests/trials/plant.hpp"

#include "fem/fem_arm.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace flexarm::trials {

namespace {

constexpr int kStationIntervals = 80;  // even, for Simpson's rule

std::vector<double> even_stations(double length_m) {
  std::vector<double> stations;
  for (int i = 0; i <= kStationIntervals; ++i) {
    stations.push_back(i == kStationIntervals ? length_m : length_m * i / kStationIntervals);
  }
  return stations;
}

Eigen::VectorXd simpson_weights(double length_m) {
  Eigen::VectorXd weights(kStationIntervals + 1);
  for (int i = 0; i <= kStationIntervals; ++i) weights(i) = i % 2 == 0 ? 2.0 : 4.0;
  weights(0) = weights(kStationIntervals) = 1.0;
  return weights * (length_m / kStationIntervals / 3.0);
}

Eigen::Map<const Eigen::VectorXd> column(const std::vector<double>& values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

/// A mass m on k = m w^2 and c = 2 zeta m w at a place where y = phi^T q. Its displacement is
/// sqrt(I/m) times the further coordinate, so that all modal masses are I.
void add_tuned_mass(Plant& plant, const Eigen::VectorXd& phi,
                    const std::map<std::string, double>& of) {
  const double omega = 2.0 * std::numbers::pi * of.at("frequency");
  const double mass = of.at("mass");
  const Eigen::Index n = plant.hub.size();
  Eigen::VectorXd stretch(n + 1);  // of the spring
  stretch << phi, -std::sqrt(plant.modal_mass_kg_m2 / mass);
  const Eigen::MatrixXd square = mass / plant.modal_mass_kg_m2 * stretch * stretch.transpose();
  const auto widen = [n](Eigen::MatrixXd& matrix) {
    matrix.conservativeResizeLike(Eigen::MatrixXd::Zero(n + 1, n + 1));
  };
  widen(plant.damping);
  widen(plant.stiffness);
  plant.damping += 2.0 * of.at("damping_ratio") * omega * square;
  plant.stiffness += omega * omega * square;
  plant.hub.conservativeResizeLike(Eigen::VectorXd::Zero(n + 1));
  plant.readings.conservativeResizeLike(Eigen::MatrixXd::Zero(plant.readings.rows(), n + 1));
  plant.stations.conservativeResizeLike(Eigen::MatrixXd::Zero(plant.stations.rows(), n + 1));
}

}  // namespace

Plant make_plant(const World& world, std::span<const arm::Sensor> sensors,
                 const PlantOptions& options) {
  const fem::FemArm model(linear_part(world.arm),
                          {.mesh = {.elements = options.elements}, .degree = 3});
  const double length_m = world.arm.beam.length_m;
  std::vector<double> stations_m = even_stations(length_m);
  const auto tuned = world.outside.find("tuned_mass");
  const bool has_tuned_mass = tuned != world.outside.end();
  if (has_tuned_mass) stations_m.push_back(tuned->second.at("position"));
  const arm::ModalModel modes = model.modal_model(options.flexible_modes, sensors, stations_m);

  const auto n = static_cast<Eigen::Index>(modes.modes.size());
  Plant plant;
  plant.modal_mass_kg_m2 = modes.modal_mass_kg_m2;
  plant.damping = Eigen::Map<const Eigen::MatrixXd>(modes.damping_rad_per_s.data(), n, n);
  plant.stiffness = Eigen::MatrixXd::Zero(n, n);
  plant.hub.resize(n);
  plant.readings.resize(static_cast<Eigen::Index>(sensors.size()), n);
  Eigen::MatrixXd displacements(static_cast<Eigen::Index>(stations_m.size()), n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const arm::Mode& mode = modes.modes[static_cast<std::size_t>(i)];
    plant.stiffness(i, i) = i == 0 ? modes.lowest_omega_squared_rad2_per_s2
                                   : mode.omega_rad_per_s * mode.omega_rad_per_s;
    plant.hub(i) = mode.hub_slope;
    plant.readings.col(i) = column(mode.sensor_values);
    displacements.col(i) = column(mode.displacement_m);
  }
  plant.stations = displacements.topRows(kStationIntervals + 1);
  plant.station_weights_m = simpson_weights(length_m);
  if (has_tuned_mass) {
    add_tuned_mass(plant, displacements.row(kStationIntervals + 1).transpose(), tuned->second);
  }
  return plant;
}

}  // namespace flexarm::trials
