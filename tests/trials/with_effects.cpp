#include "tests/trials/with_effects.hpp"

#include "effects/registry/vocabulary.hpp"

namespace flexarm::trials {

arm::Arm with_effects(const World& world) {
  arm::Arm arm = world.arm;
  for (const HiddenCause& one : world.hidden) {
    effects::put(arm, one.name, one.parameters, one.sensor);
  }
  return arm;
}

}  // namespace flexarm::trials
