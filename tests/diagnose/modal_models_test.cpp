#include "diagnose/predictors/modal_models.hpp"

#include "arm/arm.hpp"
#include "arm/input_error.hpp"
#include "effects/registry/vocabulary.hpp"
#include "response/formulation_maker.hpp"
#include "response/time/time_model.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

namespace flexarm::diagnose {
namespace {

constexpr int kFlexibleModes = 4;

std::vector<arm::Sensor> sensors() {
  return {arm::parse_sensor("hub_angle"), arm::parse_sensor("strain@0.1")};
}

arm::Arm arm_of_payload(double mass_kg) {
  arm::Arm arm = arm::paper_arm();
  arm.payload.mass_kg = mass_kg;
  return arm;
}

class ModalModelsOfFourModes : public testing::Test {
 protected:
  auto of(const arm::Arm& arm) { return models_.of(response::take_apart(arm), sensors()); }

  ModalModels models_ = ModalModels(kFlexibleModes);
};

TEST_F(ModalModelsOfFourModes, AreThoseOfTheFormulation) {
  const arm::Arm arm = arm_of_payload(0.05);
  const auto parts = response::take_apart(arm);
  const auto expected =
      response::time_model(response::make_formulation("exact_tf", parts.linear, kFlexibleModes),
                           parts, kFlexibleModes, sensors());
  const auto made = of(arm);
  ASSERT_EQ(made->modes.size(), expected.modes.size());
  for (std::size_t i = 0; i < expected.modes.size(); ++i) {
    EXPECT_EQ(made->modes[i].omega_rad_per_s, expected.modes[i].omega_rad_per_s) << i;
    EXPECT_EQ(made->modes[i].sensor_values, expected.modes[i].sensor_values) << i;
  }
}

TEST_F(ModalModelsOfFourModes, AreKeptWhereTheLinearArmIsTheSame) {
  arm::Arm arm = arm_of_payload(0.05);
  const auto first = of(arm);
  arm.effects = {effects::named("torque_gain", {{"factor", 1.1}}),
                 effects::named("coulomb_friction", {{"torque", 0.01}}),
                 effects::named("sensor_gain", {{"factor", 0.9}}, "hub_angle")};
  EXPECT_EQ(of(arm), first);
}

TEST_F(ModalModelsOfFourModes, AreOthersWhereItIsNot) {
  arm::Arm arm = arm_of_payload(0.05);
  const auto first = of(arm);
  EXPECT_NE(of(arm_of_payload(0.06)), first);
  arm.effects = {effects::named("gauge_position", {{"shift", 0.01}}, "strain@0.1")};
  EXPECT_NE(of(arm), first);
  arm.effects = {effects::named("quadratic_drag", {{"coefficient", 0.1}})};
  EXPECT_NE(of(arm), first);  // with values at the stations of the drag
}

TEST_F(ModalModelsOfFourModes, AreComputedAgainAfterManyOthers) {
  const auto first = of(arm_of_payload(0.05));
  const auto used_last = of(arm_of_payload(0.06));
  for (std::size_t i = 0; i + 1 < ModalModels::kKept; ++i) {
    of(arm_of_payload(0.1 + 0.001 * static_cast<double>(i)));
    EXPECT_EQ(of(arm_of_payload(0.06)), used_last);
  }
  const auto again = of(arm_of_payload(0.05));
  EXPECT_NE(again, first);
  EXPECT_EQ(again->modes.back().omega_rad_per_s, first->modes.back().omega_rad_per_s);
}

TEST_F(ModalModelsOfFourModes, KeepTheModesOfTheBeamBesideAMassOnASpring) {
  constexpr double kMass_kg = 1e-9;
  constexpr double kNothing = 1e-6;  // relative; of the order of the mass over that of the beam
  const auto with_mass = [&](double mass_kg) {
    arm::Arm arm = arm_of_payload(0.05);
    arm.effects = {effects::named(
        "tuned_mass",
        {{"mass", mass_kg}, {"frequency", 0.5}, {"damping_ratio", 0.03}, {"position", 0.75}})};
    return of(arm);
  };
  const auto first = of(arm_of_payload(0.05));
  const auto beside = with_mass(kMass_kg);
  ASSERT_EQ(beside->modes.size(), first->modes.size() + 1);
  const double highest = first->modes.back().omega_rad_per_s;
  EXPECT_NEAR(beside->modes.back().omega_rad_per_s, highest, kNothing * highest);
  // A mass of 0 has no mode.
  EXPECT_EQ(with_mass(0.0)->modes.size(), first->modes.size());
}

TEST_F(ModalModelsOfFourModes, AreRefusedAsByTheFormulation) {
  EXPECT_THROW(of(arm_of_payload(-1.0)), arm::InputError);
}

}  // namespace
}  // namespace flexarm::diagnose
