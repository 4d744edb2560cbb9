// Laws of the discrete formulations' matrices: M symmetric and definite, K symmetric, semidefinite
// and blind to a rigid rotation alone, and reciprocity of the responses that follow from them.
#include "assumed_modes/assumed_modes_arm.hpp"
#include "fem/fem_arm.hpp"
#include "laws/subjects.hpp"

#include <Eigen/Dense>
#include <boost/math/quadrature/gauss.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <limits>
#include <string>
#include <vector>

namespace flexarm::laws {
namespace {

using Complex = std::complex<double>;

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

struct Matrices {
  std::string name;
  Eigen::MatrixXd mass;
  Eigen::MatrixXd stiffness;
};

std::vector<Matrices> matrices_of(const arm::Arm& arm) {
  std::vector<Matrices> all;
  for (const int degree : {3, 9}) {
    fem::FemArm::Options options;
    options.mesh.elements = 5;
    options.degree = degree;
    const fem::FemArm model(arm, options);
    all.push_back(
        {"fem", Eigen::MatrixXd(model.mass_kg_m2()), Eigen::MatrixXd(model.stiffness_N_m())});
  }
  for (const auto basis : assumed_modes::kAllBases) {
    assumed_modes::AssumedModesOptions options;
    options.basis = basis;
    options.functions = 12;
    const assumed_modes::AssumedModesArm model(arm, options);
    all.push_back({"assumed_modes", model.mass_matrix_kg_m2(), model.stiffness_matrix_N_m()});
  }
  return all;
}

TEST(MatrixLaws, MassIsSymmetricAndPositiveDefinite) {
  for (const auto& arm : varied_arms()) {
    for (const auto& m : matrices_of(arm)) {
      const double scale = m.mass.cwiseAbs().maxCoeff();
      EXPECT_LE((m.mass - m.mass.transpose()).cwiseAbs().maxCoeff(), kEpsilon * scale) << m.name;
      EXPECT_EQ(m.mass.llt().info(), Eigen::Success) << m.name;
    }
  }
}

TEST(MatrixLaws, StiffnessIsSymmetricAndBlindToOneMotionOnly) {
  for (const auto& arm : varied_arms()) {
    for (const auto& m : matrices_of(arm)) {
      const double scale = m.stiffness.cwiseAbs().maxCoeff();
      EXPECT_LE((m.stiffness - m.stiffness.transpose()).cwiseAbs().maxCoeff(), kEpsilon * scale);
      // Scaled to a unit diagonal of M + K/omega_1^2, so that all coordinates count alike.
      const Eigen::VectorXd d =
          (m.mass / m.mass.trace() + m.stiffness / m.stiffness.trace()).diagonal().cwiseSqrt();
      const Eigen::MatrixXd scaled =
          d.cwiseInverse().asDiagonal() * m.stiffness * d.cwiseInverse().asDiagonal();
      const Eigen::VectorXd values =
          Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled, Eigen::EigenvaluesOnly)
              .eigenvalues();
      const double rounding = kEpsilon * static_cast<double>(scaled.rows()) * values.maxCoeff();
      EXPECT_LE(std::abs(values[0]), 10.0 * rounding) << m.name << ": a rigid rotation strains it";
      EXPECT_GT(values[1], 100.0 * rounding) << m.name << ": a second motion without strain";
    }
  }
}

TEST(MatrixLaws, ARigidRotationCarriesTheTotalInertia) {
  for (const auto& arm : varied_arms()) {
    for (const auto& m : matrices_of(arm)) {
      // The null vector of K, scaled so that the first coordinate, the hub's rotation, is 1.
      Eigen::FullPivLU<Eigen::MatrixXd> lu(m.stiffness);
      lu.setThreshold(1e-10);
      Eigen::VectorXd rigid = lu.kernel().col(0);
      rigid /= rigid[0];
      const double inertia = rigid.dot(m.mass * rigid);
      // A null vector from a stiffness of condition 1e6 or so.
      EXPECT_NEAR(inertia / arm::total_inertia_kg_m2(arm), 1.0, 1e-8) << m.name;
    }
  }
}

TEST(MatrixLaws, TorqueToStrainIsReciprocalToMomentToHubAngle) {
  // A pair of opposite moments on the ends of an element turns the hub by as much as the same
  // torque on the hub changes the slope between them: integral of y'' = 2/thickness strain.
  constexpr int kElements = 6;
  constexpr int kElement = 3;
  for (const auto& arm : varied_arms()) {
    fem::FemArm::Options options;
    options.mesh.elements = kElements;
    options.degree = 9;
    const fem::FemArm model(arm, options);
    const Complex s(2.0, 90.0);

    const Eigen::MatrixXcd dynamic = Eigen::MatrixXd(model.stiffness_N_m()).cast<Complex>() +
                                     s * s * Eigen::MatrixXd(model.mass_kg_m2()).cast<Complex>();
    Eigen::VectorXcd load = Eigen::VectorXcd::Zero(dynamic.rows());
    // Coordinates: theta, then for each element its bubbles, deflection and slope at the outer end.
    const auto slope_at_end_of = [&](int element) { return element * (options.degree - 1); };
    load[slope_at_end_of(kElement)] = 1.0;
    load[slope_at_end_of(kElement - 1)] = -1.0;
    const Complex angle_by_moment = dynamic.partialPivLu().solve(load)[0];

    const double h = arm.beam.length_m / kElements;
    Complex slope_by_torque = 0.0;
    using Gauss = boost::math::quadrature::gauss<double, 15>;
    for (std::size_t i = 0; i < Gauss::abscissa().size(); ++i) {
      for (const double side : {-1.0, 1.0}) {
        if (side > 0.0 && Gauss::abscissa()[i] == 0.0) continue;
        const double x = h * (kElement - 0.5 + 0.5 * side * Gauss::abscissa()[i]);
        slope_by_torque += 0.5 * h * Gauss::weights()[i] * (2.0 / *arm.beam.thickness_m) *
                           model.transfer_function({arm::SensorKind::strain, x}, s);
      }
    }
    // Rounding of a dense solve with the assembled stiffness, condition 1e6.
    EXPECT_LE(std::abs(angle_by_moment - slope_by_torque), 1e-9 * std::abs(slope_by_torque));
  }
}

}  // namespace
}  // namespace flexarm::laws
