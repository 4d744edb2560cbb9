#include "tests/trials/hub_torques.hpp"

#include <cmath>

namespace flexarm::trials {

HubTorques::HubTorques(const TrueArm& arm, const RunConditions& run) {
  for (const MakeHubTorque& make : arm.hub_torques) torques_.push_back(make(run));
}

double HubTorques::mean_N_m(const HubStep& step) const {
  double sum = 0.0;
  for (const auto& torque : torques_) sum += torque->mean_N_m(step);
  return sum;
}

void HubTorques::made(const HubStep& step) {
  for (const auto& torque : torques_) {
    torque->turned(step.turn_rad);
    torque->made(step);
  }
}

double DryFriction::size_N_m(double speed_rad_per_s) const {
  double sum = 0.0;
  for (const FrictionSize& size : sizes_) sum += size(speed_rad_per_s);
  return sum;
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
