#include "tests/trials/world.hpp"

#include "tests/trials/experiment_plan.hpp"

#include <algorithm>
#include <utility>

namespace flexarm::trials {

const HiddenCause* World::find(const std::string& name) const {
  const auto found = std::ranges::find(hidden, name, &HiddenCause::name);
  return found == hidden.end() ? nullptr : &*found;
}

bool World::has_outside() const {
  return std::ranges::any_of(hidden,
                             [](const HiddenCause& one) { return find_cause(one.name).outside; });
}

TrueArm true_arm(const World& world) {
  TrueArm arm = true_arm(world.arm);
  for (const HiddenCause& one : world.hidden) {
    const arm::Sensor sensor = one.sensor.empty() ? arm::Sensor{} : arm::parse_sensor(one.sensor);
    find_cause(one.name).change(one.parameters, sensor, arm);
  }
  return arm;
}

World with_hidden(const World& world, const TrialArm& of, const Cause& cause, double size,
                  const Chance& chance) {
  World hidden = world;
  std::string sensor;
  if (cause.acts_on_drawn_sensor) sensor = chance.sensor;
  if (cause.acts_on_gauge) sensor = arm::to_string(kGauge);
  hidden.hidden.push_back(
      {cause.name, cause.parameters(NaturalSizes(of), size, chance), std::move(sensor)});
  return hidden;
}

}  // namespace flexarm::trials
