#include "assumed_modes/undamped_modes.hpp"

#include <cmath>
#include <cstddef>
#include <utility>

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
  // As large as the lowest flexible mode.
  const Real mass = pairs.mass(0);
  Matrix vectors = Matrix::Zero(pencil.size(), pencil.size());
  vectors(0, 0) = std::sqrt(mass / inertia);
  vectors.rightCols(pencil.size() - 1) = flexible.in_all_coordinates(pairs.vectors);
  pairs.vectors = std::move(vectors);
  pairs.eigenvalues = prepended(0, pairs.eigenvalues);
  pairs.stiffness = prepended(0, pairs.stiffness);
  pairs.mass = prepended(mass, pairs.mass);
  return pairs;
}

RitzPairs hub_held_values(const SymmetricPencil& pencil) {
  return ritz_pairs(with_hub_held(pencil).pencil, Wanted::values);
}

ModalDamping modal_damping(const AdmissibleFunctions& functions, const ScaledArm& arm,
                           const RitzPairs& modes) {
  ModalDamping damping;
  damping.hub_friction = arm.hub_friction;
  damping.hub_rotation = modes.vectors.transpose() * functions.motor_rotation();
  const Eigen::Index n = modes.mass.size();
  const bool bends_only = functions.bends().tail(n - 1).minCoeff() == 1 && arm.turns_freely();
  Matrix lower = Matrix::Zero(n, n);
  if (bends_only) {
    lower.diagonal() = arm.kelvin_voigt * modes.stiffness;
  } else if (arm.kelvin_voigt > 0) {
    lower = arm.kelvin_voigt * modes.vectors.transpose() * functions.bends().asDiagonal() *
            modes.vectors;
  }
  if (arm.air_damping > 0) {
    lower += arm.air_damping * modes.vectors.transpose() * functions.displacement_products() *
             modes.vectors;
  }
  bool springs_lose = arm.root_retardation > 0;
  if (springs_lose) {
    const Vector turn = modes.vectors.transpose() * functions.root_turn();
    lower.selfadjointView<Eigen::Lower>().rankUpdate(
        turn, arm.root_retardation * arm.root_stiffness.value());
  }
  if (arm.drive && arm.drive->retardation > 0) {
    springs_lose = true;
    const Vector turn = modes.vectors.transpose() * functions.drive_turn();
    lower.selfadjointView<Eigen::Lower>().rankUpdate(turn,
                                                     arm.drive->retardation * arm.drive->stiffness);
  }
  for (std::size_t k = 0; k < arm.carried.size(); ++k) {
    if (arm.carried[k].damping == 0) continue;
    springs_lose = true;
    const Vector extension = modes.vectors.transpose() * functions.extension(k);
    lower.selfadjointView<Eigen::Lower>().rankUpdate(extension, arm.carried[k].damping);
  }
  if (arm.air_damping == 0 && !springs_lose && (bends_only || arm.kelvin_voigt == 0)) {
    damping.diagonal = lower.diagonal();
  }
  lower.selfadjointView<Eigen::Lower>().rankUpdate(damping.hub_rotation, damping.hub_friction);
  damping.whole = lower.selfadjointView<Eigen::Lower>();
  return damping;
}

}  // namespace flexarm::assumed_modes
