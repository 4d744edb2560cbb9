#include "assumed_modes/beam_shapes.hpp"

#include "assumed_modes/beam_frequencies.hpp"

#include <cmath>
#include <utility>

namespace flexarm::assumed_modes {

namespace {

/// int_0^1 psi''^2 of a shape that is clamped or pinned at the root, from its values at the tip:
/// d/dxi [3 psi'' psi' + xi psi''^2 - 2 xi psi''' psi' - psi''' psi + xi lambda^4 psi^2]
///     = 4 psi''^2 for any solution of psi'''' = lambda^4 psi, and the bracket is 0 at the root.
Real strain_energy(const BeamShape& shape) {
  const Real psi = shape.value(1, 0);
  const Real slope = shape.value(1, 1);
  const Real curvature = shape.value(1, 2);
  const Real shear = shape.value(1, 3);
  const Real scaled = shape.lambda * shape.lambda * psi;
  return (3 * curvature * slope + curvature * curvature - 2 * shear * slope - shear * psi +
          scaled * scaled) /
         4;
}

BeamShape with_unit_strain_energy(BeamShape shape) {
  const Real factor = 1 / std::sqrt(strain_energy(shape));
  shape.cosine *= factor;
  shape.sine *= factor;
  shape.from_root *= factor;
  shape.from_tip *= factor;
  return shape;
}

BeamShape clamped_shape(Real lambda, Real payload_mass_ratio, Real payload_inertia_ratio) {
  const auto rows = tip_conditions(lambda, payload_mass_ratio, payload_inertia_ratio);
  const auto size = [](const std::array<Real, 2>& row) { return std::hypot(row[0], row[1]); };
  const auto& row = size(rows[0]) > size(rows[1]) ? rows[0] : rows[1];
  const Real from_root = row[1];
  const Real from_tip = -row[0];
  const Real decay = std::exp(-lambda);
  return {lambda, -from_root - decay * from_tip, from_root - decay * from_tip, from_root, from_tip};
}

BeamShape pinned_free_shape(Real lambda) {
  // psi(0) = psi''(0) = 0 leave sin and the exponential from the tip less its value at the root;
  // psi''(1) + psi'''(1)/lambda = 0 sets their ratio.
  const Real from_tip = (std::sin(lambda) + std::cos(lambda)) / 2;
  return {lambda, 0, 1, -std::exp(-lambda) * from_tip, from_tip};
}

}  // namespace

Real BeamShape::value(Real xi, int derivative) const {
  // d^n cos = cos(. + n pi/2) without its rounding.
  const Real c = std::cos(lambda * xi);
  const Real s = std::sin(lambda * xi);
  const std::array<Real, 4> cosines = {c, -s, -c, s};
  const auto turn = static_cast<std::size_t>(derivative) % 4;
  const Real alternating = derivative % 2 == 0 ? 1 : -1;
  return std::pow(lambda, static_cast<Real>(derivative)) *
         (cosine * cosines[turn] + sine * cosines[(turn + 3) % 4] +
          alternating * from_root * std::exp(-lambda * xi) +
          from_tip * std::exp(-lambda * (1 - xi)));
}

BeamShapes::BeamShapes(std::vector<BeamShape> shapes, Real payload_mass_ratio,
                       Real payload_inertia_ratio)
    : shapes_(std::move(shapes)),
      payload_mass_ratio_(payload_mass_ratio),
      payload_inertia_ratio_(payload_inertia_ratio) {
  for (BeamShape& shape : shapes_) shape = with_unit_strain_energy(shape);
}

BeamShapes BeamShapes::clamped(int count, Real payload_mass_ratio, Real payload_inertia_ratio) {
  std::vector<BeamShape> shapes;
  for (const Real lambda :
       clamped_payload_frequencies(count, payload_mass_ratio, payload_inertia_ratio)) {
    shapes.push_back(clamped_shape(lambda, payload_mass_ratio, payload_inertia_ratio));
  }
  return {std::move(shapes), payload_mass_ratio, payload_inertia_ratio};
}

BeamShapes BeamShapes::pinned_free(int count) {
  std::vector<BeamShape> shapes;
  for (const Real lambda : pinned_free_frequencies(count)) {
    shapes.push_back(pinned_free_shape(lambda));
  }
  return {std::move(shapes), 0, 0};
}

Integrals BeamShapes::integrals() const {
  Integrals result;
  const Vector tip = values(1, 0);
  const Vector tip_slope = values(1, 1);
  const Vector inverse_eigenvalue = Vector::NullaryExpr(
      static_cast<Eigen::Index>(shapes_.size()),
      [this](Eigen::Index i) { return std::pow(shapes_[static_cast<std::size_t>(i)].lambda, -4); });
  // The kinetic energy of the shapes' own problem is diagonal and its product with the rigid
  // rotation xi is psi''(0)/lambda^4 (integrate psi''''/lambda^4 by parts); the payload's share is
  // taken out of both.
  result.mass = -payload_mass_ratio_ * tip * tip.transpose() -
                payload_inertia_ratio_ * tip_slope * tip_slope.transpose();
  result.mass.diagonal() += inverse_eigenvalue;
  result.moment = inverse_eigenvalue.cwiseProduct(values(0, 2)) - payload_mass_ratio_ * tip -
                  payload_inertia_ratio_ * tip_slope;
  // psi'''' = lambda^4 psi, and psi'''(1) = -lambda^4 eta psi(1).
  result.mean = -inverse_eigenvalue.cwiseProduct(values(0, 3)) - payload_mass_ratio_ * tip;
  return result;
}

Vector BeamShapes::values(Real xi, int derivative) const {
  return Vector::NullaryExpr(static_cast<Eigen::Index>(shapes_.size()), [&](Eigen::Index i) {
    return shapes_[static_cast<std::size_t>(i)].value(xi, derivative);
  });
}

}  // namespace flexarm::assumed_modes
