#include "assumed_modes/assumed_modes_arm.hpp"
#include "effects.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <vector>

namespace flexarm::assumed_modes {
namespace {

using Complex = std::complex<double>;
using testing_arms::kDirectSolve;
using testing_arms::kHubAngle;
using testing_arms::kRounding;
using testing_arms::kTipDeflection;
using testing_arms::kTipDisplacement;

arm::Arm damped(arm::Arm arm) {
  arm.damping.kelvin_voigt_s = 3e-4;
  arm.hub.viscous_friction_N_m_s_per_rad = 0.05;
  return testing_arms::with(arm, "air_damping", {{"coefficient", 0.2}});
}

TEST(EffectsResponse, MatchesADirectSolveOfTheEquations) {
  for (const auto& [name, arm] : testing_arms::arms_with_effects()) {
    const AssumedModesArm model(damped(arm), {Basis::legendre, 10});
    const Eigen::MatrixXcd mass = model.mass_matrix_kg_m2().cast<Complex>();
    const Eigen::MatrixXcd stiffness = model.stiffness_matrix_N_m().cast<Complex>();
    const Eigen::MatrixXcd damping = model.damping_matrix_N_m_s().cast<Complex>();
    for (const Complex s : {Complex(0, 1), Complex(0, 60), Complex(-2, 20), Complex(40, 0)}) {
      const Eigen::MatrixXcd dynamic = stiffness + s * damping + s * s * mass;
      const Eigen::VectorXcd torque = Eigen::VectorXcd::Unit(dynamic.rows(), 0);
      const Complex theta = Eigen::FullPivLU<Eigen::MatrixXcd>(dynamic).solve(torque)(0);
      EXPECT_LE(std::abs(model.transfer_function(kHubAngle, s) / theta - 1.0), kDirectSolve)
          << name << ' ' << s;
    }
  }
}

TEST(EffectsResponse, MatricesAreSymmetricAndDefinite) {
  for (const auto& [name, arm] : testing_arms::arms_with_effects()) {
    const AssumedModesArm model(damped(arm), {Basis::legendre, 10});
    const Eigen::MatrixXd mass = model.mass_matrix_kg_m2();
    const Eigen::MatrixXd stiffness = model.stiffness_matrix_N_m();
    const Eigen::MatrixXd damping = model.damping_matrix_N_m_s();
    EXPECT_EQ(mass.rows(), model.degrees_of_freedom());
    EXPECT_EQ(mass, mass.transpose()) << name;
    EXPECT_EQ(stiffness, stiffness.transpose()) << name;
    EXPECT_EQ(damping, damping.transpose()) << name;
    EXPECT_NEAR(mass(0, 0) / arm::total_inertia_kg_m2(arm), 1.0, kRounding) << name;
    EXPECT_EQ(Eigen::LLT<Eigen::MatrixXd>(mass).info(), Eigen::Success) << name;
    const Eigen::VectorXd rates =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(damping, Eigen::EigenvaluesOnly)
            .eigenvalues();
    EXPECT_GE(rates.minCoeff(), -1e-13 * rates.maxCoeff()) << name;
  }
}

TEST(EffectsResponse, IsTheSumOverItsModes) {
  for (const auto& [name, arm] : testing_arms::arms_with_effects()) {
    const arm::Arm undamped = testing_arms::without_damping(arm);
    const AssumedModesArm model(undamped);
    const auto modal =
        model.modal_model(model.degrees_of_freedom() - 1, std::array{kTipDisplacement}, {});
    const Complex s(0.5, 30.0);
    Complex sum = 0.0;
    for (std::size_t k = 0; k < modal.modes.size(); ++k) {
      const arm::Mode& mode = modal.modes[k];
      const double square = k == 0 ? modal.lowest_omega_squared_rad2_per_s2
                                   : mode.omega_rad_per_s * mode.omega_rad_per_s;
      sum += mode.hub_slope * mode.sensor_values[0] / (modal.modal_mass_kg_m2 * (s * s + square));
    }
    EXPECT_LE(std::abs(model.transfer_function(kTipDisplacement, s) / sum - 1.0), 1e-12) << name;
  }
}

TEST(EffectsResponse, TheModalModelGivesTheDampedResponse) {
  // All modes, in double.
  constexpr double kModal = 1e-10;
  for (const auto& [name, arm] : testing_arms::arms_with_effects()) {
    const AssumedModesArm model(damped(arm), {Basis::legendre, 14});
    const auto modal =
        model.modal_model(model.degrees_of_freedom() - 1, std::array{kTipDeflection}, {});
    const auto n = static_cast<Eigen::Index>(modal.modes.size());
    const Complex s(-0.5, 12.0);
    Eigen::MatrixXcd dynamic =
        s * Eigen::Map<const Eigen::MatrixXd>(modal.damping_rad_per_s.data(), n, n).cast<Complex>();
    Eigen::VectorXcd torque(n);
    Eigen::VectorXcd deflection(n);
    for (Eigen::Index k = 0; k < n; ++k) {
      const arm::Mode& mode = modal.modes[static_cast<std::size_t>(k)];
      dynamic(k, k) += s * s + (k == 0 ? modal.lowest_omega_squared_rad2_per_s2
                                       : mode.omega_rad_per_s * mode.omega_rad_per_s);
      torque(k) = mode.hub_slope / modal.modal_mass_kg_m2;
      deflection(k) = mode.sensor_values[0];
      EXPECT_GE(mode.hub_slope, 0.0);
      if (k > 0) {
        const double rate = modal.damping_rad_per_s[static_cast<std::size_t>(k * (n + 1))];
        EXPECT_NEAR(mode.damping_ratio, rate / (2 * mode.omega_rad_per_s),
                    kRounding * mode.damping_ratio);
      }
    }
    const Complex shown =
        (deflection.transpose() * Eigen::FullPivLU<Eigen::MatrixXcd>(dynamic).solve(torque))(0);
    EXPECT_LE(std::abs(model.transfer_function(kTipDeflection, s) / shown - 1.0), kModal) << name;
  }
}

TEST(EffectsResponse, DampedPolesMakeTheEquationsSingular) {
  // Matrices in double, each row and column in units of its own mass and stiffness.
  constexpr double kSingular = 1e-12;
  for (const auto& [name, arm] : testing_arms::arms_with_effects()) {
    const AssumedModesArm model(damped(arm), {Basis::legendre, 12});
    const Eigen::MatrixXcd mass = model.mass_matrix_kg_m2().cast<Complex>();
    const Eigen::MatrixXcd stiffness = model.stiffness_matrix_N_m().cast<Complex>();
    const Eigen::MatrixXcd damping = model.damping_matrix_N_m_s().cast<Complex>();
    const auto singularity = [&](Complex s) {
      const Eigen::MatrixXcd dynamic = stiffness + s * damping + s * s * mass;
      const Eigen::VectorXcd size =
          (stiffness.diagonal().cwiseAbs() + std::norm(s) * mass.diagonal().cwiseAbs())
              .cwiseSqrt()
              .cwiseInverse();
      const auto values =
          Eigen::JacobiSVD<Eigen::MatrixXcd>(size.asDiagonal() * dynamic * size.asDiagonal())
              .singularValues();
      return values(values.size() - 1) / values(0);
    };
    const auto poles = model.damped_poles(5);
    EXPECT_TRUE(poles.summary.converged) << name;
    ASSERT_EQ(poles.flexible.size(), 5U);
    std::vector<Complex> all = {poles.lowest.first_rad_per_s, poles.lowest.second_rad_per_s};
    for (const arm::PolePair& pair : poles.flexible) {
      all.push_back(pair.first_rad_per_s);
      all.push_back(pair.second_rad_per_s);
    }
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (all[i] != 0.0) {
        EXPECT_LE(singularity(all[i]), kSingular) << name << ' ' << all[i];
      }
      for (std::size_t j = 0; j < i; ++j) EXPECT_NE(all[i], all[j]) << name;
    }
    // Standing arms fall, slower for the damping.
    if (model.poles(1).lowest_omega_squared_rad2_per_s2 < 0.0) {
      EXPECT_GT(std::max(all[0].real(), all[1].real()), 0.0) << name;
    }
  }
}

TEST(EffectsResponse, ZerosAreWhereItVanishes) {
  constexpr double kVanishes = 1e-6;
  for (const auto& [name, arm] : testing_arms::arms_with_effects()) {
    const arm::Arm undamped = testing_arms::without_damping(arm);
    const AssumedModesArm model(undamped, {Basis::legendre, 40});
    for (const arm::Sensor& sensor :
         {kHubAngle, kTipDisplacement, kTipDeflection, testing_arms::strain_at(0.25),
          testing_arms::strain_at(0.6)}) {
      const auto zeros = model.zeros(sensor, 4);
      ASSERT_EQ(zeros.s_rad_per_s.size(), 4U) << name << ' ' << arm::to_string(sensor);
      double previous = 0.0;
      for (const Complex& s : zeros.s_rad_per_s) {
        EXPECT_GE(s.real(), 0.0);
        EXPECT_GE(s.imag(), 0.0);
        EXPECT_GT(std::abs(s), previous) << name;
        previous = std::abs(s);
        EXPECT_LE(std::abs(model.transfer_function(sensor, s)),
                  kVanishes * std::abs(model.transfer_function(sensor, 1.01 * s)))
            << name << ' ' << arm::to_string(sensor) << ' ' << s;
      }
    }
  }
}

TEST(EffectsResponse, AHeldArmHasAStaticOne) {
  arm::Arm arm = testing_arms::with(testing_arms::unit_arm(0.1, 0.5, 0.02), "hub_spring",
                                    {{"stiffness", 2.0}});
  const AssumedModesArm sprung(arm);
  EXPECT_NEAR(sprung.transfer_function(kHubAngle, 0.0).real(), 0.5, kRounding);
  EXPECT_NEAR(sprung.transfer_function(kTipDisplacement, 0.0).real(), 0.5, kRounding);
  EXPECT_NEAR(std::abs(sprung.transfer_function(kTipDeflection, 0.0)), 0.0, kRounding);
  EXPECT_EQ(sprung.transfer_function(testing_arms::kTipAcceleration, 0.0), 0.0);
  arm.effects.erase("hub_spring");
  EXPECT_THROW(AssumedModesArm(arm).transfer_function(kHubAngle, 0.0), std::domain_error);
  // A pendulum: g times the moment of the masses, for a beam that hardly bends under its weight.
  constexpr double kWeak = 1e-6;
  arm = testing_arms::with(arm, "gravity", {{"acceleration", kWeak}});
  EXPECT_NEAR(AssumedModesArm(arm).transfer_function(kHubAngle, 0.0).real() * kWeak, 1.0,
              10 * kWeak);
}

TEST(EffectsResponse, ShiftsTheDecouplingZeroUnderGravity) {
  // Torque against weak gravity: the tip lags behind the rigid arm at first by its inertia and by
  // its weight, s^2 (int m x G) + g (...) = 0 near the origin.
  double before = 0.0;
  for (const double g : {1e-6, 1e-4, 1e-2}) {
    const arm::Arm arm = testing_arms::with(testing_arms::unit_arm(0.1, 0.5, 0.02), "gravity",
                                            {{"acceleration", g}});
    const AssumedModesArm model(arm);
    const auto zero = model.zeros(kTipDeflection, 1).s_rad_per_s[0];
    // s^2 of the order of g, and the response there 1e-8 of the one at twice the frequency.
    EXPECT_LE(std::abs(zero), 2.0 * std::sqrt(g));
    EXPECT_GE(std::abs(zero), 0.5 * std::sqrt(g));
    EXPECT_GT(std::abs(zero), before);
    before = std::abs(zero);
    EXPECT_LE(std::abs(model.transfer_function(kTipDeflection, zero)),
              1e-8 * std::abs(model.transfer_function(kTipDeflection, 1.5 * zero)));
  }
}

}  // namespace
}  // namespace flexarm::assumed_modes
