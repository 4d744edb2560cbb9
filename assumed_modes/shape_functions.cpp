#include "assumed_modes/shape_functions.hpp"

#include <boost/math/quadrature/gauss.hpp>

#include <stdexcept>

namespace flexarm::assumed_modes {

namespace {

BeamShapes shapes_of(Basis basis, const ScaledArm& arm, int count) {
  switch (basis) {
    case Basis::clamped_free:
      return BeamShapes::clamped(count, 0, 0);
    case Basis::pinned_free:
      return BeamShapes::pinned_free(count);
    case Basis::clamped_with_payload:
      return BeamShapes::clamped(count, arm.payload_mass, arm.payload_tip_inertia);
    case Basis::legendre:
      break;
  }
  throw std::logic_error("not a basis of beam shapes");
}

}  // namespace

ShapeFunctions::ShapeFunctions(Basis basis, const ScaledArm& arm, int shapes)
    : shapes_(shapes_of(basis, arm, shapes)),
      hub_radius_(arm.hub_radius),
      offset_(hub_radius_ * shapes_.values(0, 1)),
      bends_(Vector::Ones(shapes + 1)) {
  bends_(0) = 0;
}

Vector ShapeFunctions::with_rotation(Real rigid, const Vector& shapes) const {
  Vector all(size());
  all << rigid, shapes;
  return all;
}

Vector ShapeFunctions::displacement(Real xi) const {
  return with_rotation(hub_radius_ + xi, shapes_.values(xi, 0) + offset_);
}

Vector ShapeFunctions::rotation(Real xi) const {
  return with_rotation(1, shapes_.values(xi, 1));
}

Vector ShapeFunctions::curvature(Real xi) const {
  return with_rotation(0, shapes_.values(xi, 2));
}

Matrix ShapeFunctions::displacement_products() const {
  const Integrals integrals = shapes_.integrals();
  const Real a = hub_radius_;
  const Eigen::Index shapes = size() - 1;
  const Vector coupling = a * integrals.mean + integrals.moment + (a + Real{0.5L}) * offset_;
  Matrix products(size(), size());
  products(0, 0) = a * (a + 1) + Real{1} / 3;
  products.row(0).tail(shapes) = coupling.transpose();
  products.col(0).tail(shapes) = coupling;
  products.bottomRightCorner(shapes, shapes) = integrals.mass +
                                               offset_ * integrals.mean.transpose() +
                                               (integrals.mean + offset_) * offset_.transpose();
  return products;
}

Matrix ShapeFunctions::slope_products(const ScaledArm& arm) const {
  using Rule = boost::math::quadrature::gauss<Real, 20>;
  Matrix lower = Matrix::Zero(size(), size());
  const Real half = Real{0.5L} / static_cast<Real>(size());
  for (Eigen::Index panel = 0; panel < size(); ++panel) {
    const Real centre = static_cast<Real>(2 * panel + 1) * half;
    for (std::size_t i = 0; i < Rule::abscissa().size(); ++i) {
      for (const Real sign : {Real{-1}, Real{1}}) {
        const Real xi = centre + sign * half * Rule::abscissa()[i];
        const Real weight = half * Rule::weights()[i] * arm.tension(xi);
        lower.selfadjointView<Eigen::Lower>().rankUpdate(rotation(xi), weight);
      }
    }
  }
  return lower.selfadjointView<Eigen::Lower>();
}

}  // namespace flexarm::assumed_modes
