#include "tests/trials/hub_torques.hpp"

#include "tests/trials/random.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace flexarm::trials {

namespace {

/// Lines of the disturbance in its band: it repeats itself after far more than a run.
constexpr int kDisturbanceLines = 60;

}  // namespace

HubTorques::HubTorques(const World& world, double duration_s, std::uint64_t seed) {
  ripple_N_m_ = effect_value(world.arm, "torque_ripple", "amplitude", 0.0);
  cycles_ = effect_value(world.arm, "torque_ripple", "cycles", 0.0);
  phase_rad_ = effect_value(world.arm, "torque_ripple", "phase", 0.0);
  for (const auto& [name, of] : world.outside) {
    if (name == "hub_hardening_spring") hardening_N_m_per_rad3_ = of.at("coefficient");
    if (name == "hub_hysteresis") {
      hysteresis_N_m_ = of.at("torque");
      hysteresis_angle_rad_ = of.at("angle");
    }
    if (name == "disturbance_torque") {
      Random random(seed, "disturbance");
      const double amplitude = of.at("rms") * std::sqrt(2.0 / kDisturbanceLines);
      const double lowest_Hz = std::max(of.at("lowest"), 0.5 / duration_s);
      for (int i = 0; i < kDisturbanceLines; ++i) {
        const double frequency_Hz = random.uniform(lowest_Hz, of.at("highest"));
        disturbance_.push_back({amplitude, 2.0 * std::numbers::pi * frequency_Hz,
                                random.uniform(0.0, 2.0 * std::numbers::pi)});
      }
    }
  }
  none_ = ripple_N_m_ == 0.0 && hardening_N_m_per_rad3_ == 0.0 && hysteresis_N_m_ == 0.0 &&
          disturbance_.empty();
}

/// Dahl (1968): dF/dtheta = (torque - F sign(theta'))/angle, exactly.
double HubTorques::hysteresis_after(double turn_rad) const {
  const double last = std::copysign(hysteresis_N_m_, turn_rad);
  return last + (held_N_m_ - last) * std::exp(-std::abs(turn_rad) / hysteresis_angle_rad_);
}

double HubTorques::mean_N_m(double time_s, double angle_rad, double turn_rad) const {
  double torque = ripple_N_m_ * std::sin(cycles_ * angle_rad + phase_rad_) -
                  hardening_N_m_per_rad3_ * angle_rad * angle_rad * angle_rad;
  if (hysteresis_N_m_ != 0.0) torque -= 0.5 * (held_N_m_ + hysteresis_after(turn_rad));
  for (const Line& line : disturbance_) {
    torque += line.amplitude_N_m * std::sin(line.omega_rad_per_s * time_s + line.phase_rad);
  }
  return torque;
}

void HubTorques::turned(double turn_rad) {
  if (hysteresis_N_m_ != 0.0) held_N_m_ = hysteresis_after(turn_rad);
}

DryFriction::DryFriction(const arm::Arm& arm)
    : coulomb_N_m_(effect_value(arm, "coulomb_friction", "torque", 0.0)),
      torque_N_m_(effect_value(arm, "stribeck_friction", "torque", 0.0)),
      static_N_m_(effect_value(arm, "stribeck_friction", "static_torque", 0.0)),
      velocity_rad_per_s_(effect_value(arm, "stribeck_friction", "velocity", 1.0)) {}

double DryFriction::size_N_m(double speed_rad_per_s) const {
  const double ratio = speed_rad_per_s / velocity_rad_per_s_;
  return coulomb_N_m_ + torque_N_m_ + (static_N_m_ - torque_N_m_) * std::exp(-ratio * ratio);
}

double DryFriction::slipping_N_m(double sign, const FrictionStep& step) const {
  // The size at the mean speed, by fixed-point iteration: slope dF/dw is far below 1.
  constexpr int kIterations = 4;
  double end = step.start_rad_per_s;
  double size = 0.0;
  for (int i = 0; i < kIterations; ++i) {
    size = size_N_m(0.5 * (step.start_rad_per_s + end));
    end = step.free_end_rad_per_s - step.slope_rad_per_s_per_N_m * sign * size;
  }
  return sign * size;
}

double DryFriction::mean_N_m(const FrictionStep& step) const {
  const double start = step.start_rad_per_s;
  const double slope = step.slope_rad_per_s_per_N_m;
  const double most_at_rest = size_N_m(0.0);
  const double holding = (step.free_end_rad_per_s - start) / slope;
  const bool can_rest = std::abs(holding) <= most_at_rest;
  if (std::abs(start) < kRest_rad_per_s) {
    return can_rest ? holding : slipping_N_m(std::copysign(1.0, holding), step);
  }
  const double sign = std::copysign(1.0, start);
  const double slipping = slipping_N_m(sign, step);
  const double end = step.free_end_rad_per_s - slope * slipping;
  if (end * sign > 0.0) return slipping;
  if (can_rest) return step.free_end_rad_per_s / slope;
  // The hub turns around at this part of the step.
  const double part = start / (start - end);
  return most_at_rest * (part * sign + (1.0 - part) * std::copysign(1.0, holding));
}

}  // namespace flexarm::trials
