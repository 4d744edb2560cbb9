#include "assumed_modes/pencil_zeros.hpp"

#include "assumed_modes/symmetric_pencil.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>

namespace flexarm::assumed_modes {

namespace {

/// Between the first zeros of a beam, and on none of them by accident.
constexpr Real kZeroShift = 37.3L;

/// The rows of `matrix` on the left null space (-root, I) of the hub's row (1, root).
Matrix rows_beside_hub(const Matrix& matrix, const Vector& hub) {
  const Eigen::Index n = hub.size() - 1;
  return matrix.bottomRows(n) - hub.tail(n) * matrix.row(0);
}

/// R_M before its columns are reduced, (n - 1) x n.
Matrix mass_rows(const AdmissibleFunctions& functions, const ScaledArm& arm, bool tip_is_held) {
  const Vector hub = functions.hub_rotation();
  const Vector tip = functions.displacement(1);
  const Vector tip_rotation = functions.rotation(1);
  const Vector arm_of_centre = arm.payload_offset * tip_rotation;
  const Vector centre = tip + arm_of_centre;
  Matrix mass = functions.displacement_products();
  if (arm.shear) mass += arm.shear->rotary_inertia * functions.rotation_products();
  mass += arm.payload_mass * centre * (tip_is_held ? arm_of_centre : centre).transpose() +
          arm.payload_own_inertia * tip_rotation * tip_rotation.transpose();
  for (std::size_t k = 0; k < arm.carried.size(); ++k) {
    const Vector row = functions.carried_displacement(k);
    mass += arm.carried[k].mass * row * row.transpose();
  }
  return rows_beside_hub(mass, hub);
}

/// Columns of `rows` on the right null space of b, b_0 != 0, which gives q_0 by the others.
Matrix without_first(const Matrix& rows, const Vector& output) {
  const Eigen::Index n = output.size() - 1;
  return rows.rightCols(n) - rows.col(0) * output.tail(n).transpose() / output(0);
}

/// Columns of `rows` on the right null space of b, b_0 = 0: q_0 itself, and the complement of b.
Matrix with_first(const Matrix& rows, const Vector& output) {
  const Eigen::Index n = output.size() - 1;
  const Vector flexible = output.tail(n);
  Matrix turned = rows.rightCols(n);
  turned.applyOnTheRight(Eigen::HouseholderQR<Matrix>(flexible).householderQ());
  Matrix columns(rows.rows(), n);
  columns << rows.col(0), turned.rightCols(n - 1);
  return columns;
}

/// The reduced problem: eigenvalues w of `matrix`, sigma^2 = shift - 1/w.
struct Reduced {
  Matrix matrix;
  Real shift = 0;
  int at_origin = 0;
};

Reduced reduced_problem(const AdmissibleFunctions& functions, const ScaledArm& arm,
                        const Vector& output, const Matrix& mass) {
  const Eigen::Index n = output.size() - 1;
  if (arm.weight == 0) {
    // R_K = (0, I): the strain energy, on the functions beside the rotation.
    if (output(0) != 0) return {without_first(mass, output)};
    // b . q = 0 turns the product of b with the rows into an equation for q_0.
    const Vector flexible = output.tail(n);
    const Vector output_of_rows = mass.rightCols(n).transpose() * flexible;
    return {
        mass.rightCols(n) - mass.col(0) * output_of_rows.transpose() / flexible.dot(mass.col(0)), 0,
        1};
  }
  SymmetricPencil pencil = equations_of(functions, arm);
  pencil.lumped.clear();
  const Matrix stiffness = rows_beside_hub(pencil.stiffness(), functions.hub_rotation());
  if (output(0) != 0) {
    return {Eigen::PartialPivLU<Matrix>(without_first(stiffness, output))
                .solve(without_first(mass, output))};
  }
  const Matrix moving = with_first(mass, output);
  return {Eigen::PartialPivLU<Matrix>(with_first(stiffness, output) + kZeroShift * moving)
              .solve(moving),
          kZeroShift};
}

}  // namespace

namespace {

PencilZeros solved(const Reduced& reduced) {
  const Eigen::EigenSolver<Matrix> solver(reduced.matrix, false);
  PencilZeros zeros;
  zeros.converged = solver.info() == Eigen::Success;
  const auto& eigenvalues = solver.eigenvalues();
  const auto order = reduced.matrix.rows();
  const Real rounding =
      static_cast<Real>(order) * std::numeric_limits<Real>::epsilon() * reduced.matrix.norm();
  int finite = 0;
  for (const std::complex<Real>& w : eigenvalues) {
    if (std::abs(w) <= rounding) continue;
    ++finite;
    if (w.imag() >= 0) zeros.sigma_squared.push_back(reduced.shift - Real{1} / w);
  }
  zeros.infinite = static_cast<int>(order) + 2 - reduced.at_origin - finite;
  return zeros;
}

}  // namespace

PencilZeros pencil_zeros(const AdmissibleFunctions& functions, const ScaledArm& arm,
                         const Vector& output, bool tip_is_held) {
  return solved(reduced_problem(functions, arm, output, mass_rows(functions, arm, tip_is_held)));
}

PencilZeros pencil_zeros(const DecayingPencil& pencil, Real shift) {
  // Columns on the right null space of b.
  const Eigen::HouseholderQR<Matrix> turn(pencil.output);
  const auto beside_output = [&turn](Matrix rows) {
    rows.applyOnTheRight(turn.householderQ());
    return Matrix(rows.rightCols(rows.cols() - 1));
  };
  Matrix stiffness = beside_output(pencil.stiffness);
  Matrix mass = beside_output(pencil.spread);

  // In coordinates in which lump k has its first k + 1 entries only, the heaviest first, nothing
  // that is spread drowns in what is lumped.
  auto lumped = pencil.lumped;
  for (DecayingLump& at : lumped) at.right = beside_output(at.right.transpose()).transpose();
  const auto weight = [](const DecayingLump& at) {
    return at.inertia * at.left.norm() * at.right.norm();
  };
  std::ranges::sort(lumped, std::ranges::greater(), weight);
  if (!lumped.empty()) {
    const Eigen::Index n = mass.rows();
    const auto count = static_cast<Eigen::Index>(lumped.size());
    Matrix left(n, count);
    Matrix right(n, count);
    for (Eigen::Index k = 0; k < count; ++k) {
      left.col(k) = lumped[static_cast<std::size_t>(k)].left;
      right.col(k) = lumped[static_cast<std::size_t>(k)].right;
    }
    const Eigen::HouseholderQR<Matrix> rows(left);
    const Eigen::HouseholderQR<Matrix> columns(right);
    for (Matrix* matrix : {&stiffness, &mass}) {
      matrix->applyOnTheLeft(rows.householderQ().adjoint());
      matrix->applyOnTheRight(columns.householderQ());
    }
    for (Eigen::Index k = 0; k < count; ++k) {
      const Eigen::Index filled = std::min(k + 1, n);
      mass.topLeftCorner(filled, filled) += lumped[static_cast<std::size_t>(k)].inertia *
                                            rows.matrixQR().col(k).head(filled) *
                                            columns.matrixQR().col(k).head(filled).transpose();
    }
  }
  return solved({Eigen::PartialPivLU<Matrix>(stiffness + shift * mass).solve(mass), shift});
}

}  // namespace flexarm::assumed_modes
