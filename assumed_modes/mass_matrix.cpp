#include "assumed_modes/mass_matrix.hpp"

#include <Eigen/Eigenvalues>

namespace flexarm::assumed_modes {

Matrix MassMatrix::without_rigid_mode() const {
  return flexible - coupling * coupling.transpose() / rigid;
}

Matrix MassMatrix::assembled() const {
  const Eigen::Index n = coupling.size() + 1;
  Matrix whole(n, n);
  whole(0, 0) = rigid;
  whole.row(0).tail(n - 1) = coupling.transpose();
  whole.col(0).tail(n - 1) = coupling;
  whole.bottomRightCorner(n - 1, n - 1) = flexible;
  return whole;
}

MassMatrix mass_matrix(const Integrals& integrals, const InertiaRatios& ratios) {
  const Vector& root = integrals.root_slope;
  const Vector& tip = integrals.tip;
  const Vector& slope = integrals.tip_slope;
  MassMatrix mass;
  mass.rigid = Real{1} / 3 + ratios.hub + ratios.payload_mass + ratios.payload_inertia;
  mass.coupling = integrals.moment + ratios.hub * root + ratios.payload_mass * tip +
                  ratios.payload_inertia * slope;
  // One triangle, mirrored: symmetric to the last bit.
  Matrix lower = integrals.mass;
  lower.selfadjointView<Eigen::Lower>()
      .rankUpdate(root, ratios.hub)
      .rankUpdate(tip, ratios.payload_mass)
      .rankUpdate(slope, ratios.payload_inertia);
  mass.flexible = lower.selfadjointView<Eigen::Lower>();
  return mass;
}

double scaled_condition_number(const MassMatrix& mass) {
  const Matrix whole = mass.assembled();
  const Vector scale = whole.diagonal().cwiseSqrt().cwiseInverse();
  const Matrix scaled = scale.asDiagonal() * whole * scale.asDiagonal();
  const Vector eigenvalues =
      Eigen::SelfAdjointEigenSolver<Matrix>(scaled, Eigen::EigenvaluesOnly).eigenvalues();
  return static_cast<double>(eigenvalues.maxCoeff() / eigenvalues.minCoeff());
}

}  // namespace flexarm::assumed_modes
