#include "assumed_modes/assumed_modes_arm.hpp"
#include "effects.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace flexarm::assumed_modes {
namespace {

using testing_arms::kDefault;
using testing_arms::kRounding;
using testing_arms::NamedArm;

/// Sixty-four bits of zeros that are ill-conditioned: a digit and a half fewer each.
constexpr double kTipZeros = 1e-7;

/// Poles, then hub zeros by size of s^2.
std::vector<double> roots_of(const AssumedModesArm& model, int count) {
  std::vector<double> roots = model.poles(count).omega_rad_per_s;
  for (const auto& s : model.zeros(testing_arms::kHubAngle, count).s_rad_per_s) {
    roots.push_back(std::abs(s));
  }
  return roots;
}

double change(const std::vector<double>& roots, const std::vector<double>& finer) {
  EXPECT_EQ(roots.size(), finer.size());
  double worst = 0.0;
  for (std::size_t i = 0; i < roots.size(); ++i) {
    worst = std::max(worst, std::abs(roots[i] / finer[i] - 1.0));
  }
  return worst;
}

TEST(EffectsConvergence, TheDefaultGivesTenPolesAndTenHubZerosToRounding) {
  for (const auto& [name, arm] : testing_arms::arms_with_effects()) {
    const AssumedModesArm model(arm, {Basis::legendre, kDefault});
    const AssumedModesArm finer(arm, {Basis::legendre, kDefault + 20});
    EXPECT_LE(change(roots_of(model, 10), roots_of(finer, 10)), kRounding) << name;
    const double lowest = model.poles(1).lowest_omega_squared_rad2_per_s2;
    EXPECT_NEAR(lowest, finer.poles(1).lowest_omega_squared_rad2_per_s2,
                kRounding * std::abs(lowest))
        << name;
  }
}

TEST(EffectsConvergence, ACrackAnywhereAndASoftRootOfAnyStiffnessChangeNothing) {
  for (const double stiffness : {1e-6, 1e-2, 1.0, 1e3, 1e9}) {
    for (const double position : {1e-4, 0.07, 0.35, 0.5, 0.93, 0.9999}) {
      const arm::Arm arm =
          testing_arms::with(testing_arms::unit_arm(0.1, 0.5, 0.02), "local_stiffness_loss",
                             {{"position", position}, {"stiffness", stiffness}});
      EXPECT_LE(change(roots_of(AssumedModesArm(arm, {Basis::legendre, kDefault}), 10),
                       roots_of(AssumedModesArm(arm, {Basis::legendre, kDefault + 20}), 10)),
                kRounding)
          << position << ' ' << stiffness;
    }
    const arm::Arm arm = testing_arms::with(testing_arms::unit_arm(0.1, 0.5, 0.02),
                                            "root_compliance", {{"stiffness", stiffness}});
    EXPECT_LE(change(roots_of(AssumedModesArm(arm, {Basis::legendre, kDefault}), 10),
                     roots_of(AssumedModesArm(arm, {Basis::legendre, kDefault + 20}), 10)),
              kRounding)
        << stiffness;
  }
}

/// Rate r of an error that falls as exp(-r n), by least squares above rounding.
struct Rate {
  double per_function = 0.0;
  int points = 0;
};

Rate fitted_rate(const arm::Arm& arm, int root) {
  const double exact = AssumedModesArm(arm, {Basis::legendre, 50})
                           .poles(root)
                           .omega_rad_per_s[static_cast<std::size_t>(root) - 1];
  std::vector<double> n;
  std::vector<double> log_error;
  for (int functions = root + 3; functions <= 40; ++functions) {
    const double error = AssumedModesArm(arm, {Basis::legendre, functions})
                                 .poles(root)
                                 .omega_rad_per_s[static_cast<std::size_t>(root) - 1] /
                             exact -
                         1.0;
    if (error < 1e-14) break;
    n.push_back(functions);
    log_error.push_back(std::log(error));
  }
  Rate rate;
  rate.points = static_cast<int>(n.size());
  double mean_n = 0.0;
  double mean_log = 0.0;
  for (std::size_t i = 0; i < n.size(); ++i) {
    mean_n += n[i] / static_cast<double>(n.size());
    mean_log += log_error[i] / static_cast<double>(n.size());
  }
  double above = 0.0;
  double below = 0.0;
  for (std::size_t i = 0; i < n.size(); ++i) {
    above += (n[i] - mean_n) * (log_error[i] - mean_log);
    below += (n[i] - mean_n) * (n[i] - mean_n);
  }
  rate.per_function = -above / below;
  return rate;
}

TEST(EffectsConvergence, IsExponentialOrFasterWithEveryEffect) {
  // A decade and more for every function. A power n^-q would need q = 2.3 n at every n.
  constexpr double kDecade = 2.3;
  for (const auto& [name, arm] : testing_arms::arms_with_effects()) {
    const Rate rate = fitted_rate(arm, 4);
    RecordProperty(name, std::to_string(rate.per_function));
    ASSERT_GE(rate.points, 4) << name;
    EXPECT_GE(rate.per_function, kDecade) << name << " over " << rate.points << " points";
  }
}

TEST(EffectsConvergence, RitzValuesFallTowardsTheExactOnes) {
  for (const auto& [name, arm] : testing_arms::arms_with_effects()) {
    const AssumedModesArm exact(arm, {Basis::legendre, kDefault});
    const auto exact_poles = exact.poles(5).omega_rad_per_s;
    auto before = AssumedModesArm(arm, {Basis::legendre, 7}).poles(5).omega_rad_per_s;
    for (int functions = 8; functions <= 24; ++functions) {
      const AssumedModesArm model(arm, {Basis::legendre, functions});
      const auto poles = model.poles(5).omega_rad_per_s;
      for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_LE(poles[i], before[i] * (1.0 + kRounding)) << name;
        EXPECT_GE(poles[i], exact_poles[i] * (1.0 - kRounding)) << name;
      }
      before = poles;
    }
  }
}

