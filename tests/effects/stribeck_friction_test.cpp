// The static torque of stribeck_friction is at least the Coulomb torque: in files and in a search.
#include "arm/input_error.hpp"
#include "diagnose/search/candidate.hpp"
#include "effects/registry/vocabulary.hpp"
#include "measured/files/arm_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

namespace flexarm::effects {
namespace {

/// As it is looked for in an experiment on the paper's arm.
diagnose::Hypothesis stribeck_hypothesis() {
  Scales scales;
  scales.arm = arm::paper_arm();
  scales.beam = arm::linear_arm(scales.arm);
  scales.torque_rms_N_m = 0.1;
  scales.torque_peak_N_m = 0.2;
  scales.speed_rms_rad_per_s = 2.0;
  const auto entry = std::make_shared<const Entry>(*find("stribeck_friction"));
  return {entry, "stribeck_friction", {}, entry->search(scales)};
}

std::string refusal_of(const std::string& stribeck) {
  const std::string rig =
      "[beam]\nlength = 0.96\nflexural_rigidity = 3.69\nlinear_density = 0.165\n[hub]\ninertia = "
      "5.86e-4\n[effects.stribeck_friction]\n";
  try {
    measured::parse_arm(rig + stribeck, "rig.toml", vocabulary());
  } catch (const arm::InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(StribeckFriction, OfAFileHasAStaticTorqueOfAtLeastTheCoulombTorque) {
  EXPECT_EQ(refusal_of("torque = 0.01\nstatic_torque = 0.02\nvelocity = 0.1\n"), "no error");
  EXPECT_EQ(refusal_of("torque = 0.01\nstatic_torque = 0.01\nvelocity = 0.1\n"), "no error");
  EXPECT_THAT(
      refusal_of("torque = 0.01\nstatic_torque = 0.009\nvelocity = 0.1\n"),
      testing::StrEq("rig.toml:9: effects.stribeck_friction.static_torque = 0.009 N m: must "
                     "be at least effects.stribeck_friction.torque = 0.01 N m"));
}

TEST(StribeckFriction, OfASearchHasAStaticTorqueOfAtLeastTheCoulombTorque) {
  diagnose::Candidate candidate{{stribeck_hypothesis()}, {0.0, 0.0, 1.0}};
  const std::vector<double> places = {-0.25, -1e-3, 0.0, 0.2, 0.7, 1.0, 1.25};
  for (const double kinetic : places) {
    for (const double above : places) {
      candidate.put(Eigen::Vector3d(kinetic, above, 0.5));
      const auto& values = candidate.values;
      EXPECT_GE(values[1], values[0]) << kinetic << ", " << above;
      EXPECT_EQ(values[1] == values[0], above <= 0.0) << kinetic << ", " << above;
      EXPECT_NO_THROW(arm::require_valid(candidate.extend(arm::paper_arm())));
      if (kinetic < 0.0 || above < 0.0) continue;
      const Eigen::Vector3d back = candidate.coordinates();
      EXPECT_NEAR((back - Eigen::Vector3d(kinetic, above, 0.5)).norm(), 0.0, 1e-12);
    }
  }
}

TEST(StribeckFriction, OfASearchBecomesCoulombFrictionWhereTheStaticTorqueIsNoHigher) {
  const diagnose::Hypothesis hypothesis = stribeck_hypothesis();
  EXPECT_EQ(hypothesis.parameters[1].neutral_coordinate(), 0.0);
  const std::vector<double> values =
      values_at(hypothesis.parameters, std::vector<double>{0.4, 0.0, 0.5});
  EXPECT_EQ(values[1], values[0]);
  EXPECT_EQ(coordinates_of(hypothesis.parameters, values)[1], 0.0);
}

}  // namespace
}  // namespace flexarm::effects
