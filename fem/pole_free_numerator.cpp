#include "fem/pole_free_numerator.hpp"

#include "fem/hub_driven_response.hpp"
#include "fem/vibration_modes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace flexarm::fem {

using Complex = std::complex<double>;

PoleFreeNumerator::PoleFreeNumerator(const Discretisation& discretisation, SensorRow row, int poles,
                                     double tolerance)
    : model_(discretisation),
      row_(std::move(row)),
      poles_(vibration_modes(discretisation, HubSupport::clamped, poles, tolerance).omega_squared) {
}

PoleFreeNumerator::Value PoleFreeNumerator::operator()(Complex w) const {
  const HubDrivenResponse<Complex> response(model_, undamped_dynamics(model_, w));
  // Exactly at a pole of F; a neighbour serves as well.
  if (response.singular()) return (*this)(w * (1.0 + std::numeric_limits<double>::epsilon()));
  const Eigen::VectorXcd u = response.to_unit_rotation().u;
  const Eigen::VectorXcd du_dw = response.to_loads(-(model_.mass() * u)).u;
  Eigen::VectorXcd c = row_.constant().cast<Complex>();
  if (row_.times_w().size() > 0) c += w * row_.times_w();
  const Complex f = c.cwiseProduct(u).sum();
  if (f == 0.0) return {1.0, 0.0, true};
  Complex df_dw = c.cwiseProduct(du_dw).sum();
  if (row_.times_w().size() > 0) df_dw += row_.times_w().cast<Complex>().cwiseProduct(u).sum();
  Value value{f / std::abs(f), df_dw / f};
  for (const double pole : poles_) {
    const Complex factor = 1.0 + w / pole;
    value.direction *= factor / std::abs(factor);
    value.log_derivative += 1.0 / (w + pole);
  }
  return value;
}

NewtonResult PoleFreeNumerator::root_near(Complex w, std::span<const Complex> found,
                                          int steps_allowed) const {
  constexpr double kLast = 1e-9;
  constexpr double kSmall = 1e-7;
  NewtonResult root{w, false, 0, std::numeric_limits<double>::infinity()};
  while (root.steps < steps_allowed && !root.converged) {
    ++root.steps;
    const Value n = (*this)(root.w);
    if (n.zero) {
      root.converged = true;
      break;
    }
    Complex log_derivative = n.log_derivative;
    for (const Complex other : found) log_derivative -= 1.0 / (root.w - other);
    const Complex step = 1.0 / log_derivative;
    const double size = std::abs(step) / std::abs(root.w);
    if (!std::isfinite(size)) break;
    const bool stalled = size < kSmall && size >= root.last_step;
    if (!stalled) {
      root.w -= step;
      root.last_step = size;
    }
    root.converged = stalled || size <= kLast;
  }
  return root;
}

int PoleFreeNumerator::roots_inside(double radius) const {
  constexpr double kPi = std::numbers::pi;
  constexpr double kLongestArc = kPi / 8.0;
  constexpr double kShortestArc = kPi / 65536.0;
  constexpr double kTurnPerArc = 1.0;       // aimed at, in radians
  constexpr double kTurnUnforeseen = 0.25;  // allowed
  const bool all_poles = poles_.size() == model_.clamped_size();
  if (!all_poles && poles_[poles_.size() - 1] <= radius) return -1;
  // d arg N/d angle = Re(w N'/N). N(conj w) = conj N(w): half the circle turns half as often.
  const auto turn_rate = [](const Value& n, Complex w) { return (w * n.log_derivative).real(); };
  double angle = 0.0;
  double turned = 0.0;
  Complex w = radius;
  Value here = (*this)(w);
  double arc = std::min(kLongestArc, kTurnPerArc / std::abs(turn_rate(here, w)));
  while (angle < kPi) {
    const double next_angle = std::min(angle + arc, kPi);
    const Complex next_w = std::polar(radius, next_angle);
    const Value next = (*this)(next_w);
    if (here.zero || next.zero || !(arc >= kShortestArc)) return -1;
    const double foreseen =
        (next_angle - angle) * (turn_rate(here, w) + turn_rate(next, next_w)) / 2.0;
    const double unforeseen =
        std::arg(next.direction / here.direction * std::polar(1.0, -foreseen));
    if (!(std::abs(unforeseen) <= kTurnUnforeseen)) {
      arc /= 2.0;
      continue;
    }
    turned += foreseen + unforeseen;
    angle = next_angle;
    w = next_w;
    here = next;
    arc = std::min({kLongestArc, 2.0 * arc, kTurnPerArc / std::abs(turn_rate(here, w))});
  }
  return static_cast<int>(std::lround(turned / kPi));
}

}  // namespace flexarm::fem
