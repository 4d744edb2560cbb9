#include "tests/trials/dirt.hpp"

#include "arm/input_error.hpp"
#include "arm/nearest_name.hpp"
#include "tests/trials/every_dirt.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace flexarm::trials {

const std::vector<Dirt>& dirts() {
  static const std::vector<Dirt> all = [] {
    std::vector<Dirt> made = every_dirt();
    std::ranges::sort(made, {}, &Dirt::name);
    return made;
  }();
  return all;
}

const Dirt& find_dirt(const std::string& name) {
  static const Dirt none;
  if (name.empty()) return none;
  const auto found = std::ranges::find(dirts(), name, &Dirt::name);
  if (found != dirts().end()) return *found;
  std::vector<std::string> names;
  for (const Dirt& dirt : dirts()) names.push_back(dirt.name);
  throw arm::InputError(fmt::format("--dirt {}: unknown{}; must be all, none, {}", name,
                                    arm::did_you_mean(name, names), fmt::join(names, ", ")));
}

World with_named_dirt(const World& world, const TrialArm& of, const std::string& cause, double size,
                      const std::string& sensor, Random& random) {
  Chance chance = draw_chance(random);
  if (size == 0.0) return world;
  chance.sensor = sensor;
  return with_hidden(world, of, find_cause(cause), size, chance);
}

bool is_analogue(const measured::Channel& channel) {
  return channel.sensor.kind != arm::SensorKind::hub_angle;
}

double deviation(const std::vector<double>& values) {
  double sum = 0.0;
  double squares = 0.0;
  for (const double value : values) {
    sum += value;
    squares += value * value;
  }
  const auto n = static_cast<double>(values.size());
  return std::sqrt(std::max(0.0, squares / n - sum * sum / (n * n)));
}

}  // namespace flexarm::trials
