#include "exact_tf/argument_principle.hpp"

#include <algorithm>
#include <cmath>

namespace flexarm::exact_tf {

namespace {

/// A count is taken from a sum of angles over pi this close to an integer.
constexpr Real kIntegerTolerance = 0.01L;

Real turn(const Complex& from, const Complex& to) {
  return std::arg(to * std::conj(from));
}

}  // namespace

Complex on_ray(Real modulus, Real angle) {
  if (angle == 0.0L) return {modulus, 0.0L};
  if (angle == kSectorAngle) {
    const Real part = modulus / std::numbers::sqrt2_v<Real>;
    return {part, part};
  }
  return std::polar(modulus, angle);
}

bool PolarBox::contains(const Complex& lambda) const {
  const Real modulus = std::abs(lambda);
  const Real angle = std::arg(lambda);
  return inner <= modulus && modulus <= outer && from_angle <= angle && angle <= to_angle;
}

std::optional<int> ArgumentPrinciple::count(const PolarBox& box) {
  Real sum = 0.0L;
  const auto add = [&sum](std::optional<Real> change) {
    if (change) sum += *change;
    return change.has_value();
  };
  const bool complete =
      add(along_arc(box.outer, box.from_angle, box.to_angle)) &&
      (box.to_angle == kSectorAngle || add(along_ray(box.to_angle, box.outer, box.inner))) &&
      (box.inner == 0.0L || add(along_arc(box.inner, box.to_angle, box.from_angle))) &&
      (box.from_angle == 0.0L || add(along_ray(box.from_angle, box.inner, box.outer)));
  if (!complete) return std::nullopt;
  // Twice the change, for the mirror image, over 2 pi.
  const Real zeros = sum / std::numbers::pi_v<Real>;
  const Real integer = std::round(zeros);
  if (std::abs(zeros - integer) > kIntegerTolerance || integer < 0.0L) return std::nullopt;
  return static_cast<int>(integer);
}

std::optional<Real> ArgumentPrinciple::along_arc(Real modulus, Real from_angle, Real to_angle) {
  return along(
      [=](Real t) {
        // The ends are the angles themselves: those of the rays are treated exactly.
        const Real angle = t == 0.0L   ? from_angle
                           : t == 1.0L ? to_angle
                                       : from_angle + t * (to_angle - from_angle);
        return on_ray(modulus, angle);
      },
      modulus * std::abs(to_angle - from_angle));
}

std::optional<Real> ArgumentPrinciple::along_ray(Real angle, Real from_modulus, Real to_modulus) {
  return along(
      [=](Real t) { return on_ray(from_modulus + t * (to_modulus - from_modulus), angle); },
      std::abs(to_modulus - from_modulus));
}

std::optional<Real> ArgumentPrinciple::along(const std::function<Complex(Real)>& path,
                                             Real length) {
  const auto halve = [&](auto&& self, Real from, const Complex& value_from, Real to,
                         const Complex& value_to, int halvings_left) -> std::optional<Real> {
    const Real middle = 0.5L * (from + to);
    const Complex value_middle = value(path(middle));
    const Real first = turn(value_from, value_middle);
    const Real second = turn(value_middle, value_to);
    const Real bend = std::abs(value_middle - 0.5L * (value_from + value_to));
    if (std::max(std::abs(first), std::abs(second)) <= options_.largest_argument_step &&
        bend <= options_.largest_bend * std::abs(value_middle)) {
      return first + second;
    }
    if (halvings_left == 0) return std::nullopt;
    const auto left = self(self, from, value_from, middle, value_middle, halvings_left - 1);
    if (!left) return std::nullopt;
    const auto right = self(self, middle, value_middle, to, value_to, halvings_left - 1);
    if (!right) return std::nullopt;
    return *left + *right;
  };

  const auto pieces = std::max<long>(2, std::lround(std::ceil(length / options_.piece)));
  Real sum = 0.0L;
  Complex value_from = value(path(0.0L));
  for (long i = 0; i < pieces; ++i) {
    const Real from = static_cast<Real>(i) / static_cast<Real>(pieces);
    const Real to = static_cast<Real>(i + 1) / static_cast<Real>(pieces);
    const Complex value_to = value(path(to));
    const auto change = halve(halve, from, value_from, to, value_to, options_.most_halvings);
    if (!change) return std::nullopt;
    sum += *change;
    value_from = value_to;
  }
  return sum;
}

Complex ArgumentPrinciple::value(const Complex& lambda) {
  ++function_values_;
  return function_(lambda);
}

}  // namespace flexarm::exact_tf
