#include "laws/subjects.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

namespace flexarm::laws {
namespace {

using arm::Arm;
using arm::Sensor;

constexpr int kRoots = 5;

/// Limits are taken with a ratio of this size; what is left of the limit's distance is its inverse.
constexpr double kNearLimit = 1e8;
constexpr double kLimitTolerance = 100.0 / kNearLimit;

class RootLaws : public testing::TestWithParam<Subject> {
 protected:
  std::vector<double> poles(const Arm& arm) const {
    return response::poles(GetParam().make(arm), kRoots).omega_rad_per_s;
  }
  std::vector<double> hub_zeros(const Arm& arm) const {
    std::vector<double> omega;
    const auto zeros = response::zeros(GetParam().make(arm), kHubAngle, kRoots);
    for (const auto s : zeros.s_rad_per_s) {
      EXPECT_EQ(s.real(), 0.0) << "zeros of a collocated sensor lie on the imaginary axis";
      omega.push_back(s.imag());
    }
    return omega;
  }
  std::vector<std::complex<double>> tip_zeros(const Arm& arm, int count) const {
    return response::zeros(GetParam().make(arm), kTipAcceleration, count).s_rad_per_s;
  }
  double tolerance() const { return GetParam().root_tolerance; }
};

void expect_relative(const std::vector<double>& actual, const std::vector<double>& expected,
                     double tolerance) {
  ASSERT_EQ(actual.size(), expected.size());
  for (std::size_t i = 0; i < actual.size(); ++i) {
    EXPECT_NEAR(actual[i] / expected[i], 1.0, tolerance) << "root " << i + 1;
  }
}

/// omega = lambda^2 for the unit arm.
std::vector<double> squares(const std::vector<double>& lambdas) {
  std::vector<double> omega;
  for (const double lambda : lambdas) omega.push_back(lambda * lambda);
  return omega;
}

// Roots of the classical frequency equations; [Blevins1979],
// table 8-1, carried to 13 digits with the equations named.
const std::vector<double> kClampedFree = {1.875104068712, 4.694091132974, 7.854757438238,
                                          10.995540734875, 14.137168391046};  // 1 + cos cosh = 0
const std::vector<double> kPinnedFree = {3.926602312048, 7.068582745629, 10.210176122813,
                                         13.351768777754, 16.493361431346};  // tan = tanh
constexpr double kTableRounding = 1e-12;

TEST_P(RootLaws, ThereIsExactlyOneRigidBodyMode) {
  for (const auto& arm : varied_arms()) {
    EXPECT_EQ(response::poles(GetParam().make(arm), kRoots).lowest_omega_squared_rad2_per_s2, 0.0);
    EXPECT_GT(poles(arm).front(), 0.0);
  }
}

TEST_P(RootLaws, PolesAndZerosScaleWithTheRootOfRigidityOverDensityAndLengthSquared) {
  Arm small = unit_arm(0.1);
  small.payload = {0.5, 0.02};
  const double l = 0.37;
  const double EI = 12.5;
  const double m = 0.21;
  Arm scaled;
  scaled.beam = arm::Beam::from_rigidity(l, EI, m);
  scaled.hub.inertia_kg_m2 = 0.1 * m * l * l * l;
  scaled.payload = {0.5 * m * l, 0.02 * m * l * l * l};
  const double factor = std::sqrt(EI / m) / (l * l);
  auto expected_poles = poles(small);
  auto expected_zeros = hub_zeros(small);
  for (double& omega : expected_poles) omega *= factor;
  for (double& omega : expected_zeros) omega *= factor;
  // The same discrete problem up to a scale: only rounding differs.
  constexpr double kScalingRounding = 1e-11;
  expect_relative(poles(scaled), expected_poles, kScalingRounding);
  expect_relative(hub_zeros(scaled), expected_zeros, kScalingRounding);
}

TEST_P(RootLaws, AnArmGivenInMillimetresAndGramsHasTheSameFrequencies) {
  // N m^2 = kg m^3/s^2 = 1e12 g mm^3/s^2; kg/m = g/mm; kg m^2 = 1e9 g mm^2.
  for (const auto& si : varied_arms()) {
    Arm other;
    other.beam =
        arm::Beam::from_rigidity(si.beam.length_m * 1e3, si.beam.flexural_rigidity_N_m2() * 1e12,
                                 si.beam.linear_density_kg_per_m());
    other.hub.inertia_kg_m2 = si.hub.inertia_kg_m2 * 1e9;
    other.payload = {si.payload.mass_kg * 1e3, si.payload.inertia_kg_m2 * 1e9};
    constexpr double kScalingRounding = 1e-11;
    expect_relative(poles(other), poles(si), kScalingRounding);
  }
}

TEST_P(RootLaws, AHeavyHubGivesTheCantileversPoles) {
  expect_relative(poles(unit_arm(kNearLimit)), squares(kClampedFree),
                  tolerance() + kLimitTolerance);
}

TEST_P(RootLaws, NoHubInertiaGivesThePinnedFreePoles) {
  expect_relative(poles(unit_arm(0.0)), squares(kPinnedFree), tolerance() + kTableRounding);
}

TEST_P(RootLaws, HubZerosAreTheCantileversFrequencies) {
  expect_relative(hub_zeros(unit_arm(0.3)), squares(kClampedFree), tolerance() + kTableRounding);
}

TEST_P(RootLaws, AHeavyPayloadGivesClampedPinnedZeros) {
  Arm arm = unit_arm(0.1);
  arm.payload.mass_kg = kNearLimit;
  const auto zeros = hub_zeros(arm);
  ASSERT_EQ(zeros.size(), static_cast<std::size_t>(kRoots));
  // The first is the payload on a massless spring: omega^2 = 3 EI/(Mp l^3).
  EXPECT_NEAR(zeros.front() / std::sqrt(3.0 / kNearLimit), 1.0, kLimitTolerance);
  for (std::size_t i = 1; i < zeros.size(); ++i) {
    EXPECT_NEAR(zeros[i] / (kPinnedFree[i - 1] * kPinnedFree[i - 1]), 1.0,
                tolerance() + kLimitTolerance);
  }
}

TEST_P(RootLaws, HubZerosDoNotDependOnHubInertia) {
  Arm arm = varied_arms()[2];
  const auto zeros = hub_zeros(arm);
  for (const double inertia : {0.0, 1e-3, 10.0}) {
    arm.hub.inertia_kg_m2 = inertia;
    expect_relative(hub_zeros(arm), zeros, tolerance());
  }
}

TEST_P(RootLaws, HubVelocityHasTheZerosOfHubAngle) {
  const auto model = GetParam().make(varied_arms()[1]);
  EXPECT_EQ(response::zeros(model, kHubVelocity, kRoots).s_rad_per_s,
            response::zeros(model, kHubAngle, kRoots).s_rad_per_s);
}

TEST_P(RootLaws, TipZerosDoNotDependOnPayloadMassNorHubInertia) {
  constexpr int kTipZeros = 2;
  // A non-collocated zero of a discrete model converges with half the digits to spare.
  const double tip_tolerance = 100.0 * tolerance();
  Arm arm = arm::paper_arm();
  const auto zeros = tip_zeros(arm, kTipZeros);
  ASSERT_EQ(zeros.size(), static_cast<std::size_t>(kTipZeros));
  for (const double mass : {0.05, 1.0}) {
    for (const double inertia : {0.0, 0.02}) {
      arm.payload.mass_kg = mass;
      arm.hub.inertia_kg_m2 = inertia;
      const auto moved = tip_zeros(arm, kTipZeros);
      ASSERT_EQ(moved.size(), zeros.size());
      for (std::size_t i = 0; i < zeros.size(); ++i) {
        EXPECT_LE(std::abs(moved[i] - zeros[i]), tip_tolerance * std::abs(zeros[i]));
      }
    }
  }
}

TEST_P(RootLaws, PayloadInertiaPutsOnePairOfTipZerosOnTheImaginaryAxis) {
  Arm arm = unit_arm(0.1);
  arm.payload.inertia_kg_m2 = 1e-2;
  int imaginary = 0;
  for (const auto s : tip_zeros(arm, 4)) imaginary += s.imag() > s.real() ? 1 : 0;
  EXPECT_EQ(imaginary, 1);
}

TEST_P(RootLaws, PolesAndHubZerosInterlace) {
  for (const auto& arm : varied_arms()) {
    const auto p = poles(arm);
    const auto z = hub_zeros(arm);
    ASSERT_EQ(p.size(), z.size());
    for (std::size_t i = 0; i < p.size(); ++i) {
      EXPECT_LT(z[i], p[i]);
      if (i + 1 < z.size()) {
        EXPECT_LT(p[i], z[i + 1]);
      }
    }
  }
}

TEST_P(RootLaws, MoreInertiaAnywhereLowersEveryPole) {
  const auto before = poles(varied_arms()[1]);
  for (int where = 0; where < 3; ++where) {
    Arm arm = varied_arms()[1];
    if (where == 0) arm.hub.inertia_kg_m2 *= 2.0;
    if (where == 1) arm.payload.mass_kg *= 2.0;
    if (where == 2) arm.payload.inertia_kg_m2 += 1e-3;
    const auto after = poles(arm);
    for (std::size_t i = 0; i < before.size(); ++i) EXPECT_LT(after[i], before[i]);
  }
}

INSTANTIATE_TEST_SUITE_P(EveryFormulation, RootLaws, testing::ValuesIn(every_formulation()),
                         [](const auto& subject) { return subject.param.name; });

}  // namespace
}  // namespace flexarm::laws
