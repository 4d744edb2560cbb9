#pragma once

#include "exact_tf/numerator.hpp"

namespace flexarm::exact_tf {

/// One undamped mode: y(x; z) of exact_tf/numerator.hpp at a root of E, scaled to the modal mass
/// I_T of equation (24), put right, with phi'(0) > 0.
///
/// The modal mass of y in units of m l is M = N_hub d(z E)/dz = N_hub (lambda/4) dE/dlambda: with
/// a dot for d/dz, integrate y ydot'''' - ydot y'''' = y^2 by parts.
class ModeShape {
 public:
  /// `pole_lambda` is a root of E as `find_poles` gives it.
  ModeShape(const arm::LinearArm& arm, const InertiaRatios& ratios, Real pole_lambda);

  Real hub_slope() const { return hub_slope_; }   ///< phi'(0) [1]
  Real tip_displacement_m() const;                ///< phi(l)
  Real displacement_m(double position_m) const;   ///< phi(X)
  Real curvature_per_m(double position_m) const;  ///< phi''(X)

 private:
  /// phi for a value of y as the numerators give it.
  Real scaled_m(const Scaled<Real>& y) const;

  double length_m_;
  InertiaRatios ratios_;
  Real lambda_;
  Real amplitude_m_;  ///< phi = amplitude_m y exp(-lambda)
  Real hub_slope_;
};

}  // namespace flexarm::exact_tf
