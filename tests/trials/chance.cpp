#include "tests/trials/chance.hpp"

#include <numbers>
#include <vector>

namespace flexarm::trials {

Chance draw_chance(Random& random) {
  Chance chance;
  chance.sign = random.sign();
  chance.place = random.uniform();
  chance.ratio = random.uniform();
  chance.phase_rad = random.uniform(0.0, 2.0 * std::numbers::pi);
  const std::vector<std::string> sensors = {"tip_acceleration", "hub_velocity", "strain@0.05"};
  chance.sensor = sensors[random.below(sensors.size())];
  return chance;
}

}  // namespace flexarm::trials
