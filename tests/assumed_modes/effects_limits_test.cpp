#include "arm/input_error.hpp"
#include "assumed_modes/assumed_modes_arm.hpp"
#include "effects.hpp"
#include "effects/registry/vocabulary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace flexarm::assumed_modes {
namespace {

using testing_arms::kHubAngle;
using testing_arms::kRounding;
using testing_arms::unit_arm;
using testing_arms::with;

std::vector<double> poles_of(const arm::Arm& arm, int count = 6) {
  return AssumedModesArm(arm, {Basis::legendre, 40}).poles(count).omega_rad_per_s;
}

double lowest_of(const arm::Arm& arm) {
  return AssumedModesArm(arm, {Basis::legendre, 40}).poles(1).lowest_omega_squared_rad2_per_s2;
}

std::vector<double> hub_zeros_of(const arm::Arm& arm, int count = 6) {
  std::vector<double> omega;
  for (const auto& s :
       AssumedModesArm(arm, {Basis::legendre, 40}).zeros(kHubAngle, count).s_rad_per_s) {
    omega.push_back(s.imag());
  }
  return omega;
}

void expect_close(const std::vector<double>& a, const std::vector<double>& b, double relative,
                  const std::string& what) {
  ASSERT_EQ(a.size(), b.size()) << what;
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_NEAR(a[i] / b[i], 1.0, relative) << what << ' ' << i + 1;
  }
}

TEST(EffectsLimits, AreThePlainArmToFirstOrder) {
  const arm::Arm plain = unit_arm(0.1, 0.5, 0.02);
  const auto limit = poles_of(plain);
  struct Vanishing {
    const char* effect;
    const char* parameter;
    double near;
    double nearer;
  };
  for (const auto& [effect, parameter, near, nearer] :
       {Vanishing{"local_stiffness_loss", "stiffness", 1e5, 1e6},
        Vanishing{"root_compliance", "stiffness", 1e5, 1e6},
        Vanishing{"hub_radius", "radius", 1e-5, 1e-6},
        Vanishing{"payload_offset", "offset", 1e-5, 1e-6},
        Vanishing{"hub_spring", "stiffness", 1e-5, 1e-6},
        Vanishing{"gravity", "acceleration", 1e-5, 1e-6}}) {
    const auto change = [&](double value) {
      arm::Arm arm = with(plain, effect, {{parameter, value}});
      if (arm.effects.contains("local_stiffness_loss")) {
        effects::put(arm, "local_stiffness_loss", {{"position", 0.4}});
      }
      auto roots = poles_of(arm);
      for (std::size_t i = 0; i < roots.size(); ++i) roots[i] = roots[i] / limit[i] - 1.0;
      return roots;
    };
    const auto first = change(near);
    const auto second = change(nearer);
    for (std::size_t i = 0; i < first.size(); ++i) {
      EXPECT_LE(std::abs(first[i]), 1e-3) << effect;
      // Changes of 1e-9 are known to 1e-16; the second order is 1e-5 of the first, times what the
      // sixth mode's wavenumber makes of it.
      if (std::abs(second[i]) > 1e-9) {
        EXPECT_NEAR(second[i] / first[i], 0.1, 1e-3) << effect << ' ' << i;
      }
    }
  }
}

TEST(EffectsLimits, AStiffHubSpringClampsTheHub) {
  // All poles become the hub's zeros, the lowest among them; the distance is of order 1/ks.
  const arm::Arm arm = with(unit_arm(0.1, 0.5, 0.02), "hub_spring", {{"stiffness", 1e9}});
  const auto zeros = hub_zeros_of(arm, 7);
  EXPECT_NEAR(std::sqrt(lowest_of(arm)) / zeros[0], 1.0, 1e-8);
  const auto poles = poles_of(arm, 6);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(poles[i] / zeros[i + 1], 1.0, 1e-6);
}

TEST(EffectsLimits, AWeakSpringTurnsTheRigidArm) {
  for (const double stiffness : {1e-30, 1e-12, 1e-6}) {
    const arm::Arm arm = with(unit_arm(0.1, 0.5, 0.02), "hub_spring", {{"stiffness", stiffness}});
    EXPECT_NEAR(lowest_of(arm) * arm::total_inertia_kg_m2(arm) / stiffness, 1.0,
                stiffness + kRounding);
  }
}

