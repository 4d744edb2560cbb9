#include "compare/comparison.hpp"
#include "effects/registry/vocabulary.hpp"
#include "laws/effect_arms.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace flexarm::compare {
namespace {

class ComparedEffects : public testing::TestWithParam<laws::EffectArm> {};

TEST_P(ComparedEffects, TheThreeFormulationsAgree) {
  Options options;
  options.non_collocated_zeros = 4;
  options.refinements = false;
  options.response_points = 50;
  options.root_tolerance = laws::agreement_tolerance(GetParam().arm);
  const Comparison comparison = compare(GetParam().arm, options);
  const Finding& worst = comparison.verdict.worst;
  EXPECT_TRUE(comparison.verdict.agree) << worst.quantity << " of " << worst.first << " and "
                                        << worst.second << ": " << worst.distance;
}

std::vector<laws::EffectArm> effect_arms() {
  auto arms = laws::arms_with_one_effect();
  arms.push_back(laws::arm_with_every_effect());
  return arms;
}

INSTANTIATE_TEST_SUITE_P(EveryEffect, ComparedEffects, testing::ValuesIn(effect_arms()),
                         [](const auto& each) { return each.param.name; });

TEST(EffectComparison, AnEffectInOneModelAloneDisagrees) {
  const auto plain = standard_subjects(laws::damped_arm(), 5);
  for (const auto& [name, arm] : laws::arms_with_one_effect()) {
    const auto& effects = arm.effects;
    // Damping moves responses, not undamped roots.
    const bool is_damping =
        effects.contains("hub_viscous_friction") || effects.contains("back_emf") ||
        effects.contains("structural_damping") || effects.contains("air_damping");
    Options options;
    options.poles = 5;
    options.non_collocated_zeros = 2;
    options.response_points = 20;
    options.sensors.push_back({arm::SensorKind::strain, 0.0});  // which gauge_position moves
    const Comparison comparison = compare({plain[0], standard_subjects(arm, 5)[1]}, options);
    EXPECT_FALSE(comparison.verdict.agree) << name;
    if (is_damping) {
      EXPECT_LE(comparison.roots.front().distance[1], options.root_tolerance) << name;
    }
  }
}

TEST(EffectComparison, WhatActsOutsideTheLinearArmIsLeftOut) {
  arm::Arm arm = laws::damped_arm();
  effects::put(arm, "coulomb_friction", {{"torque", 0.01}});
  effects::put(arm, "actuator_lag", {{"time_constant", 0.01}});
  Options options;
  options.poles = 3;
  options.non_collocated_zeros = 2;
  options.refinements = false;
  const Comparison comparison = compare(arm, options);
  EXPECT_TRUE(comparison.verdict.agree);
  EXPECT_TRUE(comparison.arm.effects.empty());
}

}  // namespace
}  // namespace flexarm::compare
