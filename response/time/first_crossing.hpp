#pragma once

#include <optional>
#include <span>

namespace flexarm::response {

/// The value of the power series at r.
double value(std::span<const double> series, double r);

/// The first r in [0, 1] where p(r) = sum series[k] r^k falls below zero, to rounding; empty where
/// it does not. Nothing is missed between two points: with M >= |p''| on [a, b], from p'' at its
/// middle and a bound of |p'''| on [0, 1],
///
///     p >= min(p(a), p(b)) - M (b - a)^2/8
///
/// clears an interval, |p'| > M (b - a)/2 at its middle leaves one root at most, and any other
/// interval is halved, earlier half first. Two crossings nearer than 2^-40 are one touch, which is
/// none. Empty, too, for coefficients whose sum is too large for a number.
std::optional<double> first_crossing(std::span<const double> series);

}  // namespace flexarm::response
