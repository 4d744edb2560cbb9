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
  const std::function<ComplexBall(const ComplexBall&)>& value;
  const std::function<ComplexBall(const RealBall&)>& path;
  long& values_left;

  std::optional<RealBall> between(const RealBall& from, const ComplexBall& value_from,
                                  const RealBall& to, const ComplexBall& value_to,
                                  int halvings_left) const {
    const ComplexBall image = value(path(RealBall::hull(from, to)));
    if (!image.contains_zero()) {
      // The image is convex and excludes zero, so the change is less than half a turn.
      const ComplexBall ratio = value_to / value_from;
      if (ratio.real().sign() > 0) return arg(ratio);
    }
    values_left -= 2;
    if (halvings_left == 0 || values_left < 0) return std::nullopt;
    const RealBall middle = ((from + to) / RealBall(2)).midpoint();
    const ComplexBall value_middle = value(path(middle));
    const auto first = between(from, value_from, middle, value_middle, halvings_left - 1);
    if (!first) return std::nullopt;
    const auto second = between(middle, value_middle, to, value_to, halvings_left - 1);
    if (!second) return std::nullopt;
    return *first + *second;
  }
};

/// A simple zero needs some tens of them.
constexpr long kMostValuesOnSmallCircle = 10'000;

}  // namespace

std::optional<RealBall> enclose_sign_change(const std::function<RealBall(const RealBall&)>& value,
                                            const RealBall& start, double reach) {
  RealBall at = start.midpoint();
  const RealBall difference = (at * RealBall(kRelativeDifference)).midpoint();
  for (int step = 0; step < kNewtonSteps; ++step) {
    const RealBall here = value(at).midpoint();
    const RealBall slope = (value(at + difference) - here) / difference;
    at = (at - here / slope.midpoint()).midpoint();
    if (at.sign() <= 0) return std::nullopt;
    const RealBall low = at - RealBall(reach);
    const RealBall high = at + RealBall(reach);
    if (value(low).sign() * value(high).sign() < 0) return RealBall::hull(low, high);
  }
  return std::nullopt;
}

std::optional<ComplexBall> enclose_complex_zero(
    const std::function<ComplexBall(const ComplexBall&)>& value, const ComplexBall& start,
    double reach) {
  ComplexBall at = start.midpoint();
  const ComplexBall difference(abs(at * ComplexBall(RealBall(kRelativeDifference))).midpoint());
  const RealBall near(reach / 16.0);
  for (int step = 0; step < kNewtonSteps; ++step) {
    const ComplexBall here = value(at).midpoint();
    const ComplexBall slope = (value(at + difference) - here) / difference;
    const ComplexBall next = (at - here / slope.midpoint()).midpoint();
    const bool arrived = abs(next - at).is_below(near);
    at = next;
    if (!arrived) continue;
    const auto circle = [&](const RealBall& t) {
      return at + ComplexBall(RealBall(reach)) * ComplexBall::unit_at_half_turns(t + t);
    };
    long values_left = kMostValuesOnSmallCircle;
    const auto change = argument_change(value, circle, values_left);
    if (!change) return std::nullopt;
    const auto winding_number = (*change / (RealBall(2) * RealBall::pi())).unique_integer();
    if (winding_number != 1) return std::nullopt;
    const RealBall half_width = RealBall::hull(RealBall(-reach), RealBall(reach));
    return at + ComplexBall(half_width, half_width);
  }
  return std::nullopt;
}

std::optional<RealBall> argument_change(const std::function<ComplexBall(const ComplexBall&)>& value,
                                        const std::function<ComplexBall(const RealBall&)>& path,
                                        long& values_left) {
  const RealBall from(0);
  const RealBall to(1);
  return ArgumentChange{value, path, values_left}.between(from, value(path(from)), to,
                                                          value(path(to)), kMaxHalvings);
}

}  // namespace flexarm::exact_tf::ball
