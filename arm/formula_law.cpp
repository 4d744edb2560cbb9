#include "arm/formula_law.hpp"

#include "arm/input_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <utility>

namespace flexarm::arm {

namespace {

/// Slope at 0 by central differences over h, h/2, h/4 and h/8, of which Richardson's extrapolation
/// takes out h^2, h^4 and h^6; nothing where that is not certain, as beside higher powers alone.
std::optional<double> extrapolated_slope(const std::function<double(double)>& f, double h) {
  constexpr double kAgreement = 1e-6;     // of the last two extrapolations, relative
  constexpr double kHigherPowers = 1e-9;  // relative to the mean slope over the longest step
  std::array<double, 4> slopes;
  for (double& slope : slopes) {
    slope = (f(h) - f(-h)) / (2.0 * h);
    h *= 0.5;
  }
  const double coarse = slopes[0];
  double before = 0.0;
  double power = 4.0;
  for (std::size_t last = slopes.size() - 1; last > 0; --last) {
    before = slopes[last];
    for (std::size_t i = 0; i < last; ++i) {
      slopes[i] = slopes[i + 1] + (slopes[i + 1] - slopes[i]) / (power - 1.0);
    }
    power *= 4.0;
  }
  const double slope = slopes[0];
  const bool is_certain = std::abs(slope - before) <= kAgreement * std::abs(slope) &&
                          std::abs(slope) > kHigherPowers * std::abs(coarse);
  return is_certain ? std::optional(slope) : std::nullopt;
}

/// Slope at 0 of a function; 0 where it has a kink, or none beside rounding and higher powers.
double slope_at_zero(const std::function<double(double)>& f) {
  constexpr double kOfKink = 0x1p-20;
  constexpr double kKink = 1e-3;  // relative difference of the slopes of both sides
  const double middle = f(0.0);
  const double above = (f(kOfKink) - middle) / kOfKink;
  const double below = (middle - f(-kOfKink)) / kOfKink;
  const double larger = std::max(std::abs(above), std::abs(below));
  if (!(std::abs(above - below) <= kKink * larger)) return 0.0;
  for (const double step : {0x1p-6, 0x1p-10, 0x1p-14}) {
    if (const auto slope = extrapolated_slope(f, step)) return *slope;
  }
  return 0.0;
}

/// Places at which laws are compared: of either sign, from a thousandth to a hundred.
class ProbedStates {
 public:
  HubState next() { return {size(), size(), size(), std::abs(size())}; }

 private:
  double size() {
    constexpr double kDecades = 5.0;
    constexpr double kSmallest = 1e-3;
    const double place = static_cast<double>(random_() - std::minstd_rand::min()) /
                         static_cast<double>(std::minstd_rand::max() - std::minstd_rand::min());
    const double size = kSmallest * std::pow(10.0, kDecades * place);
    return random_() % 2 == 0 ? size : -size;
  }

