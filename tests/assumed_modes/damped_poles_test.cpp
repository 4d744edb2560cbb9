#include "assumed_modes/damped_poles.hpp"

#include "arms.hpp"
#include "assumed_modes/assumed_modes_arm.hpp"

#include <Eigen/SVD>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <vector>

// Explicit, for all sources of this program: GCC 12 does not emit the implicit instantiation beside
// the precompiled header, and the program would not link.
template class Eigen::JacobiSVD<Eigen::MatrixXcd>;

namespace flexarm::assumed_modes {
namespace {

using Complex = std::complex<double>;
using testing_arms::unit_arm;

/// Roots are polished in long double and rounded to double.
constexpr double kPoleRounding = 1e-14;

arm::Arm damped_arm(double kelvin_voigt_s, double friction_N_m_s_per_rad) {
  arm::Arm arm = unit_arm(0.1, 0.5, 0.02);
  arm.damping.kelvin_voigt_s = kelvin_voigt_s;
  arm.hub.viscous_friction_N_m_s_per_rad = friction_N_m_s_per_rad;
  return arm;
}

std::vector<Complex> all_of(const arm::DampedPoleSet& poles) {
  std::vector<Complex> all = {poles.lowest.first_rad_per_s, poles.lowest.second_rad_per_s};
  for (const arm::PolePair& pair : poles.flexible) {
    all.push_back(pair.first_rad_per_s);
    all.push_back(pair.second_rad_per_s);
  }
  return all;
}

void expect_pairs_and_none_twice(const arm::DampedPoleSet& poles) {
  const auto all = all_of(poles);
  for (std::size_t i = 0; i + 1 < all.size(); i += 2) {
    if (all[i].imag() != 0.0) {
      EXPECT_GT(all[i].imag(), 0.0);
      EXPECT_EQ(all[i + 1], std::conj(all[i]));
    } else {
      EXPECT_EQ(all[i + 1].imag(), 0.0);
      EXPECT_LE(std::abs(all[i]), std::abs(all[i + 1]));
    }
  }
  for (std::size_t i = 2; i < all.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_GT(std::abs(all[i] - all[j]), 1e-12 * std::abs(all[i])) << all[i];
    }
  }
}

TEST(DampedPoles, WithoutDampingAreTheUndampedOnes) {
  const AssumedModesArm model(damped_arm(0.0, 0.0));
  const auto poles = model.damped_poles(10);
  const auto omega = model.poles(10).omega_rad_per_s;
  EXPECT_EQ(poles.lowest.first_rad_per_s, 0.0);
  EXPECT_EQ(poles.lowest.second_rad_per_s, 0.0);
  ASSERT_EQ(poles.flexible.size(), 10U);
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_LE(std::abs(poles.flexible[i].first_rad_per_s - Complex(0, omega[i])),
              kPoleRounding * omega[i]);
  }
  EXPECT_EQ(poles.summary.iterations, 1);
}

TEST(DampedPoles, KelvinVoigtAloneActsOnEachModeApart) {
  // s^2 + kv omega^2 s + omega^2 = 0, oscillating or not.
  for (const double time_s : {1e-5, 1e-3, 0.02, 0.5}) {
    const AssumedModesArm model(damped_arm(time_s, 0.0));
    const auto poles = model.damped_poles(10);
    const auto omega = model.poles(10).omega_rad_per_s;
    EXPECT_EQ(poles.lowest.second_rad_per_s, 0.0);
    expect_pairs_and_none_twice(poles);
    for (std::size_t i = 0; i < 10; ++i) {
      const Complex half(time_s * omega[i] * omega[i] / 2, 0.0);
      const Complex larger = -half - std::sqrt(half * half - omega[i] * omega[i]);
      const Complex smaller = omega[i] * omega[i] / larger;
      const Complex first = poles.flexible[i].first_rad_per_s;
      // At twice the critical damping the two meet, and each has half the digits.
      EXPECT_LE(std::min(std::abs(first - smaller), std::abs(first - larger)),
                1e-12 * std::abs(first))
          << time_s << ' ' << i;
    }
  }
}

