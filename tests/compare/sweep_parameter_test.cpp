#include "compare/sweeps/sweep_parameter.hpp"

#include "arm/arm_keys.hpp"
#include "arm/effects.hpp"
#include "arm/input_error.hpp"
#include "compare/sweeps/sweep.hpp"
#include "effects/registry/vocabulary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <functional>

namespace flexarm::compare {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

std::string refusal(const std::function<void()>& action) {
  try {
    action();
  } catch (const arm::InputError& error) {
    return error.what();
  }
  return "not refused";
}

std::string refusal_of_axis(const std::string& text) {
  return refusal([&] { parse_axis(text); });
}

SweepTask task_with_axes(const std::vector<std::string>& axes,
                         const arm::Arm& arm = arm::paper_arm()) {
  SweepTask task;
  task.arm = arm;
  for (const auto& text : axes) task.axes.push_back(parse_axis(text));
  task.models = {standard_models(5).front()};
  return task;
}

std::string refusal_of_task(const SweepTask& task) {
  return refusal([&] { require_valid(task); });
}

TEST(SweepAxis, EqualStepsEqualRatiosAndLists) {
  EXPECT_THAT(parse_axis("payload.mass=0:0.5:3").values, ElementsAre(0.0, 0.25, 0.5));
  EXPECT_THAT(parse_axis("payload.mass=0.5:0:3").values, ElementsAre(0.5, 0.25, 0.0));
  EXPECT_THAT(parse_axis("payload.mass=0,0.05,0.1").values, ElementsAre(0.0, 0.05, 0.1));
  EXPECT_THAT(parse_axis("payload.mass=0.3").values, ElementsAre(0.3));
  const auto ratios = parse_axis("hub.inertia=log:1e-4:1:5");
  ASSERT_EQ(ratios.values.size(), 5);
  EXPECT_EQ(ratios.values.front(), 1e-4);
  EXPECT_EQ(ratios.values.back(), 1.0);
  // pow is within an ulp or so.
  EXPECT_NEAR(ratios.values[2], 1e-2, 1e-16);
  EXPECT_NEAR(ratios.at(0.5), std::sqrt(1e-4 * 1e-3), 1e-17);
  EXPECT_EQ(parse_axis("payload.mass=0:0.5:3").at(1.5), 0.375);
}

TEST(SweepAxis, WhatIsNoAxisIsRefused) {
  EXPECT_EQ(refusal_of_axis("payload.mass"),
            "--over payload.mass: give KEY=START:END:COUNT, KEY=log:START:END:COUNT or KEY=A,B,C");
  EXPECT_THAT(refusal_of_axis("payload.mass="), HasSubstr("give KEY="));
  EXPECT_THAT(refusal_of_axis("=1,2"), HasSubstr("give KEY="));
  EXPECT_THAT(refusal_of_axis("payload.mass=0:1"), HasSubstr("give KEY="));
  EXPECT_THAT(refusal_of_axis("payload.mass=log:1,2"), HasSubstr("give KEY="));
  EXPECT_THAT(refusal_of_axis("payload.mass=0:1:2:3"), HasSubstr("give KEY="));
  EXPECT_THAT(refusal_of_axis("payload.mass=0:x:3"), HasSubstr("\"x\" is not a number"));
  EXPECT_THAT(refusal_of_axis("payload.mass=0:1:2.5"), HasSubstr("\"2.5\" is not a count"));
  EXPECT_THAT(refusal_of_axis("payload.mass=0:1:1"), HasSubstr("must be from 2 to"));
  EXPECT_THAT(refusal_of_axis("payload.mass=0:1:9999999"), HasSubstr("must be from 2 to"));
  EXPECT_THAT(refusal_of_axis("payload.mass=log:0:1:5"), HasSubstr("above 0"));
  EXPECT_THAT(refusal_of_axis("payload.mass=0,2,1"), HasSubstr("must be monotonic"));
  EXPECT_THAT(refusal_of_axis("payload.mass=0.0,0.0"), HasSubstr("must be monotonic"));
  EXPECT_THAT(refusal_of_axis("payload.mass=1:1:5"), HasSubstr("must be monotonic"));
  EXPECT_EQ(refusal_of_axis("payload.mass=-1:1:5"),
            "payload.mass = -1 kg: must be a finite number, 0 or more");
  EXPECT_THAT(refusal_of_axis("payload.mass=0,nan"), StartsWith("payload.mass = nan kg"));
  EXPECT_THAT(refusal_of_axis("effects.root_compliance.stiffness=0:1:5"),
              StartsWith("effects.root_compliance.stiffness = 0 N m/rad"));
}

TEST(SweepParameter, AnUnknownKeySaysWhatWasMeant) {
  EXPECT_THAT(refusal_of_axis("payload.mas=0,1"), HasSubstr("(did you mean payload.mass?)"));
  EXPECT_THAT(refusal_of_axis("Mp=0,1"), HasSubstr("(did you mean payload.mass?)"));
  EXPECT_THAT(refusal_of_axis("kelvin_voigt=0,1"),
              HasSubstr("(did you mean damping.kelvin_voigt?)"));
  EXPECT_THAT(refusal_of_axis("root_compliance.stiffness=0,1"),
              HasSubstr("(did you mean effects.root_compliance.stiffness?)"));
  EXPECT_THAT(refusal_of_axis("effects.local_stiffness_loss=1,2"),
              HasSubstr("effects.local_stiffness_loss.position or "
                        "effects.local_stiffness_loss.stiffness?)"));
  EXPECT_THAT(refusal_of_axis("effects.coulomb_friction.torque=0,1"),
              HasSubstr("no influence on poles and zeros"));
}

TEST(SweepParameter, EveryNumberOfTheArmFileAndOfLinearEffectsIsOne) {
  const auto names = sweep_parameter_names();
  for (const auto& key : arm::arm_keys()) EXPECT_THAT(names, testing::Contains(key.name()));
  EXPECT_THAT(names, testing::Contains("effects.gravity.acceleration"));
  for (const auto& name : names) {
    arm::Arm arm = arm::paper_arm();
    sweep_parameter(name).set(arm, 0.5);
    EXPECT_NE(arm, arm::paper_arm()) << name;
  }
}

TEST(SweepParameter, RatiosAreThoseOfTheArmThatComesOut) {
  arm::Arm arm = arm::paper_arm();
  effects::put(arm, "payload_mass", {{"mass", 0.01}});
  effects::put(arm, "payload_offset", {{"offset", 0.02}});
  effects::put(arm, "hub_inertia", {{"factor", 1.7}});
  const std::vector axes = {parse_axis("payload_inertia_ratio=0.02,0.03"),
                            parse_axis("eta=0.3,0.4")};
  const auto changed = arm_at(arm, axes, std::array{1.0, 1.0});
  // Two or three roundings each.
  EXPECT_NEAR(arm::payload_mass_ratio(changed), 0.4, 1e-15);
  EXPECT_NEAR(arm::payload_inertia_ratio(changed), 0.03, 1e-16);
  sweep_parameter("epsilon").set(arm, 0.25);
  EXPECT_NEAR(arm::hub_inertia_ratio(arm), 0.25, 1e-15);
  EXPECT_THAT(refusal([&] { sweep_parameter("eta").set(arm, 0.01); }),
              HasSubstr("below the value that the effects alone produce"));
}

TEST(SweepParameter, TheBeamIsSetBeforeItsRatios) {
  const std::vector axes = {parse_axis("eta=0.3,0.4"), parse_axis("beam.length=0.5,2")};
  EXPECT_NEAR(arm::payload_mass_ratio(arm_at(arm::paper_arm(), axes, std::array{1.0, 1.0})), 0.4,
              1e-15);
}

TEST(SweepParameter, WhatTheArmGivesTwiceDoesNotContradictIt) {
  for (const std::string axis :
       {"beam.thickness=0.002,0.004", "beam.width=0.01,0.02", "beam.youngs_modulus=1e10,9e10",
        "beam.flexural_rigidity=1.0,2.0", "beam.density=1000.0,3000.0", "beam.linear_density=0.1,0.2"}) {
    EXPECT_NO_THROW(require_valid(task_with_axes({axis}))) << axis;
  }
  const auto thin = task_with_axes({"beam.thickness=0.0016002,0.002"}).arm_of(0);
  // EI of Table 1 is rounded to five digits.
  EXPECT_NEAR(thin.beam.flexural_rigidity_N_m2(), 3.6917964 / 8.0, 1e-6);
}

TEST(SweepTask, WhatCannotBeComputedIsRefusedWithItsPlace) {
  EXPECT_THAT(refusal_of_task(task_with_axes({"payload.mass=0.0,1e12"})),
              StartsWith("at payload.mass = 1e+12 kg: payload.mass/(m l) = "));
  EXPECT_THAT(refusal_of_task(task_with_axes({"effects.local_stiffness_loss.position=0.1,0.2"})),
              StartsWith("at effects.local_stiffness_loss.position = 0.1 m: "
                         "effects.local_stiffness_loss.stiffness: missing"));
  EXPECT_EQ(refusal_of_task(task_with_axes({"beam.shear_modulus=1e10,2e10"})),
            "--over beam.shear_modulus: no influence on this arm");
  EXPECT_EQ(refusal_of_task(task_with_axes({"payload.mass=0.0,1.0", "payload.mass=0.0,2.0"})),
            "--over payload.mass: given twice");
  EXPECT_THAT(refusal_of_task(task_with_axes({"payload.mass=0:1:1000", "hub.inertia=0:1:1000"})),
              HasSubstr("the grid must have from 1 to"));
  auto too_many = task_with_axes({"payload.mass=0.0,1.0"});
  too_many.questions.poles = 0;
  EXPECT_THAT(refusal_of_task(too_many), StartsWith("--poles = 0"));
  auto strain = task_with_axes({"beam.length=0.2,0.96"});
  strain.questions.sensors = {arm::parse_sensor("strain@0.5")};
  EXPECT_THAT(refusal_of_task(strain), StartsWith("at beam.length = 0.2 m: "));
}

TEST(SweepTask, TheRatioAndTheNumberItFollowsFromDoNotGoTogether) {
  EXPECT_EQ(refusal_of_task(task_with_axes({"payload.mass=0.0,1.0", "eta=0.0,1.0"})),
            "--over payload.mass: sets the same number as the other --over, payload_mass_ratio");
}

}  // namespace
}  // namespace flexarm::compare
