#include "tests/trials/world.hpp"

#include "arm/effects.hpp"

namespace flexarm::trials {

const std::vector<std::string>& outside_names() {
  static const std::vector<std::string> names = {"hub_hysteresis", "tuned_mass",
                                                 "disturbance_torque", "hub_hardening_spring"};
  return names;
}

arm::Arm linear_part(const arm::Arm& arm) {
  arm::Arm linear = arm;
  std::erase_if(linear.effects,
                [](const auto& effect) { return !effect.second.definition->is_of_linear_arm(); });
  return linear;
}

double effect_value(const arm::Arm& arm, const std::string& effect, const std::string& parameter,
                    double otherwise) {
  const auto found = arm.effects.find(effect);
  return found == arm.effects.end() ? otherwise : found->second.parameters.at(parameter);
}

}  // namespace flexarm::trials
