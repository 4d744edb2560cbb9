#include "tests/trials/plant.hpp"

#include "tests/trials/element_modes.hpp"

namespace flexarm::trials {

namespace {

constexpr int kStationIntervals = 80;  // even, for Simpson's rule

Eigen::VectorXd simpson_weights(double length_m) {
  Eigen::VectorXd weights(kStationIntervals + 1);
  for (int i = 0; i <= kStationIntervals; ++i) weights(i) = i % 2 == 0 ? 2.0 : 4.0;
  weights(0) = weights(kStationIntervals) = 1.0;
  return weights * (length_m / kStationIntervals / 3.0);
}

}  // namespace

Plant make_plant(const TrueArm& arm, std::span<const arm::Sensor> sensors,
                 const PlantOptions& options) {
  const ElementModel model(arm, options.elements, sensors);
  const auto attached = static_cast<Eigen::Index>(arm.attached.size());
  const ElementModes modes = undamped_modes(model, options.flexible_modes + attached);
  const Eigen::Index n = modes.shapes.cols();
  Plant plant;
  plant.modal_mass_kg_m2 = modes.modal_mass_kg_m2;
  plant.damping =
      modes.shapes.transpose() * model.damping() * modes.shapes / modes.modal_mass_kg_m2;
  plant.stiffness = modes.omega_squared_rad2_per_s2.asDiagonal();
  plant.hub = modes.shapes.row(ElementModel::kHub).transpose();
  plant.readings.resize(static_cast<Eigen::Index>(sensors.size()), n);
  for (std::size_t s = 0; s < sensors.size(); ++s) {
    for (Eigen::Index i = 0; i < n; ++i) {
      plant.readings(static_cast<Eigen::Index>(s), i) =
          model.reading(s).of_mode(modes.shapes.col(i), modes.omega_squared_rad2_per_s2(i));
    }
  }
  plant.stations.resize(kStationIntervals + 1, n);
  for (int i = 0; i <= kStationIntervals; ++i) {
    plant.stations.row(i) =
        model.deflection_row(arm.length_m * i / kStationIntervals).transpose() * modes.shapes;
  }
  plant.station_weights_m = simpson_weights(arm.length_m);
  return plant;
}

}  // namespace flexarm::trials