  std::minstd_rand random_{7};
};

constexpr int kProbes = 24;
/// Of two ways to compute the same, relative to what is added up.
constexpr double kRounding = 1e-11;

}  // namespace

FormulaLaw::FormulaLaw(std::string effect, std::shared_ptr<const CompiledFormula> formula,
                       std::vector<double> numbers)
    : effect_(std::move(effect)), formula_(std::move(formula)), numbers_(std::move(numbers)) {
  if (formula_->has_direction() && !scale_of_friction()) constant_friction_N_m_ = friction(0.0);
  // A slope of the other sign would drive the motion; it stays in the rest.
  if (formula_->uses("theta")) {
    stiffness_N_m_per_rad_ = std::max(0.0, -slope_at_zero([this](double angle) {
                                        return directed({angle, 0, 0, 0});
                                      }));
  }
  if (formula_->uses("omega")) {
    damping_N_m_s_per_rad_ = std::max(0.0, -slope_at_zero([this](double speed) {
                                        return directed({0, speed, 0, 0});
                                      }));
  }
}

double FormulaLaw::value(const HubState& hub, double direction) const {
  return (*formula_)(hub, direction, numbers_);
}

/// F: half of the jump from one direction to the other, the mean of both speeds.
double FormulaLaw::friction(double speed_rad_per_s) const {
  if (constant_friction_N_m_) return *constant_friction_N_m_;
  double sum = 0.0;
  for (const double velocity : {speed_rad_per_s, -speed_rad_per_s}) {
    const HubState hub{.velocity_rad_per_s = velocity};
    sum += 0.25 * (value(hub, -1.0) - value(hub, 1.0));
  }
  return sum;
}

/// f + sign(omega) F(|omega|).
double FormulaLaw::directed(const HubState& hub) const {
  if (!formula_->has_direction()) return value(hub, 1.0);
  const double velocity = hub.velocity_rad_per_s;
  if (velocity == 0.0) return 0.5 * (value(hub, 1.0) + value(hub, -1.0));
  const double sign = std::copysign(1.0, velocity);
  return value(hub, sign) + sign * friction(std::abs(velocity));
}

double FormulaLaw::rest(const HubState& hub) const {
  return directed(hub) + stiffness_N_m_per_rad_ * hub.angle_rad +
         damping_N_m_s_per_rad_ * hub.velocity_rad_per_s;
}

SmoothHubTorque::Value FormulaLaw::rest_with_slope(const HubState& hub) const {
  constexpr double kStep = 1e-6;
  SmoothHubTorque::Value made{rest(hub), 0.0};
  if (!std::isfinite(made.torque_N_m)) {
    // Without the sign that a NaN may have.
    const double shown_N_m =
        std::isnan(made.torque_N_m) ? std::abs(made.torque_N_m) : made.torque_N_m;
    throw InputError(
        fmt::format("{}: {} at theta = {:g} rad, omega = {:g} rad/s, tau = {:g} N m, t = {:g} s; "
                    "must be finite",
                    key(), shown_N_m, hub.angle_rad, hub.velocity_rad_per_s, hub.torque_N_m,
                    hub.time_s),
        key());
  }
  if (!formula_->uses("omega")) return made;
  const double step = kStep * (1.0 + std::abs(hub.velocity_rad_per_s));
  HubState faster = hub;
  HubState slower = hub;
  faster.velocity_rad_per_s += step;
  slower.velocity_rad_per_s -= step;
  const double slope = (rest(faster) - rest(slower)) / (2.0 * step);
  // It speeds up the solution of a step, which does not depend on it.
  if (std::isfinite(slope)) made.per_velocity_N_m_s = slope;
  return made;
}

/// Whether k, c and F are all: of sums, quotients and powers, which vanish where they do so often.
bool FormulaLaw::has_no_rest() const {
  if (!formula_->is_algebraic()) return false;
  ProbedStates states;
  for (int i = 0; i < kProbes; ++i) {
    const HubState hub = states.next();
    const double size = stiffness_N_m_per_rad_ * std::abs(hub.angle_rad) +
                        damping_N_m_s_per_rad_ * std::abs(hub.velocity_rad_per_s) +
                        std::abs(directed(hub));
    if (!(std::abs(rest(hub)) <= kRounding * size)) return false;
  }
  return true;
}

/// The least speed at which F is another than at rest: by a tenth of it, or by most of what it ever
/// changes; nothing where it is the same at every speed.
std::optional<double> FormulaLaw::scale_of_friction() const {
  constexpr double kLeast = 1e-4;
  constexpr double kMost = 1e3;
  constexpr double kRatio = 1.25;
  constexpr double kPart = 0.1;
  constexpr double kMostOfChange = 0.63;
  const double at_rest = friction(0.0);
  double largest = 0.0;
  for (double speed = kLeast; speed < kMost; speed *= kRatio) {
    const double change = std::abs(friction(speed) - at_rest);
    if (!std::isfinite(change)) break;
    largest = std::max(largest, change);
  }
  if (largest <= kRounding * std::abs(at_rest)) return std::nullopt;
  const double enough = std::min(kPart * std::abs(at_rest), kMostOfChange * largest);
  double speed = kLeast;
  while (std::abs(friction(speed) - at_rest) < enough) speed *= kRatio;
  return speed;
}

DryFriction FormulaLaw::dry_friction() const {
  const DryFriction::Size at_rest{friction(0.0), 0.0};
  if (!(at_rest.torque_N_m >= 0.0)) {
    throw InputError(fmt::format("{}: dry friction of {:g} N m at omega = 0; must be 0 or more, "
                                 "against the motion: -F*sign(omega)",
                                 key(), at_rest.torque_N_m),
                     key());
  }
  const std::optional<double> scale = scale_of_friction();
  if (!scale) return {[at_rest](double /*speed*/) { return at_rest; }};
  // F is even, so that its slope at rest is 0.
  return {[law = *this, step = 1e-4 * *scale](double speed) {
            return DryFriction::Size{
                law.friction(speed),
                (law.friction(speed + step) - law.friction(speed - step)) / (2.0 * step)};
          },
          scale};
}

HubLaw FormulaLaw::beyond_slopes() const {
  const bool has_variable = std::ranges::any_of(
      formula_variables(), [this](const std::string& name) { return formula_->uses(name); });
  const bool has_friction = formula_->has_direction();
  if (!has_variable && !has_friction) return ConstantHubTorque{rest({})};
  if (has_no_rest()) return has_friction ? HubLaw(dry_friction()) : ConstantHubTorque{};
  SmoothHubTorque smooth{
      [law = *this](const HubState& hub, std::span<const double> /*z*/,
                    std::span<double> /*rates*/) { return law.rest_with_slope(hub); },
      0, formula_->uses("t")};
  if (!has_friction) return smooth;
  return HubTorqueWithFriction{std::move(smooth), dry_friction()};
}

void FormulaLaw::require_law() const {
  rest_with_slope({});
  beyond_slopes();
  const double friction_N_m = formula_->has_direction() ? friction(0.0) : 0.0;
  ProbedStates states;
  for (int i = 0; i < kProbes; ++i) {
    HubState hub = states.next();
    hub.velocity_rad_per_s = 0.0;
    // A place outside of a law's own domain, such as the root of an angle, says nothing.
    const double forward = value(hub, 1.0);
    const double backward = value(hub, -1.0);
    const double own_N_m = 0.5 * (backward - forward);
    const double size_N_m = std::abs(forward) + std::abs(backward) + std::abs(friction_N_m);
    if (std::abs(own_N_m - friction_N_m) > kRounding * size_N_m) {
      throw InputError(
          fmt::format("{}: dry friction, what stands at sign(omega), depends on theta, "
                      "tau or t; at omega = 0 it may depend on numbers alone",
                      key()),
          key());
    }
    if (jumps_beside_friction(hub, own_N_m)) {
      throw InputError(
          fmt::format("{}: jumps at omega = 0; dry friction is written with sign(omega)", key()),
          key());
    }
  }
}

/// What is left of the difference between both directions when the speed is a hundred thousandth:
/// all of a jump, of anything else next to nothing.
bool FormulaLaw::jumps_beside_friction(HubState hub, double friction_N_m) const {
  constexpr double kSlow = 1e-4;  // rad/s
  constexpr double kSlower = 1e-9;
  constexpr double kLeft = 0.1;
  double size_N_m = 0.0;
  const auto difference = [&](double speed) {
    hub.velocity_rad_per_s = speed;
    const double forward = value(hub, 1.0) + friction_N_m;
    hub.velocity_rad_per_s = -speed;
    const double backward = value(hub, -1.0) - friction_N_m;
    size_N_m = std::abs(forward) + std::abs(backward) + std::abs(friction_N_m);
    return std::abs(forward - backward);
  };
  const double at_slow = difference(kSlow);
  const double at_slower = difference(kSlower);
  return at_slower > kLeft * at_slow && at_slower > kRounding * size_N_m;
}

}  // namespace flexarm::arm
