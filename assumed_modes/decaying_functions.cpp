#include "assumed_modes/decaying_functions.hpp"

#include "assumed_modes/legendre_series.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace flexarm::assumed_modes {

namespace {

DecayingFunctions::Piece decaying(const StrainFunctions::Piece& from, Eigen::Index first_of_shear,
                                  Real hub_radius, Real rate) {
  DecayingFunctions::Piece piece{from.start, from.length, from.displacement, {}, {}, {}, {}};
  Matrix derivative = from.slope;
  const Real turn = rate * hub_radius;
  piece.displacement(0, 0) += turn * (from.start + from.length / 2);
  piece.displacement(0, 1) += turn * from.length / 2;
  derivative(0, 0) += turn;

  piece.slope = derivative - rate * piece.displacement;
  const Eigen::Index shearing = from.displacement.rows() - first_of_shear;
  piece.rotation = piece.slope;
  piece.rotation.bottomRows(shearing).setZero();
  piece.curvature = from.curvature - 2 * rate * derivative + rate * rate * piece.displacement;
  piece.curvature.bottomRows(shearing).setZero();
  if (shearing > 0) {
    piece.shear = piece.slope;
    piece.shear.topRows(first_of_shear).setZero();
  }
  return piece;
}

Matrix tension_products(const DecayingFunctions::Piece& test, const DecayingFunctions::Piece& trial,
                        const ScaledArm& arm) {
  const Real rise = -arm.weight * trial.length / 2;
  const Real middle = arm.tension(trial.start + trial.length / 2);
  return middle * products(test.slope, trial.slope, trial.length) +
         rise * products(times_t(test.slope), trial.slope, trial.length);
}

}  // namespace

DecayingFunctions::DecayingFunctions(const StrainFunctions& functions, const ScaledArm& arm,
                                     Real rate) {
  for (const StrainFunctions::Piece& piece : functions.pieces()) {
    pieces_.push_back(decaying(piece, functions.first_of_shear(), arm.hub_radius, rate));
  }
}

const DecayingFunctions::Piece& DecayingFunctions::piece_at(Real xi) const {
  const auto beyond = std::ranges::upper_bound(pieces_, xi, {}, &Piece::start);
  return *std::prev(beyond);
}

namespace {

Real local_place(Real xi, const DecayingFunctions::Piece& piece) {
  return 2 * (xi - piece.start) / piece.length - 1;
}

}  // namespace

Vector DecayingFunctions::displacement(Real xi) const {
  const Piece& piece = piece_at(xi);
  return evaluated(piece.displacement, local_place(xi, piece));
}

Vector DecayingFunctions::rotation(Real xi) const {
  const Piece& piece = piece_at(xi);
  return evaluated(piece.rotation, local_place(xi, piece));
}

Vector DecayingFunctions::curvature(Real xi) const {
  const Piece& piece = piece_at(xi);
  return evaluated(piece.curvature, local_place(xi, piece));
}

DecayingPencil decaying_pencil(const StrainFunctions& functions, const ScaledArm& arm,
                               const DecayingFunctions& trial, Real rate, bool tip_is_held) {
  const DecayingFunctions test(functions, arm, -rate);
  const Eigen::Index n = functions.size();
  // Springs: each function that stands for one has the strain energy 1.
  Matrix stiffness = Matrix::Identity(n, n);
  stiffness.diagonal().array() *= 1 - functions.bends().array();
  stiffness(0, 0) = 0;
  const Eigen::Index shearing = n - functions.first_of_shear();
  stiffness.diagonal().tail(shearing).setZero();
  DecayingPencil pencil;
  Matrix mass = Matrix::Zero(n, n);
  for (std::size_t k = 0; k < trial.pieces().size(); ++k) {
    const DecayingFunctions::Piece& left = test.pieces()[k];
    const DecayingFunctions::Piece& right = trial.pieces()[k];
    const Real length = right.length;
    stiffness += products(left.curvature, right.curvature, length);
    mass += products(left.displacement, right.displacement, length);
    if (arm.shear) {
      stiffness += arm.shear->rigidity * products(left.shear, right.shear, length);
      mass += arm.shear->rotary_inertia * products(left.rotation, right.rotation, length);
    }
    if (arm.weight != 0) stiffness += tension_products(left, right, arm);
  }

  const auto add_lump = [&](const Vector& left, const Vector& right, Real inertia) {
    if (inertia > 0) pencil.lumped.push_back({left.tail(n - 1), right, inertia});
  };
  const Vector tip_rotation = test.rotation(1);
  const Vector arm_of_centre = arm.payload_offset * trial.rotation(1);
  add_lump(test.displacement(1) + arm.payload_offset * tip_rotation,
           tip_is_held ? arm_of_centre : Vector(trial.displacement(1) + arm_of_centre),
           tip_is_held && arm.payload_offset == 0 ? 0 : arm.payload_mass);
  add_lump(tip_rotation, trial.rotation(1), arm.payload_own_inertia);
  stiffness += arm.weight * arm.payload_mass * arm.payload_offset * tip_rotation *
               trial.rotation(1).transpose();
  for (std::size_t k = 0; k < arm.carried.size(); ++k) {
    const Real place = arm.carried[k].position;
    const Vector extension = functions.extension(k);
    add_lump(test.displacement(place) + extension, trial.displacement(place) + extension,
             arm.carried[k].mass);
    stiffness += arm.weight * arm.carried[k].mass *
                 (extension * trial.rotation(place).transpose() +
                  test.rotation(place) * extension.transpose());
  }
  pencil.stiffness = stiffness.bottomRows(n - 1);
  pencil.spread = mass.bottomRows(n - 1);
  return pencil;
}

}  // namespace flexarm::assumed_modes