TEST(EffectsLimits, WeakGravityMakesAPendulumThatHangsOrFalls) {
  // g times the first moment of what is beyond the axis: m l (a + l/2) + Mp (a + l + offset).
  arm::Arm arm = with(unit_arm(0.1, 0.5, 0.02), "hub_radius", {{"radius", 0.3}});
  arm = with(arm, "payload_offset", {{"offset", 0.1}});
  const double moment = 0.8 + 0.5 * 1.4;
  for (const double g : {1e-9, -1e-9, 1e-6, -1e-6}) {
    arm = with(arm, "gravity", {{"acceleration", g}});
    EXPECT_NEAR(lowest_of(arm) * arm::total_inertia_kg_m2(arm) / (g * moment), 1.0,
                std::abs(g) + kRounding)
        << g;
  }
}

TEST(EffectsLimits, AHangingChainInStrongGravity) {
  // Without stiffness, hub inertia or payload omega = j_{0,1}/2 sqrt(g/l), by a zero of the Bessel
  // function J_0 (Daniel Bernoulli). Hinge and free end need no boundary layer: the stiffness adds
  // the order of EI/(m g l^3).
  constexpr double kFirstZero = 2.404825557695773;
  double before = 1.0;
  for (const double g : {100.0, 1000.0, 10000.0}) {
    const arm::Arm arm = with(unit_arm(0.0, 0.0, 0.0), "gravity", {{"acceleration", g}});
    const double change = std::sqrt(lowest_of(arm) / g) / (kFirstZero / 2) - 1.0;
    EXPECT_GT(change, 0.0);
    EXPECT_LE(change, 1.0 / g);
    EXPECT_LT(change, before);
    before = change;
  }
}

TEST(EffectsLimits, AClampedColumnBucklesUnderItsOwnWeight) {
  // [Greenhill1881]: q l^3/EI = 7.8373, the root of J_{-1/3}(2/3 sqrt(q)).
  constexpr double kGreenhill = 7.837347438943;
  constexpr double kSpringIsNotAClamp = 1e-7;
  const arm::Arm clamped = with(unit_arm(0.1, 0.0, 0.0), "hub_spring", {{"stiffness", 1e9}});
  const arm::Arm free = unit_arm(0.1, 0.0, 0.0);
  for (const double side : {-1.0, 1.0}) {
    const double g = -kGreenhill * (1.0 + side * kSpringIsNotAClamp);
    EXPECT_EQ(lowest_of(with(clamped, "gravity", {{"acceleration", g}})) < 0, side > 0);
    // The hub's first zero is the held column's frequency: imaginary, then real.
    const auto zero = AssumedModesArm(with(free, "gravity", {{"acceleration", g}}))
                          .zeros(kHubAngle, 1)
                          .s_rad_per_s[0];
    EXPECT_EQ(zero.real() > 0, side > 0);
    EXPECT_EQ(zero.imag() > 0, side < 0);
    EXPECT_LE(std::abs(zero), 0.01);
  }
}

TEST(EffectsLimits, AFlexibleModeThatBucklesIsRefusedByName) {
  // The second buckling load of a pinned column under its own weight lies near q = 25.6.
  const arm::Arm arm = unit_arm(0.1, 0.0, 0.0);
  EXPECT_NO_THROW(AssumedModesArm(with(arm, "gravity", {{"acceleration", -25.0}})));
  for (const double g : {-27.0, -1000.0, -9999.0}) {
    try {
      const AssumedModesArm model(with(arm, "gravity", {{"acceleration", g}}));
      FAIL() << g;
    } catch (const arm::InputError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr("effects.gravity.acceleration"));
      EXPECT_THAT(error.what(), testing::HasSubstr("buckle"));
    }
  }
}

TEST(EffectsLimits, AThinBeamIsStiffInShearAndDoesNotLock) {
  // Timoshenko's correction is of order (thickness/l)^2; locking would be an excess that grows as
  // the beam gets thin, at a fixed and small number of functions most of all.
  for (const int functions : {10, 40}) {
    const auto poles = [&](double thickness, bool shear) {
      arm::Arm arm = testing_arms::thick_arm(thickness);
      if (shear) arm = with(arm, "shear_and_rotary_inertia", {});
      return AssumedModesArm(arm, {Basis::legendre, functions}).poles(3).omega_rad_per_s;
    };
    for (const double thickness : {1e-1, 1e-2, 1e-4, 1e-6}) {
      const auto bent = poles(thickness, false);
      const auto sheared = poles(thickness, true);
      for (std::size_t i = 0; i < 3; ++i) {
        const double change = 1.0 - sheared[i] / bent[i];
        EXPECT_LE(change, 100.0 * thickness * thickness + kRounding) << thickness;
        EXPECT_GE(change, -kRounding) << thickness << ' ' << functions;
      }
    }
  }
}

