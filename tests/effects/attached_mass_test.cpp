// attached_mass against arms that are the same by other numbers.
#include "arm/input_error.hpp"
#include "assumed_modes/assumed_modes_arm.hpp"
#include "effects/registry/vocabulary.hpp"
#include "laws/effect_arms.hpp"
#include "response/formulation_maker.hpp"
#include "tests/effects/linear_effects.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace flexarm::effects {
namespace {

constexpr int kMassRoots = 5;

arm::Arm with_mass(arm::Arm arm, double mass_kg, double position_m) {
  put(arm, "attached_mass", {{"mass", mass_kg}, {"position", position_m}});
  return arm;
}

TEST(AttachedMass, AtTheTipIsAPayloadMass) {
  const arm::Arm arm = laws::damped_arm();
  const double length_m = arm.beam.length_m;
  arm::Arm payload = arm;
  put(payload, "payload_mass", {{"mass", 0.03}});
  EXPECT_EQ(arm::linear_arm(with_mass(arm, 0.03, length_m)), arm::linear_arm(payload));
  // The tip's own equations, and those of a place beside it.
  constexpr double kBeside = 1e-7;
  for (const auto formulation : response::kFormulationNames) {
    const auto wanted = pole_frequencies(formulation, payload, kMassRoots);
    const auto beside =
        pole_frequencies(formulation, with_mass(arm, 0.03, length_m * (1.0 - kBeside)), kMassRoots);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      EXPECT_NEAR(beside[i] / wanted[i], 1.0, 10.0 * kBeside) << formulation << " pole " << i + 1;
    }
  }
}

TEST(AttachedMass, AtTheTipIsNotOffsetWithThePayload) {
  arm::Arm arm = laws::damped_arm();
  put(arm, "payload_offset", {{"offset", 0.05}});
  const arm::LinearArm without = arm::linear_arm(arm);
  const arm::LinearArm with = arm::linear_arm(with_mass(arm, 0.03, arm.beam.length_m));
  EXPECT_DOUBLE_EQ(with.payload_mass_kg, without.payload_mass_kg + 0.03);
  EXPECT_EQ(with.payload_first_moment_kg_m, without.payload_first_moment_kg_m);
  EXPECT_EQ(with.payload_tip_inertia_kg_m2, without.payload_tip_inertia_kg_m2);
}

TEST(AttachedMass, AtTheRootTurnsWithTheHub) {
  constexpr double kRadius = 0.08;
  constexpr double kMass = 0.4;
  constexpr double kAgreement = 1e-11;
  arm::Arm arm = laws::damped_arm();
  put(arm, "hub_radius", {{"radius", kRadius}});
  arm::Arm heavier = arm;
  heavier.hub.inertia_kg_m2 += kMass * kRadius * kRadius;
  for (const auto formulation : response::kFormulationNames) {
    const auto wanted = pole_frequencies(formulation, heavier, kMassRoots);
    const auto found = pole_frequencies(formulation, with_mass(arm, kMass, 0.0), kMassRoots);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      EXPECT_NEAR(found[i] / wanted[i], 1.0, kAgreement) << formulation << " pole " << i + 1;
    }
  }
}

/// Rayleigh's quotient: a small mass m lowers omega^2 by m phi(X)^2/I_T of it, to first order.
TEST(AttachedMass, ASmallOneLowersEachPoleByItsShapeThere) {
  constexpr double kMass = 1e-7;
  constexpr double kSecondOrder = 1e-4;
  const arm::Arm arm = laws::damped_arm();
  const std::vector<double> places_m = {0.3, 0.55, 0.8};
  for (const auto formulation : response::kFormulationNames) {
    const auto model = response::make_formulation(formulation, arm, kMassRoots);
    const auto modal = response::modal_model(model, kMassRoots, {}, places_m);
    for (std::size_t k = 0; k < places_m.size(); ++k) {
      const auto moved =
          pole_frequencies(formulation, with_mass(arm, kMass, places_m[k]), kMassRoots);
      for (std::size_t i = 0; i < moved.size(); ++i) {
        const auto& mode = modal.modes[i + 1];
        // The rigid body, whose inertia grows as well, takes no part: phi is orthogonal to it.
        const double expected =
            -0.5 * kMass * std::pow(mode.displacement_m[k], 2) / modal.modal_mass_kg_m2;
        const double change = moved[i] / mode.omega_rad_per_s - 1.0;
        EXPECT_NEAR(change, expected, kSecondOrder * kMass / modal.modal_mass_kg_m2) << formulation;
      }
    }
  }
}

/// A mass that hangs: the rigid pendulum of hub, beam and mass.
TEST(AttachedMass, WeighsWhereItIs) {
  constexpr double kElasticity = 1e-5;
  arm::Arm arm = with_mass(laws::damped_arm(), 0.3, 0.5);
  put(arm, "gravity", {{"acceleration", 9.81}});
  put(arm, "flexural_rigidity", {{"factor", 1e6}});
  const double l = arm.beam.length_m;
  const double beam_kg = arm.beam.linear_density_kg_per_m() * l;
  const double expected = 9.81 * (beam_kg * l / 2.0 + arm.payload.mass_kg * l + 0.3 * 0.5) /
                          arm::total_inertia_kg_m2(arm);
  for (const auto formulation : response::kFormulationNames) {
    const auto found = response::poles(response::make_formulation(formulation, arm, 1), 1);
    EXPECT_NEAR(found.lowest_omega_squared_rad2_per_s2 / expected, 1.0, kElasticity) << formulation;
  }
}

TEST(AttachedMass, HasToBeOnTheBeam) {
  const arm::Arm arm = laws::damped_arm();
  try {
    arm::require_valid(with_mass(arm, 0.1, 1.2));
    FAIL();
  } catch (const arm::InputError& error) {
    EXPECT_STREQ(error.what(),
                 "effects.attached_mass.position = 1.2 m: must be 0 or more and at most the beam's "
                 "length, 0.96 m");
  }
  arm::Arm longer = with_mass(arm, 0.1, 1.0);
  put(longer, "beam_length", {{"factor", 1.1}});
  EXPECT_NO_THROW(arm::require_valid(longer));
}

TEST(AttachedMass, IsRefusedByShapesThatCannotFollowIt) {
  const arm::Arm arm = with_mass(laws::damped_arm(), 0.1, 0.4);
  try {
    assumed_modes::AssumedModesArm(arm, {.basis = assumed_modes::Basis::pinned_free});
    FAIL();
  } catch (const arm::InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("effects.attached_mass: basis pinned_free"));
  }
}

}  // namespace
}  // namespace flexarm::effects