TEST(EffectsConvergence, HubZerosAndPolesInterlace) {
  for (const auto& [name, arm] : testing_arms::arms_with_effects()) {
    const AssumedModesArm model(arm, {Basis::legendre, kDefault});
    const auto poles = model.poles(10).omega_rad_per_s;
    const auto zeros = model.zeros(testing_arms::kHubAngle, 10).s_rad_per_s;
    EXPECT_LE(model.poles(1).lowest_omega_squared_rad2_per_s2,
              (-zeros[0] * zeros[0]).real() * (1.0 + kRounding))
        << name;
    for (std::size_t i = 0; i < 10; ++i) {
      EXPECT_LE(zeros[i].imag(), poles[i] * (1.0 + kRounding)) << name;
      if (i > 0) {
        EXPECT_GE(zeros[i].imag(), poles[i - 1] * (1.0 - kRounding)) << name;
      }
    }
  }
}

TEST(EffectsConvergence, FourTipZerosAreThoseOfMoreFunctions) {
  for (const auto& [name, arm] : testing_arms::arms_with_effects()) {
    for (const arm::Sensor& sensor :
         {testing_arms::kTipAcceleration, testing_arms::kTipDeflection}) {
      const auto zeros =
          AssumedModesArm(arm, {Basis::legendre, kDefault}).zeros(sensor, 4).s_rad_per_s;
      const auto finer =
          AssumedModesArm(arm, {Basis::legendre, kDefault + 10}).zeros(sensor, 4).s_rad_per_s;
      ASSERT_EQ(zeros.size(), 4U) << name;
      ASSERT_EQ(finer.size(), 4U) << name;
      for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_LE(std::abs(zeros[i] / finer[i] - 1.0), kTipZeros)
            << name << ' ' << arm::to_string(sensor) << ' ' << i << ' ' << zeros[i];
      }
    }
  }
}

TEST(EffectsConvergence, OtherBasesConvergeToTheSameArm) {
  arm::Arm arm = testing_arms::unit_arm(0.1, 0.5, 0.02);
  arm = testing_arms::with(arm, "hub_radius", {{"radius", 0.2}});
  arm = testing_arms::with(arm, "hub_spring", {{"stiffness", 2.0}});
  arm = testing_arms::with(arm, "payload_offset", {{"offset", 0.1}});
  arm = testing_arms::with(arm, "gravity", {{"acceleration", 10.0}});
  const AssumedModesArm exact(arm, {Basis::legendre, kDefault});
  const auto roots = roots_of(exact, 3);
  // Errors that fall as 1/n at the slowest (basis_report.hpp).
  for (const Basis basis : kAllBases) {
    double before = 1.0;
    for (const int functions : {10, 20, 40, 80}) {
      const double error = change(roots_of(AssumedModesArm(arm, {basis, functions}), 3), roots);
      EXPECT_LE(error, before * 0.7 + kRounding) << to_string(basis) << ' ' << functions;
      before = error;
    }
    EXPECT_LE(before, 0.02) << to_string(basis);
  }
}

}  // namespace
}  // namespace flexarm::assumed_modes
