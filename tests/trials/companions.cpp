#include "tests/trials/companions.hpp"

#include <algorithm>

namespace flexarm::trials {

void MovedBase::step(double torque_N_m, double step_s) {
  // Mean speed w of the step: J 2 (w - w0)/h + c w + k (angle + h w/2) = torque.
  const double factor = 2.0 * of_.inertia_kg_m2 / step_s + of_.damping_N_m_s_per_rad +
                        0.5 * step_s * of_.stiffness_N_m_per_rad;
  const double mean = (2.0 * of_.inertia_kg_m2 / step_s * speed_rad_per_s_ -
                       of_.stiffness_N_m_per_rad * angle_rad_ + torque_N_m) /
                      factor;
  angle_rad_ += step_s * mean;
  speed_rad_per_s_ = 2.0 * mean - speed_rad_per_s_;
}

double MovedBase::motion(arm::SensorKind kind) const {
  if (kind == arm::SensorKind::hub_angle) return angle_rad_;
  return kind == arm::SensorKind::hub_velocity ? speed_rad_per_s_ : 0.0;
}

void SlippingPayload::step(double tip_m, double tip_speed_m_per_s, double step_s) {
  speed_m_per_s_ -= step_s * force_N_ / of_.mass_kg;
  place_m_ += step_s * speed_m_per_s_;
  const double stretch_m = place_m_ - tip_m - slipped_m_;
  const double held_N = of_.stiffness_N_per_m * stretch_m +
                        of_.damping_N_s_per_m * (speed_m_per_s_ - tip_speed_m_per_s);
  force_N_ = std::clamp(held_N, -of_.slip_N, of_.slip_N);
  // The spring stretches no further than the friction holds it.
  const double most_m = of_.slip_N / of_.stiffness_N_per_m;
  slipped_m_ += stretch_m - std::clamp(stretch_m, -most_m, most_m);
}

}  // namespace flexarm::trials
