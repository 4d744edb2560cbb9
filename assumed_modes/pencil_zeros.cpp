#include "assumed_modes/pencil_zeros.hpp"

#include <Eigen/Eigenvalues>

#include <limits>

namespace flexarm::assumed_modes {

PencilZeros pencil_zeros(const MassMatrix& mass, const Vector& root_slope,
                         const OutputRow& output) {
  // Rows of M on the left null space (-root_slope, I) of the input, K on it being the identity:
  //     q + sigma^2 (rigid_column q_0 + rows q) = 0,   output.rigid q_0 + output.flexible . q = 0.
  const Vector rigid_column = mass.coupling - mass.rigid * root_slope;
  const Matrix rows = mass.flexible - root_slope * mass.coupling.transpose();
  Matrix reduced = rows;
  if (output.rigid != 0) {
    reduced -= rigid_column * output.flexible.transpose() / output.rigid;
  } else {
    // output.flexible . q = 0 turns the first equation into one for q_0.
    const Vector output_of_rows = rows.transpose() * output.flexible;
    reduced -= rigid_column * output_of_rows.transpose() / output.flexible.dot(rigid_column);
  }

  const Eigen::EigenSolver<Matrix> solver(reduced, false);
  PencilZeros zeros;
  zeros.converged = solver.info() == Eigen::Success;
  const auto& eigenvalues = solver.eigenvalues();
  const Real rounding =
      static_cast<Real>(reduced.rows()) * std::numeric_limits<Real>::epsilon() * reduced.norm();
  int finite = 0;
  for (const std::complex<Real>& w : eigenvalues) {
    if (std::abs(w) <= rounding) continue;
    ++finite;
    if (w.imag() >= 0) zeros.sigma_squared.push_back(Real{-1} / w);
  }
  const int at_origin = output.rigid != 0 ? 0 : 1;
  zeros.infinite = static_cast<int>(reduced.rows()) + 2 - at_origin - finite;
  return zeros;
}

}  // namespace flexarm::assumed_modes
