#include "exact_tf/ball_enclosure.hpp"

#include <cmath>

namespace flexarm::exact_tf::ball {

namespace {

constexpr int kNewtonSteps = 12;

/// Newton's slopes are differences over this part of the root: small beside the distance of
/// neighbouring roots, large beside the rounding at 128 bits.
const double kRelativeDifference = std::ldexp(1.0, -40);

/// Halvings of a path: a path that passes a zero at the spacing of doubles needs about 60.
constexpr int kMaxHalvings = 80;

struct ArgumentChange {
  const std::function<Complex(const Complex&)>& value;
  const std::function<Complex(const Real&)>& path;

  std::optional<Real> between(const Real& from, const Complex& value_from, const Real& to,
                              const Complex& value_to, int halvings_left) const {
    const Complex image = value(path(Real::hull(from, to)));
    if (!image.contains_zero()) {
      // The image is convex and excludes zero, so the change is less than half a turn.
      const Complex ratio = value_to / value_from;
      if (ratio.real().sign() > 0) return arg(ratio);
    }
    if (halvings_left == 0) return std::nullopt;
    const Real middle = ((from + to) / Real(2)).midpoint();
    const Complex value_middle = value(path(middle));
    const auto first = between(from, value_from, middle, value_middle, halvings_left - 1);
    if (!first) return std::nullopt;
    const auto second = between(middle, value_middle, to, value_to, halvings_left - 1);
    if (!second) return std::nullopt;
    return *first + *second;
  }
};

}  // namespace

std::optional<Real> enclose_sign_change(const std::function<Real(const Real&)>& value,
                                        const Real& start, double reach) {
  Real at = start.midpoint();
  const Real difference = (at * Real(kRelativeDifference)).midpoint();
  for (int step = 0; step < kNewtonSteps; ++step) {
    const Real here = value(at).midpoint();
    const Real slope = (value(at + difference) - here) / difference;
    at = (at - here / slope.midpoint()).midpoint();
    if (at.sign() <= 0) return std::nullopt;
    const Real low = at - Real(reach);
    const Real high = at + Real(reach);
    if (value(low).sign() * value(high).sign() < 0) return Real::hull(low, high);
  }
  return std::nullopt;
}

std::optional<Complex> enclose_complex_zero(const std::function<Complex(const Complex&)>& value,
                                            const Complex& start, double reach) {
  Complex at = start.midpoint();
  const Complex difference(abs(at * Complex(Real(kRelativeDifference))).midpoint());
  const Real near(reach / 16.0);
  for (int step = 0; step < kNewtonSteps; ++step) {
    const Complex here = value(at).midpoint();
    const Complex slope = (value(at + difference) - here) / difference;
    const Complex next = (at - here / slope.midpoint()).midpoint();
    const bool arrived = abs(next - at).is_below(near);
    at = next;
    if (!arrived) continue;
    const auto circle = [&](const Real& t) {
      return at + Complex(Real(reach)) * Complex::unit_at_half_turns(t + t);
    };
    const auto change = argument_change(value, circle);
    if (!change) return std::nullopt;
    const auto winding_number = (*change / (Real(2) * Real::pi())).unique_integer();
    if (winding_number != 1) return std::nullopt;
    const Real half_width = Real::hull(Real(-reach), Real(reach));
    return at + Complex(half_width, half_width);
  }
  return std::nullopt;
}

std::optional<Real> argument_change(const std::function<Complex(const Complex&)>& value,
                                    const std::function<Complex(const Real&)>& path) {
  const Real from(0);
  const Real to(1);
  return ArgumentChange{value, path}.between(from, value(path(from)), to, value(path(to)),
                                             kMaxHalvings);
}

}  // namespace flexarm::exact_tf::ball
