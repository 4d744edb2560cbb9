#include "fem/standing_arm.hpp"

#include "arm/input_error.hpp"
#include "fem/discretisation.hpp"

#include <Eigen/Eigenvalues>

namespace flexarm::fem {

namespace {

/// Buckling shapes are smooth: these elements give critical loads to ten digits.
Discretisation small_model(const arm::LinearArm& arm) {
  return Discretisation(arm, {.elements = 3}, 9);
}

/// Negative eigenvalues of a symmetric matrix, by Sylvester's law those of any scaling.
int negative_eigenvalues(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& sizes) {
  constexpr double kRounding = 1e-13;
  const Eigen::VectorXd scale = sizes.cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = scale.asDiagonal() * matrix * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scaled, Eigen::EigenvaluesOnly);
  return static_cast<int>((solver.eigenvalues().array() < -kRounding).count());
}

}  // namespace

void require_unbuckled(const arm::LinearArm& arm) {
  if (arm.gravity_m_per_s2 >= 0.0) return;
  const Discretisation model = small_model(arm);
  const Eigen::MatrixXd stiffness(model.stiffness());
  const Eigen::VectorXd elastic = stiffness.diagonal() -
                                  Eigen::MatrixXd(model.weight()).diagonal() +
                                  Eigen::VectorXd::Unit(model.size(), 0);
  if (negative_eigenvalues(stiffness, elastic) >= 2) {
    throw arm::out_of_range("effects.gravity.acceleration", arm.gravity_m_per_s2, "m/s^2",
                            "closer to 0: the inverted arm buckles");
  }
}

double shift_of_standing_arm(const arm::LinearArm& arm, int held, double shift) {
  const Discretisation model = small_model(arm);
  const int size = model.size() - held;
  const Eigen::MatrixXd stiffness =
      Eigen::MatrixXd(model.stiffness()).bottomRightCorner(size, size);
  const Eigen::MatrixXd mass = Eigen::MatrixXd(model.mass()).bottomRightCorner(size, size);
  const Eigen::VectorXd weight = Eigen::MatrixXd(model.weight()).diagonal().tail(size);
  const auto is_stable = [&] {
    const Eigen::MatrixXd shifted = stiffness + shift * mass;
    const Eigen::VectorXd sizes = shifted.diagonal() - weight;
    return negative_eigenvalues(shifted, sizes) == 0;
  };
  while (!is_stable()) shift *= 2.0;
  return 2.0 * shift;
}

}  // namespace flexarm::fem
