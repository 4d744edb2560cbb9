#include "assumed_modes/symmetric_pencil.hpp"

#include <Eigen/Eigenvalues>

#include <utility>

namespace flexarm::assumed_modes {

namespace {

/// T^T A T with T = (-share^T; I).
Matrix reduced(const Matrix& whole, const Vector& share) {
  if (whole.size() == 0) return {};
  const Eigen::Index n = share.size();
  const Vector coupling = whole.col(0).tail(n);
  Matrix lower = whole.bottomRightCorner(n, n);
  lower.selfadjointView<Eigen::Lower>()
      .rankUpdate(coupling, share, Real{-1})
      .rankUpdate(share, whole(0, 0));
  return mirrored(lower);
}

}  // namespace

Matrix SymmetricPencil::stiffness() const {
  Matrix lower = gravity.size() > 0 ? gravity : Matrix::Zero(size(), size());
  lower.diagonal() += strain;
  for (const Lumped& at : lumped) {
    lower.selfadjointView<Eigen::Lower>().rankUpdate(at.row, at.stiffness);
  }
  return mirrored(lower);
}

Matrix SymmetricPencil::mass() const {
  Matrix lower = spread;
  for (const Lumped& at : lumped) {
    lower.selfadjointView<Eigen::Lower>().rankUpdate(at.row, at.inertia);
  }
  return mirrored(lower);
}

SymmetricPencil equations_of(const AdmissibleFunctions& functions, const ScaledArm& arm) {
  const Vector hub = functions.hub_rotation();
  const Vector tip = functions.displacement(1);
  const Vector tip_rotation = functions.rotation(1);

  SymmetricPencil pencil;
  pencil.strain = Vector::Ones(functions.size());
  pencil.strain(0) = 0;
  pencil.spread = functions.displacement_products();
  if (arm.shear) {
    pencil.spread += arm.shear->rotary_inertia * functions.rotation_products();
  }
  const Real motor_inertia = arm.drive ? arm.drive->rotor_inertia : arm.hub_inertia;
  pencil.lumped.push_back({functions.motor_rotation(), motor_inertia, arm.hub_spring});
  if (arm.drive) pencil.lumped.push_back({hub, arm.hub_inertia});
  if (arm.payload_mass > 0) {
    pencil.lumped.push_back({tip + arm.payload_offset * tip_rotation, arm.payload_mass});
  }
  if (arm.payload_own_inertia > 0) pencil.lumped.push_back({tip_rotation, arm.payload_own_inertia});
  for (std::size_t k = 0; k < arm.carried.size(); ++k) {
    pencil.lumped.push_back({functions.carried_displacement(k), arm.carried[k].mass});
  }
  if (arm.weight != 0) {
    pencil.gravity = functions.slope_products(arm) +
                     arm.tension(0) * arm.hub_radius * hub * hub.transpose() +
                     arm.weight * arm.payload_mass * arm.payload_offset * tip_rotation *
                         tip_rotation.transpose();
    for (std::size_t k = 0; k < arm.carried.size(); ++k) {
      if (!arm.carried[k].is_suspended()) continue;
      const Matrix half = arm.weight * arm.carried[k].mass * functions.extension(k) *
                          functions.rotation(arm.carried[k].position).transpose();
      pencil.gravity += half + half.transpose();
    }
  }
  return pencil;
}

Matrix WithoutRotation::in_all_coordinates(const Matrix& vectors) const {
  Matrix all(vectors.rows() + 1, vectors.cols());
  all.row(0) = -share.transpose() * vectors;
  all.bottomRows(vectors.rows()) = vectors;
  return all;
}

WithoutRotation without_rigid_mode(const SymmetricPencil& pencil) {
  const Eigen::Index n = pencil.size() - 1;
  const Real beam = pencil.spread(0, 0);
  const Vector coupling = pencil.spread.col(0).tail(n);
  Real total = beam;
  Vector momentum = coupling;
  for (const Lumped& at : pencil.lumped) {
    total += at.inertia * at.row(0) * at.row(0);
    momentum += at.inertia * at.row(0) * at.row.tail(n);
  }

  WithoutRotation result;
  result.share = momentum / total;
  result.pencil.strain = pencil.strain.tail(n);
  result.pencil.spread = reduced(pencil.spread, result.share);
  for (const Lumped& at : pencil.lumped) {
    Vector row = at.row.tail(n) * beam - at.row(0) * coupling;
    for (const Lumped& other : pencil.lumped) {
      if (&other == &at) continue;
      row += other.inertia * other.row(0) *
             (at.row.tail(n) * other.row(0) - at.row(0) * other.row.tail(n));
    }
    result.pencil.lumped.push_back({row / total, at.inertia, at.stiffness});
  }
  return result;
}

WithoutRotation with_hub_held(const SymmetricPencil& pencil) {
  const Eigen::Index n = pencil.size() - 1;
  WithoutRotation result;
  result.share = pencil.lumped.front().row.tail(n);
  result.pencil.strain = pencil.strain.tail(n);
  result.pencil.gravity = reduced(pencil.gravity, result.share);
  result.pencil.spread = reduced(pencil.spread, result.share);
  for (std::size_t k = 1; k < pencil.lumped.size(); ++k) {
    const Lumped& at = pencil.lumped[k];
    result.pencil.lumped.push_back(
        {at.row.tail(n) - at.row(0) * result.share, at.inertia, at.stiffness});
  }
  return result;
}

double scaled_condition_number(const Matrix& mass) {
  const Vector scale = mass.diagonal().cwiseSqrt().cwiseInverse();
  const Matrix scaled = scale.asDiagonal() * mass * scale.asDiagonal();
  const Vector eigenvalues =
      Eigen::SelfAdjointEigenSolver<Matrix>(scaled, Eigen::EigenvaluesOnly).eigenvalues();
  return static_cast<double>(eigenvalues.maxCoeff() / eigenvalues.minCoeff());
}

}  // namespace flexarm::assumed_modes