TEST(EffectsLimits, AShearingBeamOfGreatBendingStiffness) {
  // k G A l^2/EI at its lower bound: hub held, the first zeros approach those of a shear beam,
  // omega = (2k - 1) pi/2 sqrt(kGA/m)/l, from below.
  arm::Arm arm = unit_arm(0.0, 0.0, 0.0);
  arm.beam = {};
  arm.beam.length_m = 1.0;
  arm.beam.width_m = 1.0;
  arm.beam.thickness_m = 1e-3;
  arm.beam.density_kg_per_m3 = 1e3;
  arm.beam.youngs_modulus_Pa = 12e9;
  arm.beam.shear_modulus_Pa = 12e3;
  arm = with(arm, "shear_and_rotary_inertia", {{"shear_coefficient", 5.0 / 6.0}});
  const double shear = 12e3 * 1e-3 * 5.0 / 6.0;
  const auto zeros = hub_zeros_of(arm, 1);
  using std::numbers::pi;
  EXPECT_LT(zeros[0], pi / 2 * std::sqrt(shear));
  // Dunkerley's lower bound from bending alone, 3.516^2, and shear alone.
  EXPECT_GT(zeros[0], 1.0 / std::sqrt(1.0 / 12.36 + 4.0 / (pi * pi * shear)) * 0.999);
}

TEST(EffectsLimits, SpringsInSeriesAreOne) {
  // A soft root and a crack that lies right behind it.
  const arm::Arm plain = unit_arm(0.1, 0.5, 0.02);
  const arm::Arm one = with(plain, "root_compliance", {{"stiffness", 1.0}});
  arm::Arm two = with(plain, "root_compliance", {{"stiffness", 2.0}});
  two = with(two, "local_stiffness_loss", {{"position", 0.0}, {"stiffness", 2.0}});
  expect_close(poles_of(two), poles_of(one), kRounding, "at the root");
  two = with(two, "local_stiffness_loss", {{"position", 1e-9}, {"stiffness", 2.0}});
  expect_close(poles_of(two), poles_of(one), 1e-7, "behind the root");
}

TEST(EffectsLimits, ASoftRootAloneSplitsHubAndBeam) {
  // Hub and rigid beam on either side of a soft spring: omega^2 = kr (1/Ih + 1/Ib).
  const arm::Arm arm = with(unit_arm(0.1, 0.5, 0.02), "root_compliance", {{"stiffness", 1e-6}});
  const double beam = 1.0 / 3.0 + 0.5 + 0.02;
  EXPECT_NEAR(std::pow(poles_of(arm)[0], 2) / (1e-6 * (1.0 / 0.1 + 1.0 / beam)), 1.0, 1e-5);
  // The hub held, the beam swings on the spring.
  EXPECT_NEAR(std::pow(hub_zeros_of(arm)[0], 2) * beam / 1e-6, 1.0, 1e-5);
}

TEST(EffectsLimits, HeavyPayloadsKeepAllDigits) {
  // A payload of great mass and inertia hardly moves: what is left of its motion is of order 1/Mp.
  // The lowest, the payload turning on the beam, is left out: it falls as Mp^-1/2.
  for (const double ratio : {1e7, 1e9}) {
    const arm::Arm arm = unit_arm(0.1, ratio, ratio);
    const auto poles = poles_of(arm);
    const auto lighter = poles_of(unit_arm(0.1, ratio / 10, ratio / 10));
    for (std::size_t i = 1; i < poles.size(); ++i) {
      EXPECT_NEAR(poles[i] / lighter[i], 1.0, 100.0 / ratio) << ratio;
    }
    const AssumedModesArm finer(arm, {Basis::legendre, 60});
    expect_close(poles, finer.poles(6).omega_rad_per_s, kRounding, "more functions");
  }
}

}  // namespace
}  // namespace flexarm::assumed_modes
