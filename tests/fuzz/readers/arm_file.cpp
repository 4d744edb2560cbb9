#include "measured/files/arm_file.hpp"

#include "effects/registry/vocabulary.hpp"
#include "tests/fuzz/contract.hpp"
#include "tests/fuzz/reader.hpp"

namespace flexarm::fuzz {

namespace {

void read_arm(std::string_view bytes) {
  returns_or_refuses([&] {
    const arm::Arm arm = measured::parse_arm(bytes, "arm.toml", effects::vocabulary());
    const std::string text = measured::format_arm(arm);
    const arm::Arm again = measured::parse_arm(text, "arm.toml", effects::vocabulary());
    require(measured::format_arm(again) == text, "an arm is not read back as it was written");
  });
}

}  // namespace

Reader arm_file() {
  return {"arm_file", read_arm};
}

}  // namespace flexarm::fuzz
