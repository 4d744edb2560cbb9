#include "assumed_modes/strain_functions.hpp"

#include "assumed_modes/legendre_series.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace flexarm::assumed_modes {

namespace {

Eigen::Index functions_on(Real length, const StrainFunctionCount& count) {
  constexpr int kToBeginWith = 14;
  const int first = std::min(count.on_whole_beam, kToBeginWith);
  const auto rest = static_cast<Real>(count.on_whole_beam - first);
  return first + static_cast<int>(std::ceil(rest * length)) + count.more;
}

/// Rows first, first + 1, ... of `series` become the polynomials that are orthonormal on the piece.
void set_orthonormal(Matrix& series, Eigen::Index first, Eigen::Index count, Real length) {
  for (Eigen::Index k = 0; k < count; ++k) {
    series(first + k, k) = std::sqrt(static_cast<Real>(2 * k + 1) / length);
  }
}

}  // namespace

StrainFunctions::StrainFunctions(const ScaledArm& arm, StrainFunctionCount count) {
  std::vector<Real> lengths;
  Real from = 0;
  const std::vector<Real> breaks = arm.breaks();
  for (const Real place : breaks) {
    lengths.push_back(place - from);
    from = place;
  }
  lengths.push_back(1 - from);
  Eigen::Index polynomials = 0;
  for (const Real length : lengths) polynomials += functions_on(length, count);

  const Eigen::Index drive = 1;
  const Eigen::Index root = drive + (arm.drive ? 1 : 0);
  const Eigen::Index crack = root + (arm.root_stiffness ? 1 : 0);
  Eigen::Index bending = crack + (arm.crack ? 1 : 0);
  for (const ScaledArm::Carried& mass : arm.carried) {
    carried_.push_back({mass.position});
    if (mass.is_suspended()) {
      carried_.back().function = bending++;
      carried_.back().extension = 1 / std::sqrt(mass.stiffness);
    }
  }
  Eigen::Index shearing = bending + polynomials;
  first_of_shear_ = shearing;
  const Eigen::Index size = shearing + (arm.shear ? polynomials : 0);
  bends_ = Vector::Zero(size);
  bends_.segment(bending, polynomials).setOnes();

  hub_rotation_ = Vector::Unit(size, 0);
  if (arm.drive) hub_rotation_(drive) = 1 / std::sqrt(arm.drive->stiffness);
  Vector displacement = arm.hub_radius * hub_rotation_;
  Vector rotation = hub_rotation_;
  if (arm.root_stiffness) rotation(root) = 1 / std::sqrt(*arm.root_stiffness);
  Real start = 0;
  for (const Real length : lengths) {
    if (arm.crack && start == arm.crack->position) {
      rotation(crack) = 1 / std::sqrt(arm.crack->stiffness);
    }
    const Eigen::Index here = functions_on(length, count);
    Piece piece{start, length, {}, {}, {}, Matrix::Zero(size, here + 2)};
    set_orthonormal(piece.curvature, bending, here, length);
    piece.rotation = integrated(piece.curvature, length);
    piece.rotation.col(0) += rotation;
    piece.slope = piece.rotation;
    if (arm.shear) {
      Matrix shear = Matrix::Zero(size, here + 2);
      set_orthonormal(shear, shearing, here, length);
      piece.slope += shear / std::sqrt(arm.shear->rigidity);
    }
    piece.displacement = integrated(piece.slope, length);
    piece.displacement.col(0) += displacement;

    displacement = at_end(piece.displacement);
    rotation = at_end(piece.rotation);
    bending += here;
    shearing += here;
    if (pieces_.size() < breaks.size()) start = breaks[pieces_.size()];
    pieces_.push_back(std::move(piece));
  }
}

const StrainFunctions::Piece& StrainFunctions::piece_at(Real xi) const {
  const auto beyond = std::ranges::upper_bound(pieces_, xi, {}, &Piece::start);
  return *std::prev(beyond);
}

namespace {

Real local(Real xi, Real start, Real length) {
  return 2 * (xi - start) / length - 1;
}

}  // namespace

Vector StrainFunctions::displacement(Real xi) const {
  const Piece& piece = piece_at(xi);
  return evaluated(piece.displacement, local(xi, piece.start, piece.length));
}

Vector StrainFunctions::rotation(Real xi) const {
  const Piece& piece = piece_at(xi);
  return evaluated(piece.rotation, local(xi, piece.start, piece.length));
}

Vector StrainFunctions::curvature(Real xi) const {
  const Piece& piece = piece_at(xi);
  return evaluated(piece.curvature, local(xi, piece.start, piece.length));
}

Matrix StrainFunctions::displacement_products() const {
  Matrix sum = Matrix::Zero(size(), size());
  for (const Piece& piece : pieces_) {
    sum += products(piece.displacement, piece.displacement, piece.length);
  }
  return mirrored(sum);
}

Matrix StrainFunctions::rotation_products() const {
  Matrix sum = Matrix::Zero(size(), size());
  for (const Piece& piece : pieces_) sum += products(piece.rotation, piece.rotation, piece.length);
  return mirrored(sum);
}

Matrix StrainFunctions::slope_products(const ScaledArm& arm) const {
  Matrix sum = Matrix::Zero(size(), size());
  for (const Piece& piece : pieces_) {
    const Real rise = -arm.weight * piece.length / 2;
    const Real middle = arm.tension(piece.start + piece.length / 2);
    sum += middle * products(piece.slope, piece.slope, piece.length) +
           rise * products(times_t(piece.slope), piece.slope, piece.length);
  }
  return mirrored(sum);
}

Vector StrainFunctions::extension(std::size_t k) const {
  const Carried& mass = carried_[k];
  if (mass.function < 0) return Vector::Zero(size());
  return mass.extension * Vector::Unit(size(), mass.function);
}

Vector StrainFunctions::carried_displacement(std::size_t k) const {
  return displacement(carried_[k].position) + extension(k);
}

}  // namespace flexarm::assumed_modes
