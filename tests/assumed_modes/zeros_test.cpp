#include "arms.hpp"
#include "assumed_modes/assumed_modes_arm.hpp"

#include <boost/math/constants/constants.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>

namespace flexarm::assumed_modes {
namespace {

using Complex = std::complex<double>;
using testing_arms::kTipAcceleration;
using testing_arms::kTipDeflection;
using testing_arms::strain_at;

TEST(Zeros, AreWhereTheTransferFunctionVanishes) {
  // Against the response at 1.01 of the zero; both are about as small as the zero is well
  // conditioned, 1e-9 for the sixth at the tip.
  constexpr double kVanishes = 1e-6;
  const AssumedModesArm model(testing_arms::unit_arm(0.1, 0.5, 0.02));
  for (const arm::Sensor& sensor :
       {testing_arms::kHubAngle, testing_arms::kHubVelocity, kTipAcceleration, kTipDeflection,
        strain_at(0.0), strain_at(0.25), strain_at(0.7), strain_at(1.0)}) {
    const auto zeros = model.zeros(sensor, 6);
    ASSERT_EQ(zeros.s_rad_per_s.size(), 6U) << arm::to_string(sensor);
    double previous = 0.0;
    for (const Complex& s : zeros.s_rad_per_s) {
      EXPECT_GE(s.real(), 0.0);
      EXPECT_GE(s.imag(), 0.0);
      EXPECT_GT(std::abs(s), previous) << arm::to_string(sensor);
      previous = std::abs(s);
      EXPECT_LE(std::abs(model.transfer_function(sensor, s)),
                kVanishes * std::abs(model.transfer_function(sensor, 1.01 * s)))
          << arm::to_string(sensor) << ' ' << s;
    }
  }
}

TEST(Zeros, TipAccelerationHasRealZerosAndThePayloadsInertiaAddsAnImaginaryPair) {
  const auto without =
      AssumedModesArm(testing_arms::unit_arm(0.1, 0.5, 0.0)).zeros(kTipAcceleration, 6).s_rad_per_s;
  for (const Complex& s : without) EXPECT_EQ(s.imag(), 0.0);
  const auto with = AssumedModesArm(testing_arms::unit_arm(0.1, 0.5, 0.02))
                        .zeros(kTipAcceleration, 6)
                        .s_rad_per_s;
  EXPECT_EQ(with[0].real(), 0.0);
  EXPECT_GT(with[0].imag(), 0.0);
  for (std::size_t i = 1; i < with.size(); ++i) EXPECT_EQ(with[i].imag(), 0.0);
}

TEST(Zeros, AtTheHubVelocityAreThoseOfTheAngle) {
  const AssumedModesArm model(testing_arms::unit_arm(0.1, 0.5, 0.02));
  EXPECT_EQ(model.zeros(testing_arms::kHubAngle, 6).s_rad_per_s,
            model.zeros(testing_arms::kHubVelocity, 6).s_rad_per_s);
}

TEST(Zeros, SpuriousOnesAreReportedWithWhatGaveThemAway) {
  const AssumedModesArm model(arm::paper_arm());
  const auto zeros = model.zeros(kTipAcceleration, 6);
  ASSERT_FALSE(zeros.rejected.empty());
  double previous = 0.0;
  for (const arm::RejectedZero& rejected : zeros.rejected) {
    EXPECT_GT(rejected.relative_change, model.options().zero_change);
    EXPECT_FALSE(rejected.reason.empty());
    EXPECT_GE(std::abs(rejected.s_rad_per_s), previous);
    previous = std::abs(rejected.s_rad_per_s);
    // Every true zero of this arm is real; what lies among the first six would be a loss.
    EXPECT_GT(std::abs(rejected.s_rad_per_s), zeros.s_rad_per_s.back().real());
  }
  EXPECT_LE(zeros.summary.largest_residual, 1e-9);
  EXPECT_TRUE(zeros.summary.converged);
  EXPECT_EQ(zeros.count.found, 6);
}

/// The k-th tip zero of an arm without payload inertia: s = 2 beta^2, tan beta = -tanh beta (half
/// the symmetric free-free beam's), by Newton from its asymptote.
double exact_tip_zero(int k) {
  const double asymptote = (k - 0.25) * boost::math::constants::pi<double>();
  double beta = asymptote;
  for (int step = 0; step < 5; ++step) {
    const double slope = std::pow(std::cos(beta), -2) + std::pow(std::cosh(beta), -2);
    beta -= (std::tan(beta) + std::tanh(beta)) / slope;
  }
  return 2 * beta * beta;
}

TEST(Zeros, NoFalseOneIsTrustedAndNoneIsSkippedInAnyBasis) {
  // A trusted zero may be off by the slow bases' own error, far below the gap to the next, 2/k.
  constexpr double kOwnError = 0.03;
  const arm::Arm arm = testing_arms::unit_arm(0.1, 0.0, 0.0);
  int trusted = 0;
  for (const Basis basis : kAllBases) {
    for (int functions = 6; functions <= 48; functions += 3) {
      const auto zeros =
          AssumedModesArm(arm, {basis, functions}).zeros(kTipAcceleration, functions).s_rad_per_s;
      for (std::size_t i = 0; i < zeros.size(); ++i) {
        EXPECT_LE(std::abs(zeros[i] / exact_tip_zero(static_cast<int>(i) + 1) - 1.0), kOwnError)
            << to_string(basis) << ' ' << functions << " zero " << i + 1;
      }
      trusted += static_cast<int>(zeros.size());
    }
  }
  EXPECT_GE(trusted, 150);
}

TEST(Zeros, ALooserBoundTrustsMore) {
  const arm::Arm arm = testing_arms::unit_arm(0.1, 0.5, 0.0);
  const auto rejected = [&](double zero_change) {
    return AssumedModesArm(arm, {Basis::clamped_free, 16, zero_change})
        .zeros(kTipAcceleration, 10)
        .rejected.size();
  };
  EXPECT_LT(rejected(0.1), rejected(1e-3));
}

TEST(Zeros, ADecouplingZeroAtTheOriginIsLeftOut) {
  // Deflection and strain do not see the rigid rotation: the pencil has a root at s = 0 that
  // cancels the rigid-body pole, and the response there is finite.
  const AssumedModesArm model(testing_arms::unit_arm(0.1, 0.5, 0.02));
  for (const arm::Sensor& sensor : {kTipDeflection, strain_at(0.25)}) {
    EXPECT_GT(std::abs(model.zeros(sensor, 1).s_rad_per_s[0]), 1.0);
    EXPECT_GT(std::abs(model.transfer_function(sensor, {0.0, 1e-6})), 1e-4);
  }
}

TEST(Zeros, EveryBasisFindsTheFirstTipZeros) {
  // Hub and tip are both ends where some basis is slow: order 1 in n at worst.
  constexpr double kSlowest = 0.05;
  const arm::Arm arm = arm::paper_arm();
  const auto exact = AssumedModesArm(arm).zeros(kTipAcceleration, 2).s_rad_per_s;
  for (const Basis basis : kAllBases) {
    const auto zeros = AssumedModesArm(arm, {basis, 40, 0.05}).zeros(kTipAcceleration, 2);
    ASSERT_EQ(zeros.s_rad_per_s.size(), 2U) << to_string(basis);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_LE(std::abs(zeros.s_rad_per_s[i] / exact[i] - 1.0), kSlowest) << to_string(basis);
    }
  }
}

}  // namespace
}  // namespace flexarm::assumed_modes
