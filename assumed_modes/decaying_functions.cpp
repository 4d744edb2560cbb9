#include "assumed_modes/decaying_functions.hpp"

#include "assumed_modes/legendre_series.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

namespace flexarm::assumed_modes {

namespace {

/// `series` with zeros for the coefficients that it lacks.
Matrix widened(const Matrix& series, Eigen::Index columns) {
  Matrix wide = Matrix::Zero(series.rows(), columns);
  wide.leftCols(series.cols()) = series;
  return wide;
}

/// f - g, whichever has more columns.
Matrix difference(const Matrix& f, const Matrix& g) {
  const Eigen::Index columns = std::max(f.cols(), g.cols());
  return widened(f, columns) - widened(g, columns);
}

/// Functions of springs by their numbers, and what they are multiplied by.
struct Springs {
  Vector scale;                 ///< sqrt(k) at most 1; 0 where there is no spring
  Eigen::Index soft_root = -1;  ///< the root's function, where it is softer than the beam
};

Springs springs_of(const StrainFunctions& functions, const ScaledArm& arm) {
  Springs springs{Vector::Zero(functions.size())};
  const auto add = [&](Eigen::Index function, Real stiffness) {
    springs.scale(function) = std::min(Real{1}, std::sqrt(stiffness));
  };
  Eigen::Index next = 1;
  if (arm.root_stiffness) {
    if (*arm.root_stiffness < 1) springs.soft_root = next;
    add(next++, *arm.root_stiffness);
  }
  if (arm.crack) add(next++, arm.crack->stiffness);
  for (const ScaledArm::Carried& mass : arm.carried) {
    if (mass.is_suspended()) add(next++, mass.stiffness);
  }
  return springs;
}

/// What the function of the hub alone is multiplied by: 1 over the larger of what it does.
Real scale_of_hub_alone(const ScaledArm& arm) {
  return 1 / (*arm.root_stiffness + arm.hub_radius);
}

DecayingFunctions::Piece decaying(const StrainFunctions::Piece& from, Eigen::Index first_of_shear,
                                  const ScaledArm& arm, const Decay& decay,
                                  const Springs& springs) {
  const Vector scale =
      (springs.scale.array() > 0).select(springs.scale, Vector::Ones(springs.scale.size()));
  const Real half = from.length / 2;
  Matrix displacement = scale.asDiagonal() * from.displacement;
  Matrix derivative = scale.asDiagonal() * from.slope;
  const Real turn = decay.rate_at_root * arm.hub_radius;
  if (springs.soft_root > 0) {
    const Real hub_alone = scale_of_hub_alone(arm);
    displacement.row(0).setZero();
    derivative.row(0).setZero();
    displacement(0, 0) = hub_alone * (arm.hub_radius + turn * (from.start + half));
    displacement(0, 1) = hub_alone * turn * half;
    derivative(0, 0) = hub_alone * turn;
  } else {
    displacement(0, 0) += turn * (from.start + half);
    displacement(0, 1) += turn * half;
    derivative(0, 0) += turn;
  }

  const Real middle = decay.rate_at_root + decay.rise * (from.start + half);
  const auto times_rate = [&](const Matrix& series) {
    Matrix product = times_t(series) * (decay.rise * half);
    product.leftCols(series.cols()) += middle * series;
    return product;
  };
  DecayingFunctions::Piece piece{from.start, from.length, displacement, {}, {}, {}, {}};
  piece.slope = difference(derivative, times_rate(displacement));
  const Eigen::Index shearing = displacement.rows() - first_of_shear;
  piece.rotation = piece.slope;
  piece.rotation.bottomRows(shearing).setZero();
  const Matrix second =
      difference(from.curvature - decay.rise * displacement, times_rate(derivative));
  piece.curvature = difference(second, times_rate(piece.slope));
  piece.curvature.bottomRows(shearing).setZero();
  if (shearing > 0) {
    piece.shear = piece.slope;
    piece.shear.topRows(first_of_shear).setZero();
  }
  return piece;
}

/// The smaller |Re rho| of the roots of rho^4 - tension rho^2 + s^2 = 0.
Real decay_rate(Real tension, std::complex<Real> s) {
  if (s == Real{0}) return 0;
  const Real half = tension / 2;
  const std::complex<Real> root = std::sqrt((half - s) * (half + s));
  // The larger rho^2 is a sum without cancellation; their product is s^2.
  const auto sum = half + root;
  const auto difference = half - root;
  const auto larger = std::abs(sum) >= std::abs(difference) ? sum : difference;
  return std::min(std::sqrt(larger).real(), std::sqrt(s / larger * s).real());
}

constexpr int kPlaces = 32;

/// The middle of a part of the beam.
Real place(int k) {
  return (k + Real{0.5}) / kPlaces;
}

Matrix tension_products(const DecayingFunctions::Piece& test, const DecayingFunctions::Piece& trial,
                        const ScaledArm& arm) {
  const Real rise = -arm.weight * trial.length / 2;
  const Real middle = arm.tension(trial.start + trial.length / 2);
  return middle * products(test.slope, trial.slope, trial.length) +
         rise * products(times_t(test.slope), trial.slope, trial.length);
}

}  // namespace

Real mean_decay(const ScaledArm& arm, std::complex<Real> s) {
  Real sum = 0;
  for (int k = 0; k < kPlaces; ++k) sum += decay_rate(arm.tension(place(k)), s);
  return sum / kPlaces;
}

Decay decay_of(const ScaledArm& arm, Real mean_rate) {
  Real low = 0;
  Real high = 1;
  while (mean_decay(arm, high) < mean_rate) high *= 2;
  for (int step = 0; step < kPlaces; ++step) {
    const Real middle = (low + high) / 2;
    (mean_decay(arm, middle) < mean_rate ? low : high) = middle;
  }
  // Least squares of a line: the slope is the first moment over that of xi - 1/2, 1/12.
  Real moment = 0;
  for (int k = 0; k < kPlaces; ++k) {
    moment += (place(k) - Real{0.5}) * decay_rate(arm.tension(place(k)), high) / kPlaces;
  }
  const Real rise = 12 * moment;
  return {mean_decay(arm, high) - rise / 2, rise, high * high};
}

DecayingFunctions::DecayingFunctions(const StrainFunctions& functions, const ScaledArm& arm,
                                     const Decay& decay) {
  const Springs springs = springs_of(functions, arm);
  spring_scale_ = springs.scale;
  if (springs.soft_root > 0) hub_turn_at_root_ = -*arm.root_stiffness * scale_of_hub_alone(arm);
  for (const StrainFunctions::Piece& piece : functions.pieces()) {
    pieces_.push_back(decaying(piece, functions.first_of_shear(), arm, decay, springs));
  }
  for (std::size_t k = 0; k < arm.carried.size(); ++k) {
    extensions_.push_back(functions.extension(k).cwiseProduct(spring_scale_));
  }
}

Vector DecayingFunctions::extension(std::size_t k) const {
  return extensions_[k];
}

Matrix DecayingFunctions::spring_energy() const {
  Matrix energy = spring_scale_.cwiseAbs2().asDiagonal();
  if (hub_turn_at_root_ != 0) energy(1, 0) = hub_turn_at_root_;
  return energy;
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
                               const Decay& decay, std::optional<Real> strain_at) {
  const DecayingFunctions trial(functions, arm, decay);
  const DecayingFunctions test(functions, arm, decay.reversed());
  const Eigen::Index n = functions.size();
  DecayingPencil pencil;
  pencil.output = strain_at ? trial.curvature(*strain_at) : trial.displacement(1);
  Matrix stiffness = trial.spring_energy();
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
  if (strain_at || arm.payload_offset != 0) {
    add_lump(test.displacement(1) + arm.payload_offset * tip_rotation,
             strain_at ? Vector(trial.displacement(1) + arm_of_centre) : arm_of_centre,
             arm.payload_mass);
  }
  add_lump(tip_rotation, trial.rotation(1), arm.payload_own_inertia);
  stiffness += arm.weight * arm.payload_mass * arm.payload_offset * tip_rotation *
               trial.rotation(1).transpose();
  for (std::size_t k = 0; k < arm.carried.size(); ++k) {
    const Real place = arm.carried[k].position;
    const Vector extension = trial.extension(k);
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
