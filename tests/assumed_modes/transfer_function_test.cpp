#include "arms.hpp"
#include "assumed_modes/assumed_modes_arm.hpp"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <stdexcept>

namespace flexarm::assumed_modes {
namespace {

using Complex = std::complex<double>;
using testing_arms::kDirectSolve;
using testing_arms::kHubAngle;
using testing_arms::kTipAcceleration;
using testing_arms::kTipDeflection;
using testing_arms::kTipDisplacement;

arm::Arm damped_arm() {
  arm::Arm arm = arm::paper_arm();
  arm.hub.viscous_friction_N_m_s_per_rad = 0.05;
  arm.payload = {0.05, 1e-4};
  arm.damping.kelvin_voigt_s = 2e-4;
  return arm;
}

TEST(TransferFunction, MatchesADirectSolveOfTheDampedEquations) {
  // Clamped shapes do not turn at the root: a = e_0, and the hub angle is the first coordinate.
  const arm::Arm arm = damped_arm();
  for (const Basis basis : {Basis::legendre, Basis::clamped_free, Basis::clamped_with_payload}) {
    const AssumedModesArm model(arm, {basis, 12});
    const Eigen::MatrixXcd mass = model.mass_matrix_kg_m2().cast<Complex>();
    const Eigen::MatrixXcd stiffness = model.stiffness_matrix_N_m().cast<Complex>();
    for (const Complex s : {Complex(0, 1), Complex(0, 60), Complex(-2, 300), Complex(40, 0)}) {
      Eigen::MatrixXcd dynamic = stiffness * (1.0 + arm.damping.kelvin_voigt_s * s) + s * s * mass;
      dynamic(0, 0) += arm.hub.viscous_friction_N_m_s_per_rad * s;
      const Eigen::VectorXcd torque = Eigen::VectorXcd::Unit(12, 0);
      const Complex theta = Eigen::PartialPivLU<Eigen::MatrixXcd>(dynamic).solve(torque)(0);
      EXPECT_LE(std::abs(model.transfer_function(kHubAngle, s) / theta - 1.0), kDirectSolve)
          << to_string(basis) << ' ' << s;
    }
  }
}

TEST(TransferFunction, AllBasesAgreeWithinTheirOwnConvergence) {
  const arm::Arm arm = damped_arm();
  const AssumedModesArm legendre(arm);
  const Complex s(0, 60);
  const Complex exact = legendre.transfer_function(kTipDisplacement, s);
  const auto error = [&](Basis basis) {
    const AssumedModesArm model(arm, {basis, 60});
    return std::abs(model.transfer_function(kTipDisplacement, s) / exact - 1.0);
  };
  EXPECT_LE(error(Basis::clamped_with_payload), 1e-9);
  EXPECT_LE(error(Basis::clamped_free), 1e-3);
  EXPECT_LE(error(Basis::pinned_free), 1e-2);
}

TEST(TransferFunction, RigidArmAtLowFrequency) {
  const arm::Arm arm = testing_arms::unit_arm(0.1, 0.5, 0.02);
  const AssumedModesArm model(arm);
  const double inertia = arm::total_inertia_kg_m2(arm);
  // The first flexible mode adds of the order of (s/omega_1)^2, omega_1 = 10.
  const Complex s(0, 1e-4);
  constexpr double kFlexible = 1e-8;
  const Complex rigid = 1.0 / (inertia * s * s);
  EXPECT_LE(std::abs(model.transfer_function(kHubAngle, s) / rigid - 1.0), kFlexible);
  EXPECT_LE(std::abs(model.transfer_function(kTipDisplacement, s) / rigid - 1.0), kFlexible);
  // Static deflection of a clamped beam under the inertia loads of an angular acceleration
  // 1/I_T: m x, Mp l at the tip and Ip: -(11/120 + Mp/3 + Ip/2) l^.../EI.
  const double deflection = -(11.0 / 120.0 + 0.5 / 3.0 + 0.02 / 2.0) / inertia;
  EXPECT_LE(std::abs(model.transfer_function(kTipDeflection, s) / deflection - 1.0), kFlexible);
  // Moment at the root: EI y''(0) = -(1/3 + Mp + Ip)/I_T; strain is thickness/2 of it.
  const double strain = -0.005 * (1.0 / 3.0 + 0.5 + 0.02) / inertia;
  EXPECT_LE(std::abs(model.transfer_function(testing_arms::strain_at(0.0), s) / strain - 1.0),
            kFlexible);
}

TEST(TransferFunction, IsTheModalSumWithoutDamping) {
  const arm::Arm arm = testing_arms::unit_arm(0.1, 0.5, 0.02);
  const AssumedModesArm model(arm);
  const double inertia = arm::total_inertia_kg_m2(arm);
  const Complex s(0.5, 30.0);
  Complex sum = 1.0 / (inertia * s * s);
  for (const arm::Mode& mode : model.modes(35, std::array{kTipDisplacement}, {})) {
    sum += mode.hub_slope * mode.sensor_values[0] /
           (inertia * (s * s + mode.omega_rad_per_s * mode.omega_rad_per_s));
  }
  EXPECT_LE(std::abs(model.transfer_function(kTipDisplacement, s) / sum - 1.0), 1e-13);
}

TEST(TransferFunction, AccelerationAndVelocityAreDerivatives) {
  const AssumedModesArm model(damped_arm());
  const Complex s(-1.0, 25.0);
  EXPECT_LE(std::abs(model.transfer_function(kTipAcceleration, s) /
                         (s * s * model.transfer_function(kTipDisplacement, s)) -
                     1.0),
            1e-15);
  EXPECT_LE(std::abs(model.transfer_function(testing_arms::kHubVelocity, s) /
                         (s * model.transfer_function(kHubAngle, s)) -
                     1.0),
            1e-15);
}

TEST(TransferFunction, RefusesTheOriginAndIsHugeAtAPole) {
  const AssumedModesArm model(testing_arms::unit_arm(0.1, 0.0, 0.0));
  EXPECT_THROW(model.transfer_function(kHubAngle, 0.0), std::domain_error);
  const double omega = model.poles(1).omega_rad_per_s[0];
  const double at_pole = std::abs(model.transfer_function(kHubAngle, {0.0, omega}));
  EXPECT_TRUE(!std::isfinite(at_pole) || at_pole > 1e10);
}

}  // namespace
}  // namespace flexarm::assumed_modes
