#include "fem/slow_modes.hpp"

#include <Eigen/Eigenvalues>

#include <cmath>
#include <vector>

namespace flexarm::fem {

namespace {

constexpr double kBeamAlone = 1.0 / 12.362;  // 1/1.8751^4
constexpr double kSlow = 1e4 * kBeamAlone;

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

/// Coordinates on which the slow modes' loads act: the tip's two, those beyond the springs, and
/// suspended masses.
std::vector<Eigen::Index> loaded_coordinates(const Discretisation& model) {
  std::vector<Eigen::Index> loaded = {model.tip_deflection_index(), model.tip_rotation_index()};
  for (const int i : model.spring_rotations()) loaded.push_back(i + 1);
  for (const auto& mass : model.carried()) {
    if (mass.displacement >= 0) loaded.push_back(mass.displacement);
  }
  return loaded;
}

/// Upper bound of 1/omega_1^2 with the hub clamped, in excess of the beam alone.
double excess(const Discretisation& model) {
  // Inertia about the root, of which that about the crack is a part.
  double inertia = 1.0 / 3.0 + model.payload_mass() + 2.0 * model.payload_first_moment() +
                   model.payload_inertia();
  double sum =
      model.payload_mass() / 3.0 + std::abs(model.payload_first_moment()) + model.payload_inertia();
  for (const auto& mass : model.carried()) {
    inertia += mass.mass * mass.position * mass.position;
    sum += mass.mass * std::pow(mass.position, 3) / 3.0;
    if (mass.displacement >= 0) sum += mass.mass / mass.stiffness;
  }
  for (const int i : model.spring_rotations()) {
    // About the axis, what is beyond the drive is all but the rotor.
    const bool is_drive = i < model.hub_index();
    const double beyond = is_drive ? model.total_inertia() - model.mass().coeff(0, 0) : inertia;
    sum += beyond / model.natural_stiffness()[i];
  }
  return sum;
}

}  // namespace

Eigen::MatrixXd slow_modes(const Discretisation& discretisation, const FlexibleSolve& solve) {
  constexpr int kSteps = 4;
  const Eigen::Index n = discretisation.size();
  if (excess(discretisation) <= kSlow - kBeamAlone) return Eigen::MatrixXd(n, 0);
  const Eigen::SparseMatrix<double>& mass = discretisation.mass();
  const std::vector<Eigen::Index> loaded = loaded_coordinates(discretisation);
  auto count = static_cast<Eigen::Index>(loaded.size());
  Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(n, count);
  for (Eigen::Index j = 0; j < count; ++j) loads(loaded[static_cast<std::size_t>(j)], j) = 1.0;
  if (solve.shift() > 0.0) {
    loads.conservativeResize(Eigen::NoChange, ++count);
    loads.col(count - 1) = discretisation.rigid_momentum();
  }
  Eigen::MatrixXd x(n, count);
  const auto respond = [&] {
    for (Eigen::Index j = 0; j < count; ++j) x.col(j) = solve(loads.col(j)).u;
  };
  respond();
  Eigen::VectorXd flexibility;
  for (int step = 0; step < kSteps; ++step) {
    orthonormalise(mass, x);
    loads = mass * x;
    respond();
    // x^T M (K + shift M)^-1 M x; its eigenvalues come in ascending order.
    const Eigen::MatrixXd product = loads.transpose() * x;
    const Eigen::MatrixXd symmetric = (product + product.transpose()) / 2.0;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz(symmetric);
    flexibility = ritz.eigenvalues().reverse();
    x = (x * ritz.eigenvectors().rowwise().reverse()).eval();
  }
  orthonormalise(mass, x);
  return x.leftCols((flexibility.array() > kSlow).count());
}

}  // namespace flexarm::fem
