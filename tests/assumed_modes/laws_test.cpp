#include "arms.hpp"
#include "assumed_modes/assumed_modes_arm.hpp"

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace flexarm::assumed_modes {
namespace {

using testing_arms::kRounding;

const std::vector<arm::Arm>& arms() {
  static const std::vector<arm::Arm> all = {
      testing_arms::unit_arm(0.0, 0.0, 0.0), testing_arms::unit_arm(0.004, 0.3, 0.0),
      testing_arms::unit_arm(0.1, 0.5, 0.02), testing_arms::unit_arm(100.0, 10.0, 0.1)};
  return all;
}

std::vector<double> hub_zeros(const AssumedModesArm& model, int count) {
  std::vector<double> omega;
  for (const auto& s : model.zeros(testing_arms::kHubAngle, count).s_rad_per_s) {
    EXPECT_EQ(s.real(), 0.0);
    omega.push_back(s.imag());
  }
  return omega;
}

TEST(Laws, MassIsSymmetricPositiveDefiniteAndOnlyTheRotationIsFree) {
  for (const arm::Arm& arm : arms()) {
    for (const Basis basis : kAllBases) {
      const AssumedModesArm model(arm, {basis, 30});
      const Eigen::MatrixXd mass = model.mass_matrix_kg_m2();
      EXPECT_EQ(mass, mass.transpose());
      EXPECT_EQ(Eigen::LLT<Eigen::MatrixXd>(mass).info(), Eigen::Success) << to_string(basis);
      EXPECT_NEAR(mass(0, 0), arm::total_inertia_kg_m2(arm), 1e-15 * mass(0, 0));
      const Eigen::MatrixXd stiffness = model.stiffness_matrix_N_m();
      EXPECT_EQ(stiffness.row(0).norm(), 0.0);
      EXPECT_GT(stiffness.diagonal().tail(29).minCoeff(), 0.0);
      EXPECT_EQ(model.poles(3).lowest_omega_squared_rad2_per_s2, 0.0);
      EXPECT_GT(model.poles(1).omega_rad_per_s[0], 0.1);
    }
  }
}

TEST(Laws, MatricesCarryTheUnitsOfTheArm) {
  arm::Arm arm = testing_arms::unit_arm(0.1, 0.5, 0.02);
  const AssumedModesArm unit(arm, {Basis::legendre, 8});
  constexpr double kLength = 0.5;
  constexpr double kDensity = 3.0;
  constexpr double kRigidity = 7.0;
  arm.beam = arm::Beam::from_rigidity(kLength, kRigidity, kDensity);
  const double inertia = kDensity * std::pow(kLength, 3);
  arm.hub.inertia_kg_m2 *= inertia;
  arm.payload.inertia_kg_m2 *= inertia;
  arm.payload.mass_kg *= kDensity * kLength;
  const AssumedModesArm scaled(arm, {Basis::legendre, 8});
  EXPECT_LE((scaled.mass_matrix_kg_m2() - inertia * unit.mass_matrix_kg_m2()).norm(), 1e-15);
  EXPECT_LE(
      (scaled.stiffness_matrix_N_m() - kRigidity / kLength * unit.stiffness_matrix_N_m()).norm(),
      1e-13);
  const double omega_scale = std::sqrt(kRigidity / kDensity) / (kLength * kLength);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(scaled.poles(5).omega_rad_per_s[i] / unit.poles(5).omega_rad_per_s[i] / omega_scale,
                1.0, kRounding);
  }
}

TEST(Laws, RitzValuesFallTowardsTheExactOnesAsFunctionsAreAdded) {
  for (const arm::Arm& arm : arms()) {
    const AssumedModesArm exact(arm, {Basis::legendre, 44});
    const auto exact_poles = exact.poles(5).omega_rad_per_s;
    const auto exact_zeros = hub_zeros(exact, 5);
    for (const Basis basis : kAllBases) {
      auto poles = AssumedModesArm(arm, {basis, 6}).poles(5).omega_rad_per_s;
      auto zeros = hub_zeros(AssumedModesArm(arm, {basis, 6}), 5);
      for (int functions = 7; functions <= 24; ++functions) {
        const AssumedModesArm model(arm, {basis, functions});
        const auto next_poles = model.poles(5).omega_rad_per_s;
        const auto next_zeros = hub_zeros(model, 5);
        for (std::size_t i = 0; i < 5; ++i) {
          EXPECT_LE(next_poles[i], poles[i] * (1.0 + kRounding)) << to_string(basis);
          EXPECT_GE(next_poles[i], exact_poles[i] * (1.0 - kRounding)) << to_string(basis);
          EXPECT_LE(next_zeros[i], zeros[i] * (1.0 + kRounding)) << to_string(basis);
          EXPECT_GE(next_zeros[i], exact_zeros[i] * (1.0 - kRounding)) << to_string(basis);
        }
        poles = next_poles;
        zeros = next_zeros;
      }
    }
  }
}

TEST(Laws, HubZerosAndPolesInterlace) {
  for (const arm::Arm& arm : arms()) {
    for (const Basis basis : kAllBases) {
      const AssumedModesArm model(arm, {basis, 20});
      const auto poles = model.poles(19).omega_rad_per_s;
      const auto zeros = hub_zeros(model, 19);
      for (std::size_t i = 0; i < 19; ++i) {
        // The heavy hub brings the two within rounding of each other.
        EXPECT_LE(zeros[i], poles[i] * (1.0 + kRounding)) << to_string(basis);
        if (i > 0) {
          EXPECT_GE(zeros[i], poles[i - 1] * (1.0 - kRounding)) << to_string(basis);
        }
      }
    }
  }
}

TEST(Laws, HubZerosDoNotKnowTheHubInertia) {
  for (const Basis basis : kAllBases) {
    const auto light =
        hub_zeros(AssumedModesArm(testing_arms::unit_arm(0.0, 0.5, 0.02), {basis}), 8);
    const auto heavy =
        hub_zeros(AssumedModesArm(testing_arms::unit_arm(100.0, 0.5, 0.02), {basis}), 8);
    EXPECT_EQ(light, heavy) << to_string(basis);
  }
}

TEST(Laws, TipZerosKnowNeitherHubInertiaNorPayloadMass) {
  const AssumedModesArm light(testing_arms::unit_arm(0.0, 0.0, 0.02));
  const AssumedModesArm heavy(testing_arms::unit_arm(100.0, 10.0, 0.02));
  EXPECT_EQ(light.zeros(testing_arms::kTipAcceleration, 6).s_rad_per_s,
            heavy.zeros(testing_arms::kTipAcceleration, 6).s_rad_per_s);
}

TEST(Laws, AHeavyPayloadPinsTheTipOfTheClampedBeam) {
  // 1/eta is the distance to the limit, tan lambda = tanh lambda.
  const auto zeros = hub_zeros(AssumedModesArm(testing_arms::unit_arm(0.0, 1e6, 0.0)), 4);
  for (std::size_t i = 1; i < 4; ++i) {
    const double lambda = std::sqrt(zeros[i]);
    EXPECT_NEAR(std::tan(lambda) / std::tanh(lambda), 1.0, 1e-4);
  }
}

TEST(Laws, LegendreFunctionsStayIndependent) {
  // Scaled mass matrix: the condition number grows as n^6 at worst, far from the 1e19 of the
  // arithmetic; monomials reach that with 14 functions.
  for (const arm::Arm& arm : arms()) {
    EXPECT_LE(AssumedModesArm(arm, {Basis::legendre, 60}).mass_condition_number(), 1e12);
  }
  EXPECT_LE(AssumedModesArm(arms()[0], {Basis::pinned_free, 60}).mass_condition_number(),
            1.0 + 1e-12);
}

}  // namespace
}  // namespace flexarm::assumed_modes
