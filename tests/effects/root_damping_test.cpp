// root_damping against the root compliance that it is at a real s, and against its limits.
#include "arm/input_error.hpp"
#include "effects/registry/vocabulary.hpp"
#include "laws/effect_arms.hpp"
#include "response/formulation_maker.hpp"
#include "tests/effects/linear_effects.hpp"

#include <gtest/gtest.h>

#include <string>

namespace flexarm::effects {
namespace {

constexpr int kLossyRoots = 5;
constexpr double kStiffness = 25.0;
constexpr double kTime = 2e-3;

arm::Arm with_root(double stiffness, double time) {
  arm::Arm arm = laws::damped_arm();
  put(arm, "root_damping", {{"stiffness", stiffness}, {"time", time}});
  return arm;
}

arm::Arm with_compliance(double stiffness) {
  arm::Arm arm = laws::damped_arm();
  put(arm, "root_compliance", {{"stiffness", stiffness}});
  return arm;
}

/// kr (1 + tr s) is a real stiffness where s is real.
TEST(RootDamping, IsARootComplianceAtEachRealS) {
  constexpr double kAgreement = 1e-9;
  for (const double s : {2.0, 60.0, 900.0}) {
    const arm::Arm soft = with_compliance(kStiffness * (1.0 + kTime * s));
    for (const auto formulation : response::kFormulationNames) {
      const auto lossy =
          response::make_formulation(formulation, with_root(kStiffness, kTime), kLossyRoots);
      const auto reference = response::make_formulation(formulation, soft, kLossyRoots);
      expect_same_responses(
          lossy, reference,
          {"hub_angle", "tip_displacement", "tip_deflection", "strain@0", "strain@0.3"}, s,
          kAgreement);
    }
  }
}

TEST(RootDamping, OfNoTimeIsRootCompliance) {
  EXPECT_EQ(arm::linear_arm(with_root(kStiffness, 0.0)),
            arm::linear_arm(with_compliance(kStiffness)));
}

TEST(RootDamping, LeavesTheUndampedPolesAndDampsEachMode) {
  for (const auto formulation : response::kFormulationNames) {
    const auto lossy =
        response::make_formulation(formulation, with_root(kStiffness, kTime), kLossyRoots);
    const auto soft =
        response::make_formulation(formulation, with_compliance(kStiffness), kLossyRoots);
    EXPECT_EQ(response::poles(lossy, kLossyRoots).omega_rad_per_s,
              response::poles(soft, kLossyRoots).omega_rad_per_s);
    const auto damped = response::damped_poles(lossy, kLossyRoots);
    const auto before = response::damped_poles(soft, kLossyRoots);
    for (std::size_t i = 0; i < damped.flexible.size(); ++i) {
      EXPECT_LT(damped.flexible[i].first_rad_per_s.real(),
                before.flexible[i].first_rad_per_s.real())
          << formulation << " pole " << i + 1;
    }
  }
}

/// A little damping: each mode's decay by the power that the root takes, D_ii/2.
TEST(RootDamping, ALittleDampsAsItsProjectionSays) {
  constexpr double kLittle = 1e-8;
  arm::Arm arm = with_root(kStiffness, kLittle);
  arm.damping = {};
  arm.hub.viscous_friction_N_m_s_per_rad = 0.0;
  expect_decays_as_projected(arm, kLossyRoots);
}

TEST(RootDamping, IsTheOnlySpringOfTheRoot) {
  for (const char* other : {"root_compliance", "local_stiffness_loss"}) {
    arm::Arm arm = with_root(kStiffness, kTime);
    put(arm, other, {{"stiffness", 40.0}});
    if (std::string(other) == "local_stiffness_loss") put(arm, other, {{"position", 0.0}});
    try {
      arm::require_valid(arm);
      FAIL() << other;
    } catch (const arm::InputError& error) {
      EXPECT_EQ(std::string(error.what()),
                std::string("effects.root_damping: the root has its spring already, by effects.") +
                    other + "; must be the only spring at the root, its stiffness included");
    }
  }
  arm::Arm crack = with_root(kStiffness, kTime);
  put(crack, "local_stiffness_loss", {{"stiffness", 40.0}, {"position", 0.3}});
  EXPECT_NO_THROW(arm::require_valid(crack));
}

}  // namespace
}  // namespace flexarm::effects
