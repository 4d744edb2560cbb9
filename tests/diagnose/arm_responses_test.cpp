#include "diagnose/predictors/arm_responses.hpp"

#include "arm/arm.hpp"
#include "arm/input_error.hpp"
#include "effects/registry/vocabulary.hpp"
#include "response/formulation_maker.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

namespace flexarm::diagnose {
namespace {

const std::vector<double> kFrequency_Hz = {0.5, 3.0, 20.0};

std::vector<arm::Sensor> hub_and_strain() {
  return {arm::parse_sensor("hub_angle"), arm::parse_sensor("strain@0.1")};
}

class ArmResponsesOfTwoRuns : public testing::Test {
 protected:
  auto of(const arm::Arm& arm, std::size_t run = 0) {
    return responses_.of(run, arm, hub_and_strain(), kFrequency_Hz);
  }

  const arm::Arm arm_ = arm::paper_arm();
  ArmResponses responses_ = ArmResponses(2);
};

TEST_F(ArmResponsesOfTwoRuns, AreThoseOfTheFormulation) {
  const auto expected =
      response::arm_response(response::formulation_of_fit(arm_), hub_and_strain(), kFrequency_Hz);
  EXPECT_EQ(of(arm_)->values, expected.values);
  EXPECT_EQ(of(arm_, 1)->values, expected.values);
}

TEST_F(ArmResponsesOfTwoRuns, AreKeptWhereTheLinearArmIsTheSame) {
  const auto first = of(arm_);
  arm::Arm changed = arm_;
  changed.effects = {effects::named("torque_gain", {{"factor", 1.1}}),
                     effects::named("time_delay", {{"delay", 1e-3}}),
                     effects::named("sensor_gain", {{"factor", 0.9}}, "hub_angle")};
  EXPECT_EQ(of(changed), first);
}

TEST_F(ArmResponsesOfTwoRuns, AreOthersWhereItIsNot) {
  const auto first = of(arm_);
  EXPECT_NE(of(arm_, 1), first);
  arm::Arm moved = arm_;
  moved.effects = {effects::named("gauge_position", {{"shift", 1e-3}}, "strain@0.1")};
  EXPECT_NE(of(moved)->values, first->values);
  arm::Arm heavier = arm_;
  heavier.payload.mass_kg += 0.01;
  EXPECT_NE(of(heavier)->values, first->values);
  EXPECT_NE(responses_.of(0, arm_, hub_and_strain(), std::vector{0.5, 3.0, 21.0})->values,
            first->values);
}

TEST_F(ArmResponsesOfTwoRuns, AreNotOfASensorThatTheArmCannotCarry) {
  EXPECT_THROW(responses_.of(0, arm_, std::vector{arm::parse_sensor("strain@9")}, kFrequency_Hz),
               arm::InputError);
}

}  // namespace
}  // namespace flexarm::diagnose
