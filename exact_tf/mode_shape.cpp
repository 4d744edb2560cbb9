#include "exact_tf/mode_shape.hpp"

#include <cmath>

namespace flexarm::exact_tf {

namespace {

/// lambda dE/dlambda, scaled as `k`; from lambda K0' = -4 z K3, lambda Kk' = K(k-1) - k Kk.
Real pole_derivative(const InertiaRatios& ratios, const BeamProducts<Real>& k) {
  const Real eta = ratios.payload_mass;
  const Real mu = ratios.payload_inertia;
  const Real hub_angle = -2.0L * k.z * k.k3 - 2.0L * eta * k.z * (k.k2 + k.k3) -
                         mu * k.z * (k.k0 + 3.0L * k.k1) +
                         2.0L * eta * mu * k.z * k.z * (k.k3 + 4.0L * k.k4);
  const Real hub_moment = 2.0L * (k.k2 - 3.0L * k.k3) + 2.0L * eta * (k.k1 - 2.0L * k.k2) -
                          4.0L * mu * k.z * k.k3 - 2.0L * eta * mu * k.z * (k.k2 + k.k3);
  return ratios.hub_inertia * hub_angle + hub_moment;
}

/// N_hub at a root of E. There N_hub = -Y/epsilon, the accurate one of the two where the hub is
/// heavy and N_hub all but vanishes.
Real hub_angle_at_pole(const InertiaRatios& ratios, const BeamProducts<Real>& k, Real lambda) {
  const Real epsilon = ratios.hub_inertia;
  return epsilon * lambda * lambda * lambda > 1.0L ? -hub_moment_value(ratios, k) / epsilon
                                                   : hub_angle_value(ratios, k);
}

}  // namespace

ModeShape::ModeShape(const arm::LinearArm& arm, const InertiaRatios& ratios, Real pole_lambda)
    : length_m_(arm.length_m), ratios_(ratios), lambda_(pole_lambda) {
  const auto k = beam_products(lambda_);
  const Real hub_angle = hub_angle_at_pole(ratios, k, lambda_);
  const Real modal_mass = 0.25L * hub_angle * pole_derivative(ratios, k);
  const Real total_mass = 1.0L / 3.0L + ratios.hub_inertia + ratios.payload_mass +
                          ratios.payload_inertia;  // I_T/(m l^3)
  const Real l = length_m_;
  amplitude_m_ = std::copysign(l * std::sqrt(total_mass / modal_mass), hub_angle);
  hub_slope_ = amplitude_m_ * hub_angle / l;
}

Real ModeShape::scaled_m(const Scaled<Real>& y) const {
  // Every numerator has log_scale = lambda on the real axis.
  return amplitude_m_ * y.value;
}

Real ModeShape::tip_displacement_m() const {
  return scaled_m(tip_numerator(ratios_, lambda_));
}

Real ModeShape::displacement_m(double position_m) const {
  return scaled_m(
      displacement_numerator(ratios_, lambda_, distance_from_tip(length_m_, position_m)));
}

Real ModeShape::curvature_per_m(double position_m) const {
  const Real l = length_m_;
  const Real square = lambda_ * lambda_;
  return scaled_m(curvature_numerator(ratios_, lambda_, distance_from_tip(length_m_, position_m))) *
         (square * square) / (l * l);
}

}  // namespace flexarm::exact_tf
