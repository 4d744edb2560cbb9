#include "response/formulation_maker.hpp"

#include "arm/input_error.hpp"
#include "effects/registry/vocabulary.hpp"
#include "response/settings.hpp"
#include "tests/response/models.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace flexarm::response {
namespace {

using testing::HasSubstr;

arm::Arm arm_with_a_sticky_hub() {
  arm::Arm arm = arm::paper_arm();
  effects::put(arm, "coulomb_friction", {{"torque", 0.01}});
  effects::put(arm, "time_delay", {{"delay", 1e-3}});
  return arm;
}

TEST(FormulationMaker, EveryFormulationIsMadeOfTheLinearArm) {
  for (const char* formulation : kFormulations) {
    const auto made = make_formulation(formulation, arm_with_a_sticky_hub(), 3);
    EXPECT_EQ(name(made), formulation);
    EXPECT_EQ(arm_of(made), arm::paper_arm());
  }
}

TEST(FormulationMaker, AnotherArmKeepsTheSettings) {
  const auto coarse =
      AnyFormulation(fem::FemArm(arm::paper_arm(), {.mesh = {.elements = 7}, .degree = 4}));
  const auto remade = with_arm(coarse, damped_arm());
  EXPECT_EQ(degrees_of_freedom(remade), degrees_of_freedom(coarse));
  EXPECT_EQ(arm_of(remade), damped_arm());
  EXPECT_EQ(arm_of(with_arm(coarse, arm_with_a_sticky_hub())), arm::paper_arm());
}

TEST(FormulationMaker, WithoutDampingNothingDissipates) {
  arm::Arm arm = damped_arm();
  effects::put(arm, "air_damping", {{"coefficient", 0.1}});
  effects::put(arm, "structural_damping", {{"time", 1e-4}});
  effects::put(arm, "hub_viscous_friction", {{"coefficient", 1e-3}});
  effects::put(arm, "payload_mass", {{"mass", 0.02}});
  ASSERT_TRUE(arm::linear_arm(arm).is_damped());
  EXPECT_FALSE(arm::linear_arm(without_damping(arm)).is_damped());
  EXPECT_TRUE(without_damping(arm).effects.contains("payload_mass"));
}

TEST(FormulationMaker, WhatItCannotMakeIsRefusedInOneLine) {
  const auto refusal = [](const char* formulation, int roots) -> std::string {
    try {
      make_formulation(formulation, arm::paper_arm(), roots);
    } catch (const arm::InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(refusal("fme", 3), HasSubstr("formulation fme: unknown (did you mean fem?)"));
  EXPECT_THAT(refusal("fem", kMostRoots + 1), HasSubstr("at most 90 for fem"));
  EXPECT_THAT(refusal("exact_tf", 0), HasSubstr("1 or more"));
}

}  // namespace
}  // namespace flexarm::response
