#pragma once

#include "exact_tf/scaled.hpp"

#include <functional>
#include <numbers>
#include <optional>

namespace flexarm::exact_tf {

/// An entire function N(z), z = lambda^4, real for real z, by its values in the closed sector
/// 0 <= arg lambda <= pi/4: the ray arg lambda = 0 is z > 0, the ray pi/4 is z < 0. A value may
/// lack a positive factor that is continuous in lambda.
using SectorFunction = std::function<Complex(const Complex& lambda)>;

inline constexpr Real kSectorAngle = std::numbers::pi_v<Real> / 4.0L;

/// modulus e^(i angle), on the rays themselves without rounding across them.
Complex on_ray(Real modulus, Real angle);

struct ContourOptions {
  /// Contours are first cut into pieces of |dlambda| <= this.
  Real piece = 1.0L;
  /// A piece is halved until for its ends a, b and its middle m
  /// |arg N(m)/N(a)| and |arg N(b)/N(m)| <= this [rad] and
  Real largest_argument_step = 0.8L;
  /// |N(m) - (N(a) + N(b))/2| <= this |N(m)|: a pair of zeros beside the contour turns the
  /// argument by almost a whole turn, which its steps alone do not show.
  Real largest_bend = 0.4L;
  int most_halvings = 40;
};

/// The region r1 <= |lambda| <= r2, a1 <= arg lambda <= a2 of the sector.
struct PolarBox {
  Real inner = 0.0L;
  Real outer = 0.0L;
  Real from_angle = 0.0L;
  Real to_angle = kSectorAngle;

  bool contains(const Complex& lambda) const;
};

/// Numbers of zeros from the change of arg N along contours, by samples that are refined until
/// their steps are small.
class ArgumentPrinciple {
 public:
  ArgumentPrinciple(const SectorFunction& function, const ContourOptions& options)
      : function_(function), options_(options) {}

  /// Zeros in z, with multiplicity, in the box and in its mirror image under conj(z). A side that
  /// lies on a ray of the sector (a real z) is inside of the region. `inner` = 0 stands for the
  /// whole disc and needs the whole sector. Empty where a contour runs too close to a zero.
  std::optional<int> count(const PolarBox& box);

  long function_values() const { return function_values_; }

 private:
  std::optional<Real> along_arc(Real modulus, Real from_angle, Real to_angle);
  std::optional<Real> along_ray(Real angle, Real from_modulus, Real to_modulus);
  std::optional<Real> along(const std::function<Complex(Real)>& path, Real length);
  Complex value(const Complex& lambda);

  const SectorFunction& function_;
  ContourOptions options_;
  long function_values_ = 0;
};

}  // namespace flexarm::exact_tf
