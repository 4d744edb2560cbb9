// docs/effects.md is what the registry says.
#include "effects/registry/vocabulary.hpp"
#include "measured/files/text_file.hpp"
#include "report/json/effects_json.hpp"
#include "report/tables/effect_tables.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>

namespace flexarm::effects {
namespace {

TEST(EffectsDocument, IsWhatTheRegistrySays) {
  const std::filesystem::path path = FLEXARM_SOURCE_DIR "/docs/effects.md";
  EXPECT_EQ(measured::read_text_file(path, 1 << 20), report::effects_document(entries()))
      << "scripts/update-docs writes docs/effects.md";
}

TEST(EffectPage, NamesParametersPortAndKindsOfData) {
  const std::string page = report::effect_page(*find("stribeck_friction"));
  for (const char* part : {"static_torque", "rad/s", "hub_torque", "time records",
                           "limiting case: coulomb_friction"}) {
    EXPECT_THAT(page, testing::HasSubstr(part));
  }
}

TEST(ArmFileSchema, HasEveryEffectAndItsRequiredKeys) {
  const auto schema = report::arm_file_schema(entries());
  const auto& known = schema.at("properties").at("effects").at("properties");
  EXPECT_EQ(known.size(), entries().size() + 1);
  EXPECT_TRUE(known.contains("measured_hub_torque"));
  EXPECT_EQ(known.at("coulomb_friction").at("required"), nlohmann::ordered_json({"torque"}));
  EXPECT_EQ(known.at("coulomb_friction").at("properties").at("torque").at("minimum"), 0.0);
  EXPECT_FALSE(known.at("shear_and_rotary_inertia").contains("required"));
  EXPECT_EQ(schema.at("properties").at("beam").at("required"), nlohmann::ordered_json({"length"}));
  EXPECT_EQ(schema.at("required"), nlohmann::ordered_json::array({"hub"}));  // a rigid hub
}

}  // namespace
}  // namespace flexarm::effects
