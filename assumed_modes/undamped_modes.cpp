#include "assumed_modes/undamped_modes.hpp"

namespace flexarm::assumed_modes {

namespace {

Vector prepended(Real first, const Vector& others) {
  Vector all(others.size() + 1);
  all << first, others;
  return all;
}

}  // namespace

RitzPairs undamped_modes(const SymmetricPencil& pencil, bool turns_freely) {
  if (!turns_freely) return ritz_pairs(pencil);
  const WithoutRotation flexible = without_rigid_mode(pencil);
  RitzPairs pairs = ritz_pairs(flexible.pencil);
  Real inertia = pencil.spread(0, 0);
  for (const Lumped& at : pencil.lumped) inertia += at.inertia * at.row(0) * at.row(0);
  Matrix vectors = Matrix::Zero(pencil.size(), pencil.size());
  vectors(0, 0) = 1;
  vectors.rightCols(pencil.size() - 1) = flexible.in_all_coordinates(pairs.vectors);
  pairs.vectors = std::move(vectors);
  pairs.eigenvalues = prepended(0, pairs.eigenvalues);
  pairs.stiffness = prepended(0, pairs.stiffness);
  pairs.mass = prepended(inertia, pairs.mass);
  return pairs;
}

RitzPairs hub_held_modes(const SymmetricPencil& pencil) {
  return ritz_pairs(with_hub_held(pencil).pencil);
}

Matrix ModalDamping::whole() const {
  Matrix sum = of_beam;
  sum.selfadjointView<Eigen::Lower>().rankUpdate(hub_rotation, hub_friction);
  return sum.selfadjointView<Eigen::Lower>();
}

ModalDamping modal_damping(const AdmissibleFunctions& functions, const ScaledArm& arm,
                           const RitzPairs& modes) {
  ModalDamping damping;
  damping.hub_friction = arm.hub_friction;
  damping.hub_rotation = modes.vectors.transpose() * functions.hub_rotation();
  const Eigen::Index n = modes.mass.size();
  damping.of_beam = Matrix::Zero(n, n);
  const bool bends_only = functions.bends().tail(n - 1).minCoeff() == 1;
  if (arm.kelvin_voigt > 0 && bends_only && arm.turns_freely()) {
    damping.of_beam.diagonal() = arm.kelvin_voigt * modes.stiffness;
  } else if (arm.kelvin_voigt > 0) {
    damping.of_beam = arm.kelvin_voigt * modes.vectors.transpose() *
                      functions.bends().asDiagonal() * modes.vectors;
    damping.is_diagonal = false;
  }
  if (arm.air_damping > 0) {
    damping.of_beam += arm.air_damping * modes.vectors.transpose() *
                       functions.displacement_products() * modes.vectors;
    damping.is_diagonal = false;
  }
  damping.of_beam = Matrix(damping.of_beam.selfadjointView<Eigen::Lower>());
  return damping;
}

}  // namespace flexarm::assumed_modes
