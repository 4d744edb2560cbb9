// beam_thickness against the arm whose file has that thickness.
#include "effects/registry/vocabulary.hpp"
#include "exact_tf/exact_arm.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

namespace flexarm::effects {
namespace {

/// The numbers follow from the section, by products in another order.
constexpr double kRounding = 1e-14;

arm::Arm arm_of_section(double thickness_factor) {
  arm::Arm arm = arm::paper_arm();
  arm.beam.given_flexural_rigidity_N_m2.reset();
  arm.beam.shear_modulus_Pa = 2.67e10;
  *arm.beam.thickness_m *= thickness_factor;
  put(arm, "shear_and_rotary_inertia", {});
  return arm;
}

TEST(BeamThickness, IsTheArmWhoseFileSaysSo) {
  arm::Arm by_effect = arm_of_section(1.0);
  put(by_effect, "beam_thickness", {{"factor", 1.03}});
  const arm::Arm by_number = arm_of_section(1.03);
  const arm::LinearArm a = arm::linear_arm(by_effect);
  const arm::LinearArm b = arm::linear_arm(by_number);
  EXPECT_NEAR(a.flexural_rigidity_N_m2 / b.flexural_rigidity_N_m2, 1.0, kRounding);
  EXPECT_NEAR(a.linear_density_kg_per_m / b.linear_density_kg_per_m, 1.0, kRounding);
  EXPECT_NEAR(a.shear->shear_rigidity_N / b.shear->shear_rigidity_N, 1.0, kRounding);
  EXPECT_NEAR(a.shear->rotary_inertia_kg_m / b.shear->rotary_inertia_kg_m, 1.0, kRounding);
}

TEST(BeamThickness, MovesTheSurfaceOnWhichStrainIsMeasured) {
  // Both arms bend alike; the thicker one is of a softer and lighter material.
  arm::Arm thicker = arm::paper_arm();
  put(thicker, "beam_thickness", {{"factor", 1.2}});
  put(thicker, "flexural_rigidity", {{"factor", std::pow(1.2, -3)}});
  put(thicker, "linear_density", {{"factor", 1.0 / 1.2}});
  const auto sensor = arm::parse_sensor("strain@0.05");
  const std::complex<double> s(-2.0, 40.0);
  const auto ratio = exact_tf::ExactArm(thicker).transfer_function(sensor, s) /
                     exact_tf::ExactArm(arm::paper_arm()).transfer_function(sensor, s);
  EXPECT_NEAR(std::abs(ratio - 1.2), 0.0, 1e-12);
}

}  // namespace
}  // namespace flexarm::effects
