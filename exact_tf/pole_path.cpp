#include "exact_tf/pole_path.hpp"

#include <algorithm>
#include <cmath>

namespace flexarm::exact_tf {

namespace {

/// Of the central differences, in units of the radius. Their errors of relative order
/// kStep^2 = 1e-10 slow Newton's method down by no more than that.
constexpr Real kStep = 1e-5L;

bool finite(const Complex& z) {
  return std::isfinite(z.real()) && std::isfinite(z.imag());
}

}  // namespace

/// F and its derivatives with respect to u.
struct PolePath::Local {
  Complex newton_step;  ///< -F/F'
  Complex slope;        ///< F' over exp(log_scale)
  Real radius = 0.0L;   ///< |F'/F''|
  Real log_scale = 0.0L;
};

Complex PolePath::root_of_pair(const Complex& u, Real t) const {
  const Complex ratio = 0.5L * kelvin_voigt_s_ * damping_at(t) * u;
  const Complex q = std::sqrt((1.0L - ratio) * (1.0L + ratio));
  const Real along = (q * std::conj(last_q_)).real();
  // A step across 1 - (kv d u/2)^2 = 0 at real d and u: to either root of the pair by its branch.
  const bool turned = std::abs(along) < 0.5L * std::abs(q) * std::abs(last_q_);
  return (turned ? q.imag() > 0.0L : along < 0.0L) ? -q : q;
}

Complex PolePath::s_of(const Complex& u, Real t) const {
  const Complex half = 0.5L * kelvin_voigt_s_ * damping_at(t) * u * u;
  const Complex offset = static_cast<Real>(branch_) * Complex(0.0L, 1.0L) * u * root_of_pair(u, t);
  // The smaller of the two from their product u^2.
  return std::abs(offset - half) >= std::abs(offset + half) ? offset - half
                                                            : -u * u / (offset + half);
}

PolePath::Local PolePath::local(const Complex& u, Real t, Real radius) {
  const Real h = kStep * radius;
  const auto centre = value(u, t);
  const auto after = value(u + h, t);
  const auto before = value(u - h, t);
  const Complex f = centre.value;
  const Complex f_after = after.value * std::exp(after.log_scale - centre.log_scale);
  const Complex f_before = before.value * std::exp(before.log_scale - centre.log_scale);
  const Complex first = (f_after - f_before) / (2.0L * h);
  const Complex second = (f_after - 2.0L * f + f_before) / (h * h);
  return {-f / first, first, std::abs(first) / std::abs(second), centre.log_scale};
}

/// du/dt = -F_t/F_u along the path.
Complex PolePath::velocity(const FollowedRoot& root, Real t, Real step) {
  const Local here = local(root.u, t, root.radius);
  const Real h = kStep * step;
  const auto after = value(root.u, t + h);
  const auto before = value(root.u, t - h);
  const Complex change = after.value * std::exp(after.log_scale - here.log_scale) -
                         before.value * std::exp(before.log_scale - here.log_scale);
  return -change / (2.0L * h * here.slope);
}

std::optional<FollowedRoot> PolePath::newton(const Complex& from, Real t, Real radius) {
  constexpr int kMostSteps = 20;
  // On the way the root need not be better than the tangent.
  constexpr Real kOnTheWay = 1e-6L;
  FollowedRoot root{from, {}, radius, 0.0L};
  Real last = radius;
  for (int i = 0; i < kMostSteps; ++i) {
    const Local here = local(root.u, t, root.radius);
    if (!finite(here.newton_step)) return std::nullopt;
    const Real size = std::abs(here.newton_step);
    // Within the rounding of F a step no longer falls, and is not taken.
    const bool stalled = size >= 0.5L * last && size <= 1e-12L * std::abs(root.u);
    if (!stalled && (size > last || std::abs(root.u - from) > radius)) return std::nullopt;
    root.radius =
        std::min(std::isfinite(here.radius) ? here.radius : 2.0L * root.radius, 2.0L * root.radius);
    if (!stalled) root.u += here.newton_step;
    root.residual = size / std::abs(root.u);
    const bool near = t < 1.0L && size <= kOnTheWay * root.radius;
    if (stalled || near || size <= options_.newton_tolerance * std::abs(root.u)) {
      root.s = s_of(root.u, t);
      return root;
    }
    last = size;
  }
  return std::nullopt;
}

std::optional<FollowedRoot> PolePath::follow(const PathStart& start) {
  constexpr Real kSmallestStep = 1e-5L;
  constexpr Real kSmallestStepOfDetour = 1e-9L;
  const Real smallest = detour_ > 0.0L ? kSmallestStepOfDetour : kSmallestStep;
  branch_ = start.branch;
  last_q_ = 1.0L;
  FollowedRoot at{start.u, {}, start.radius, 0.0L};
  Complex velocity_now = start.slope * Complex(1.0L, detour_);
  Real t = 0.0L;
  Real step = 1.0L / caution_;
  Real move = options_.largest_move / caution_;
  while (t < 1.0L) {
    const Real speed = std::abs(velocity_now);
    const Real reach = move * at.radius;
    if (speed * step > reach) step = reach / speed;
    if (step < smallest || values_ > options_.most_function_values) return std::nullopt;
    const Real next = t + step >= 1.0L - 1e-3L * step ? 1.0L : t + step;
    const Complex predicted = at.u + velocity_now * (next - t);
    const auto root = newton(predicted, next, at.radius);
    const Real allowed =
        root ? options_.largest_correction / caution_ * std::min(at.radius, root->radius) : 0.0L;
    const Real correction = root ? std::abs(root->u - predicted) : 1.0L;
    if (correction > allowed) {
      step *= 0.5L;
      continue;
    }
    // The correction is of second order in the step. A straight path may be followed further: far
    // from all other roots F is an exponential, and rho much less than their distance.
    constexpr Real kAim = 0.3L;
    constexpr Real kMostRadii = 200.0L;
    const Real growth = std::min(4.0L, std::sqrt(kAim * allowed / correction));
    move = std::clamp(growth * move, options_.largest_move / caution_, kMostRadii / caution_);
    step *= growth;
    at = *root;
    t = next;
    last_q_ = root_of_pair(at.u, t);
    if (t < 1.0L) {
      velocity_now = velocity(at, t, step);
      if (!finite(velocity_now)) return std::nullopt;
    }
  }
  return at;
}

}  // namespace flexarm::exact_tf
