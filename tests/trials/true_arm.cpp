#include "tests/trials/true_arm.hpp"

#include <algorithm>

namespace flexarm::trials {

TrueArm true_arm(const arm::Arm& nominal) {
  TrueArm arm;
  arm.length_m = nominal.beam.length_m;
  arm.flexural_rigidity_N_m2 = nominal.beam.flexural_rigidity_N_m2();
  arm.linear_density_kg_per_m = nominal.beam.linear_density_kg_per_m();
  arm.width_m = nominal.beam.width_m;
  arm.thickness_m = nominal.beam.thickness_m;
  arm.shear_modulus_Pa = nominal.beam.shear_modulus_Pa;
  arm.kelvin_voigt_s = nominal.damping.kelvin_voigt_s;
  arm.hub_inertia_kg_m2 = nominal.hub.inertia_kg_m2;
  arm.hub_damping_N_m_s_per_rad = nominal.hub.viscous_friction_N_m_s_per_rad;
  arm.payload_kg = nominal.payload.mass_kg;
  arm.payload_inertia_kg_m2 = nominal.payload.inertia_kg_m2;
  return arm;
}

TrueArm::SensorPath& path_of(TrueArm& arm, const arm::Sensor& sensor) {
  const auto found = std::ranges::find(arm.sensor_paths, sensor, &TrueArm::SensorPath::sensor);
  if (found != arm.sensor_paths.end()) return *found;
  return arm.sensor_paths.emplace_back(TrueArm::SensorPath{sensor});
}

TrueArm::SensorPath known_path(const TrueArm& arm, const arm::Sensor& sensor) {
  const auto found = std::ranges::find(arm.sensor_paths, sensor, &TrueArm::SensorPath::sensor);
  return found != arm.sensor_paths.end() ? *found : TrueArm::SensorPath{sensor};
}

std::vector<arm::Sensor> really_placed(const TrueArm& arm, std::span<const arm::Sensor> sensors) {
  std::vector<arm::Sensor> made;
  for (arm::Sensor sensor : sensors) {
    sensor.position_m += known_path(arm, sensor).moved_m;
    made.push_back(sensor);
  }
  return made;
}

}  // namespace flexarm::trials
