#include "assumed_modes/basis.hpp"

#include "arm/input_error.hpp"
#include "assumed_modes/assumed_modes_arm.hpp"
#include "effects.hpp"
#include "effects/registry/vocabulary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <set>
#include <stdexcept>
#include <string>

namespace flexarm::assumed_modes {
namespace {

using testing::HasSubstr;

template <class F>
std::string refusal(const F& f) {
  try {
    f();
  } catch (const arm::InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Basis, NamesAreReadBackAndTyposExplained) {
  for (const Basis basis : kAllBases) EXPECT_EQ(parse_basis(to_string(basis)), basis);
  EXPECT_THAT(refusal([] { parse_basis("legendr"); }), HasSubstr("did you mean legendre?"));
}

TEST(AssumedModesArm, RefusesEffectsThatAreNotLinearByName) {
  for (const auto& definition : effects::vocabulary()) {
    if (definition->is_of_linear_arm()) continue;
    arm::Arm arm = arm::paper_arm();
    arm.effects[definition->name] = effects::example(definition);
    EXPECT_THAT(refusal([&] { const AssumedModesArm model(arm); }), HasSubstr(definition->name));
  }
}

TEST(AssumedModesArm, HonoursEveryLinearEffectAndOtherBasesRefuseWhatTheyCannotFollow) {
  const std::set<std::string> kinks = {
      "attached_mass",   "drive_compliance", "local_stiffness_loss",
      "root_compliance", "root_damping",     "shear_and_rotary_inertia",
      "tuned_mass"};
  for (const auto& definition : effects::vocabulary()) {
    if (!definition->is_of_linear_arm()) continue;
    arm::Arm arm = testing_arms::thick_arm(0.1);
    arm.effects[definition->name] = effects::example(definition);
    EXPECT_NO_THROW(AssumedModesArm(arm).damped_poles(2)) << definition->name;
    for (const Basis basis : kAllBases) {
      const bool follows = basis == Basis::legendre || !kinks.contains(definition->name);
      EXPECT_EQ(can_represent(basis, arm), follows);
      const std::string message = refusal([&] { AssumedModesArm(arm, {basis}).poles(2); });
      if (follows) {
        EXPECT_EQ(message, "accepted") << definition->name;
      } else {
        EXPECT_THAT(message, HasSubstr("effects." + definition->name + ": basis "));
        EXPECT_THAT(message, HasSubstr("--basis legendre can"));
      }
    }
  }
}

TEST(AssumedModesArm, RefusesOptionsOutOfRangeAndAnInvalidArm) {
  const arm::Arm arm = arm::paper_arm();
  EXPECT_THAT(refusal([&] {
                const AssumedModesArm model(arm, {Basis::legendre, 1});
              }),
              HasSubstr("functions = 1: must be from 2 to"));
  EXPECT_THAT(refusal([&] {
                const AssumedModesArm model(arm, {Basis::legendre, kMaximumFunctions + 1});
              }),
              HasSubstr("functions"));
  EXPECT_THAT(refusal([&] {
                const AssumedModesArm model(arm, {Basis::legendre, 12, -1.0});
              }),
              HasSubstr("zero_change"));
  arm::Arm broken = arm;
  broken.beam.length_m = -1.0;
  EXPECT_THAT(refusal([&] { const AssumedModesArm model(broken); }), HasSubstr("beam.length"));
}

TEST(AssumedModesArm, RefusesSensorsAndStationsOffTheBeam) {
  const AssumedModesArm model(arm::paper_arm());
  const arm::Sensor beyond = testing_arms::strain_at(1.2);
  EXPECT_THAT(refusal([&] { model.zeros(beyond, 3); }), HasSubstr("strain@1.2"));
  EXPECT_THAT(refusal([&] {
                model.transfer_function(beyond, {0.0, 1.0});
              }),
              HasSubstr("strain@1.2"));
  EXPECT_THAT(refusal([&] { model.modes(3, std::array{beyond}, {}); }), HasSubstr("strain@1.2"));
  EXPECT_THAT(refusal([&] { model.modes(3, {}, std::array{-0.1}); }), HasSubstr("station"));
}

TEST(AssumedModesArm, GivesNoMoreRootsThanItHasFlexibleCoordinates) {
  const AssumedModesArm model(arm::paper_arm(), {Basis::legendre, 5});
  EXPECT_EQ(model.degrees_of_freedom(), 5);
  EXPECT_EQ(model.poles(10).omega_rad_per_s.size(), 4U);
  EXPECT_EQ(model.zeros(testing_arms::kHubAngle, 10).s_rad_per_s.size(), 4U);
  EXPECT_THROW(model.poles(0), arm::InputError);
}

}  // namespace
}  // namespace flexarm::assumed_modes
