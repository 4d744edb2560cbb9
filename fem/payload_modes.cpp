#include "fem/payload_modes.hpp"

#include <Eigen/Eigenvalues>

#include <cmath>

namespace flexarm::fem {

namespace {

/// Gram-Schmidt in the mass, each projection twice so that rounding is projected out as well.
void orthonormalise(const Eigen::SparseMatrix<double>& mass, Eigen::MatrixXd& x) {
  constexpr int kPasses = 2;
  for (Eigen::Index j = 0; j < x.cols(); ++j) {
    for (int pass = 0; pass < kPasses; ++pass) {
      const Eigen::VectorXd below = x.leftCols(j).transpose() * (mass * x.col(j));
      x.col(j) -= x.leftCols(j) * below;
      x.col(j) /= std::sqrt(x.col(j).dot(mass * x.col(j)));
    }
  }
}

}  // namespace

Eigen::MatrixXd payload_modes(const Discretisation& discretisation, const FlexibleSolve& solve) {
  constexpr double kBeamAlone = 1.0 / 12.362;  // 1/1.8751^4
  constexpr double kHeavy = 1e4 * kBeamAlone;
  constexpr int kSteps = 4;
  const Eigen::Index n = discretisation.size();
  if (discretisation.payload_mass() / 3.0 + discretisation.payload_inertia() <=
      kHeavy - kBeamAlone) {
    return Eigen::MatrixXd(n, 0);
  }
  const Eigen::SparseMatrix<double>& mass = discretisation.mass();
  Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(n, 2);
  loads(n - 2, 0) = 1.0;
  loads(n - 1, 1) = 1.0;
  Eigen::MatrixXd x(n, 2);
  Eigen::MatrixXd strains(discretisation.clamped_size(), 2);
  const Eigen::VectorXd root = solve.flexibility().natural_stiffness().cwiseSqrt();
  const auto respond = [&] {
    for (Eigen::Index j = 0; j < 2; ++j) {
      const Deformed response = solve(loads.col(j));
      x.col(j) = response.u;
      strains.col(j) = response.d.cwiseProduct(root);
    }
  };
  respond();
  Eigen::Vector2d flexibility;
  for (int step = 0; step < kSteps; ++step) {
    orthonormalise(mass, x);
    loads = mass * x;
    respond();
    // x^T M K^-1 M x in deformations; its eigenvalues, 1/omega^2, come in ascending order.
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> ritz(strains.transpose() * strains);
    const Eigen::Matrix2d descending = ritz.eigenvectors().rowwise().reverse();
    flexibility = ritz.eigenvalues().reverse();
    x = (x * descending).eval();
  }
  orthonormalise(mass, x);
  return x.leftCols((flexibility.array() > kHeavy).count());
}

}  // namespace flexarm::fem