TEST(DampedPoles, MakeTheResponseInfiniteWithFrictionOfAnySize) {
  for (const double friction : {1e-12, 1e-3, 0.3, 3.0, 40.0, 1e4}) {
    const AssumedModesArm model(damped_arm(1e-4, friction));
    const auto poles = model.damped_poles(8);
    expect_pairs_and_none_twice(poles);
    EXPECT_TRUE(poles.summary.converged) << friction;
    for (const Complex& s : all_of(poles)) {
      if (s == 0.0) continue;
      EXPECT_LT(s.real(), 0.0);
      // A real one among others that gather at -1/kv is hardly seen in the response.
      if (s.imag() == 0.0) continue;
      const double at = std::abs(model.transfer_function(testing_arms::kHubAngle, s));
      const double near = std::abs(model.transfer_function(testing_arms::kHubAngle, s * 1.001));
      EXPECT_TRUE(!std::isfinite(at) || at > 1e9 * near) << friction << ' ' << s;
    }
  }
}

TEST(DampedPoles, FrictionOnAFreeHubLeavesOneRootAtTheOrigin) {
  const arm::Arm arm = damped_arm(0.0, 1e-6);
  const auto lowest = AssumedModesArm(arm).damped_poles(1).lowest;
  EXPECT_EQ(lowest.first_rad_per_s, 0.0);
  // The rigid arm: s = -c/I_T, and flexibility adds of the order of (c/I_T)^3/omega^2.
  EXPECT_NEAR(lowest.second_rad_per_s.real() * arm::total_inertia_kg_m2(arm) / -1e-6, 1.0, 1e-12);
}

TEST(DampedPoles, GreatFrictionClampsTheHub) {
  const AssumedModesArm model(damped_arm(0.0, 1e7));
  const auto poles = model.damped_poles(6);
  const auto zeros = model.zeros(testing_arms::kHubAngle, 6).s_rad_per_s;
  std::vector<double> imaginary;
  for (const arm::PolePair& pair : poles.flexible) {
    imaginary.push_back(pair.first_rad_per_s.imag());
  }
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(imaginary[i] / zeros[i].imag(), 1.0, 1e-6) << i;
  }
}

/// Smallest singular value of s^2 + s D + diag(omega^2) over its largest, rows and columns scaled.
double singularity(const arm::ModalModel& modal, Complex s) {
  const auto n = static_cast<Eigen::Index>(modal.modes.size());
  Eigen::MatrixXcd dynamic =
      s * Eigen::Map<const Eigen::MatrixXd>(modal.damping_rad_per_s.data(), n, n).cast<Complex>();
  Eigen::VectorXd square(n);
  square(0) = modal.lowest_omega_squared_rad2_per_s2;
  for (Eigen::Index k = 1; k < n; ++k) {
    square(k) = std::pow(modal.modes[static_cast<std::size_t>(k)].omega_rad_per_s, 2);
  }
  dynamic.diagonal().array() += s * s + square.array().cast<Complex>();
  const Eigen::VectorXd size = (square.array().abs() + std::norm(s)).sqrt().inverse();
  const Eigen::MatrixXcd scaled =
      size.cast<Complex>().asDiagonal() * dynamic * size.cast<Complex>().asDiagonal();
  const auto values = Eigen::JacobiSVD<Eigen::MatrixXcd>(scaled).singularValues();
  return values(n - 1) / values(0);
}

TEST(ModalModel, OfTheDampedArmHasTheDampedPoles) {
  // A model of all modes is the whole of the arm. Omega and s are rounded to double; great
  // friction, of rank one, hides the rest of the matrix behind it.
  constexpr double kRoundingOfTen = 1e-14;
  for (const double friction : {0.0, 1e-3, 0.3, 3.0, 40.0}) {
    const AssumedModesArm model(damped_arm(1e-3, friction), {Basis::legendre, 10});
    const double singular = kRoundingOfTen * (1.0 + friction);
    const auto modal = model.modal_model(9, {}, {});
    ASSERT_EQ(modal.modes.size(), 10U);
    for (std::size_t i = 0; i < 10; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        EXPECT_EQ(modal.damping_rad_per_s[10 * i + j], modal.damping_rad_per_s[10 * j + i]);
      }
    }
    for (const Complex& s : all_of(model.damped_poles(9))) {
      if (s == 0.0) continue;
      EXPECT_LE(singularity(modal, s), singular) << friction << ' ' << s;
      EXPECT_GT(singularity(modal, s * 1.1), 1e3 * singular) << friction << ' ' << s;
    }
  }
}

}  // namespace
}  // namespace flexarm::assumed_modes
