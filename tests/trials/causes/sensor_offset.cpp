#include "tests/trials/cause.hpp"

#include <map>
#include <string>

namespace flexarm::trials {

namespace {

/// What the typical torque makes a rigid arm read, and a beam that it bends.
double natural_reading(const NaturalSizes& natural, const std::string& sensor) {
  const double acceleration = natural.torque_N_m / natural.inertia_kg_m2;
  const double curvature = natural.torque_N_m / (natural.spring_N_m_per_rad * natural.length_m);
  const std::map<std::string, double> sizes = {
      {"tip_acceleration", acceleration * natural.length_m},
      {"hub_velocity", acceleration / natural.omega_rad_per_s},
      {"strain@0.05", 0.5 * natural.thickness_m * curvature}};
  return sizes.at(sensor);
}

}  // namespace

/// An amplifier that is not balanced.
Cause sensor_offset() {
  return {.name = "sensor_offset",
          .shown_in = ShownIn::time,
          .acts_on = ActsOn::sensor,
          .largest = 3.0,
          .acts_on_drawn_sensor = true,
          .parameters = [](const NaturalSizes& natural, double size,
                           const Chance& chance) -> Parameters {
            return {{"value", chance.sign * size * natural_reading(natural, chance.sensor)}};
          },
          .change = [](const Parameters& of, const arm::Sensor& sensor,
                       TrueArm& arm) { path_of(arm, sensor).offset += of.at("value"); }};
}

}  // namespace flexarm::trials
