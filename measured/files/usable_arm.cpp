#include "measured/files/usable_arm.hpp"

#include "arm/formulation.hpp"
#include "arm/input_error.hpp"
#include "arm/rigid_hub.hpp"
#include "measured/files/arm_file.hpp"

namespace flexarm::measured {

void require_usable(const arm::Arm& arm) {
  if (arm::has_beam(arm)) {
    arm::require_computable(arm);
  } else {
    arm::require_valid(arm);
  }
}

arm::Arm read_usable_arm(const std::filesystem::path& path, const arm::Vocabulary& vocabulary) {
  arm::Arm arm = read_arm_file(path, vocabulary);
  try {
    require_usable(arm);
  } catch (const arm::InputError& error) {
    throw arm::located(error, path.string(), 0);
  }
  return arm;
}

}  // namespace flexarm::measured
