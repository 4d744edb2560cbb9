// tuned_mass against its limits and against the fixed mass that it is at a real s.
#include "arm/input_error.hpp"
#include "effects/registry/vocabulary.hpp"
#include "laws/effect_arms.hpp"
#include "response/formulation_maker.hpp"
#include "tests/effects/linear_effects.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace flexarm::effects {
namespace {

using Complex = std::complex<double>;

constexpr int kTunedRoots = 6;

struct Tuned {
  double mass_kg = 0.02;
  double frequency_Hz = 14.0;
  double damping_ratio = 0.05;
  double position_m = 0.7;
};

arm::Arm with_tuned(arm::Arm arm, const Tuned& tuned) {
  put(arm, "tuned_mass",
      {{"mass", tuned.mass_kg},
       {"frequency", tuned.frequency_Hz},
       {"damping_ratio", tuned.damping_ratio},
       {"position", tuned.position_m}});
  return arm;
}

arm::Arm with_fixed(arm::Arm arm, double mass_kg, double position_m) {
  put(arm, "attached_mass", {{"mass", mass_kg}, {"position", position_m}});
  return arm;
}

/// -s^2 m (c s + k)/(m s^2 + c s + k) is -s^2 M with a real M where s is real.
TEST(TunedMass, IsAFixedMassAtEachRealS) {
  constexpr double kAgreement = 1e-9;
  const Tuned tuned;
  const double omega = 2.0 * std::numbers::pi * tuned.frequency_Hz;
  for (const double position_m : {0.7, 0.96}) {
    Tuned placed = tuned;
    placed.position_m = position_m;
    const arm::Arm arm = with_tuned(laws::damped_arm(), placed);
    for (const double s : {0.3 * omega, omega, 7.0 * omega}) {
      const double guided = 2.0 * tuned.damping_ratio * omega * s + omega * omega;
      const double mass_kg = tuned.mass_kg * guided / (s * s + guided);
      const arm::Arm fixed = with_fixed(laws::damped_arm(), mass_kg, position_m);
      for (const auto formulation : response::kFormulationNames) {
        const auto suspended = response::make_formulation(formulation, arm, kTunedRoots);
        const auto reference = response::make_formulation(formulation, fixed, kTunedRoots);
        expect_same_responses(
            suspended, reference,
            {"hub_angle", "tip_displacement", "tip_deflection", "strain@0.05", "strain@0.75"}, s,
            kAgreement);
      }
    }
  }
}

TEST(TunedMass, OnAStiffSuspensionIsAFixedMass) {
  Tuned tuned{.frequency_Hz = 3e3};
  const arm::Arm arm = laws::damped_arm();
  for (const auto formulation : response::kFormulationNames) {
    const auto fixed = pole_frequencies(
        formulation, with_fixed(arm, tuned.mass_kg, tuned.position_m), kTunedRoots);
    const auto found = pole_frequencies(formulation, with_tuned(arm, tuned), kTunedRoots);
    for (std::size_t i = 0; i < 4; ++i) {
      const double ratio = fixed[i] / (2.0 * std::numbers::pi * tuned.frequency_Hz);
      EXPECT_NEAR(found[i] / fixed[i], 1.0, ratio * ratio) << formulation << " pole " << i + 1;
    }
  }
}

TEST(TunedMass, OfNoWeightIsOnePoleMoreAndLeavesTheOthers) {
  const Tuned tuned{.mass_kg = 1e-9, .frequency_Hz = 20.0};
  constexpr double kTiny = 1e-6;
  const arm::Arm arm = laws::damped_arm();
  for (const auto formulation : response::kFormulationNames) {
    auto wanted = pole_frequencies(formulation, arm, kTunedRoots);
    wanted.push_back(2.0 * std::numbers::pi * tuned.frequency_Hz);
    std::ranges::sort(wanted);
    const auto found = pole_frequencies(formulation, with_tuned(arm, tuned), kTunedRoots);
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_NEAR(found[i] / wanted[i], 1.0, kTiny) << formulation << " pole " << i + 1;
    }
  }
  EXPECT_EQ(pole_frequencies("exact_tf", with_tuned(arm, {.mass_kg = 0.0}), kTunedRoots),
            pole_frequencies("exact_tf", arm, kTunedRoots));
}

TEST(TunedMass, WithoutDampingHoldsItsPlaceStillAtItsFrequency) {
  const arm::Arm arm = with_tuned(
      laws::damped_arm(),
      {.frequency_Hz = 20.0, .damping_ratio = 0.0, .position_m = laws::damped_arm().beam.length_m});
  const Complex s(0.0, 2.0 * std::numbers::pi * 20.0);
  const auto tip = arm::parse_sensor("tip_displacement");
  for (const auto formulation : response::kFormulationNames) {
    const auto model = response::make_formulation(formulation, arm, kTunedRoots);
    const double beside = std::abs(response::transfer_function(model, tip, 0.9 * s));
    EXPECT_LT(std::abs(response::transfer_function(model, tip, s)), 1e-9 * beside) << formulation;
    const auto zeros = response::zeros(model, tip, 4).s_rad_per_s;
    EXPECT_TRUE(std::ranges::any_of(zeros, [&](Complex zero) {
      return std::abs(zero - s) < 1e-9 * std::abs(s);
    })) << formulation;
  }
}

/// A rigid arm: the mass hangs on it by its suspension and, aside, by its weight. With hub and beam
/// of inertia I and static moment S about the axis, and x the excursion,
///
///     (I + m X^2) theta'' + m X x'' + g (S + m X) theta + g m x = 0
///     m X theta'' + m x'' + g m theta + k x = 0.
TEST(TunedMass, HangsBesideARigidArm) {
  constexpr double kElasticity = 1e-5;
  const Tuned tuned{.mass_kg = 0.2, .frequency_Hz = 1.5, .damping_ratio = 0.0, .position_m = 0.5};
  arm::Arm arm = laws::damped_arm();
  put(arm, "gravity", {{"acceleration", 9.81}});
  put(arm, "flexural_rigidity", {{"factor", 1e4}});
  const double l = arm.beam.length_m;
  const double inertia = arm::total_inertia_kg_m2(arm);
  const double moment = arm.beam.linear_density_kg_per_m() * l * l / 2.0 + arm.payload.mass_kg * l;
  const double m = tuned.mass_kg;
  const double X = tuned.position_m;
  const double k = m * std::pow(2.0 * std::numbers::pi * tuned.frequency_Hz, 2);
  // det(K - w M) = a w^2 - b w + c.
  const double k11 = 9.81 * (moment + m * X);
  const double k12 = 9.81 * m;
  const double m11 = inertia + m * X * X;
  const double a = m11 * m - m * m * X * X;
  const double b = k11 * m + m11 * k - 2.0 * k12 * m * X;
  const double c = k11 * k - k12 * k12;
  const double root = std::sqrt(b * b - 4.0 * a * c);
  for (const auto formulation : response::kFormulationNames) {
    const auto found =
        response::poles(response::make_formulation(formulation, with_tuned(arm, tuned), 2), 2);
    EXPECT_NEAR(found.lowest_omega_squared_rad2_per_s2 / ((b - root) / (2.0 * a)), 1.0, kElasticity)
        << formulation;
    EXPECT_NEAR(std::pow(found.omega_rad_per_s[0], 2) / ((b + root) / (2.0 * a)), 1.0, kElasticity)
        << formulation;
  }
}

}  // namespace
}  // namespace flexarm::effects
