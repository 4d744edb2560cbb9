#include "report/json/arm_json.hpp"

#include "effects/registry/vocabulary.hpp"

#include <gtest/gtest.h>

namespace flexarm::report {
namespace {

TEST(ArmJson, EffectsAreListedWithNumbersAndUnits) {
  arm::Arm arm = arm::paper_arm();
  EXPECT_TRUE(arm_json(arm)["effects"].empty());
  effects::put(arm, "coulomb_friction", {{"torque", 0.01}});
  effects::put(arm, "sensor_lag", {{"time_constant", 0.002}}, "hub_angle");
  const auto effects = arm_json(arm)["effects"];
  ASSERT_EQ(effects.size(), 2U);
  EXPECT_EQ(effects[0]["effect"], "coulomb_friction");
  EXPECT_EQ(effects[0]["parameters"][0]["value"], 0.01);
  EXPECT_EQ(effects[0]["parameters"][0]["unit"], "N m");
  EXPECT_TRUE(effects[0]["sensor"].is_null());
  EXPECT_EQ(effects[1]["sensor"], "hub_angle");
}

TEST(ArmJson, NumbersAreTheFilesOwnAndWhatFollowsHasTheEffects) {
  arm::Arm arm = arm::paper_arm();
  effects::put(arm, "hub_inertia", {{"factor", 2.0}});
  const auto json = arm_json(arm);
  EXPECT_EQ(json["hub_inertia_kg_m2"], arm.hub.inertia_kg_m2);
  EXPECT_DOUBLE_EQ(json["hub_inertia_ratio"].get<double>(),
                   2.0 * arm::hub_inertia_ratio(arm::paper_arm()));
}

}  // namespace
}  // namespace flexarm::report
