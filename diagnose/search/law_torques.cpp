#include "diagnose/search/law_torques.hpp"

#include <boost/numeric/odeint.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <variant>

namespace flexarm::diagnose {

namespace {

namespace odeint = boost::numeric::odeint;
using LawStates = std::vector<double>;

std::vector<double> friction_torques(const arm::DryFriction& friction, const HubMotion& motion) {
  std::vector<double> made(motion.time_s.size());
  for (std::size_t k = 0; k < made.size(); ++k) {
    const double speed = std::abs(at_sample(motion, motion.velocity_rad_per_s, k));
    made[k] = -sign_at_sample(motion, k) * friction.size(speed).torque_N_m;
  }
  return made;
}

/// Of a smooth law without states.
std::vector<double> smooth_torques(const arm::SmoothHubTorque& smooth, const HubMotion& motion) {
  std::vector<double> made(motion.time_s.size());
  for (std::size_t k = 0; k < made.size(); ++k) {
    const arm::HubState hub{.angle_rad = at_sample(motion, motion.angle_rad, k),
                            .velocity_rad_per_s = at_sample(motion, motion.velocity_rad_per_s, k),
                            .torque_N_m = motion.torque_N_m[k],
                            .time_s = at_sample(motion, motion.time_s, k) - motion.time_s.front()};
    made[k] = smooth.law(hub, {}, {}).torque_N_m;
  }
  return made;
}

/// The motion between samples.
class ContinuousMotion {
 public:
  explicit ContinuousMotion(const HubMotion& motion)
      : motion_(motion), period_s_(motion.time_s[1] - motion.time_s[0]) {}

  double period_s() const { return period_s_; }
  arm::HubState at(double time_s) const {
    const std::size_t last = motion_.time_s.size() - 1;
    const auto k = std::min(static_cast<std::size_t>(std::max(0.0, time_s / period_s_)), last - 1);
    const double part = std::clamp(time_s / period_s_ - static_cast<double>(k), 0.0, 1.0);
    const auto between = [&](const std::vector<double>& values) {
      return std::lerp(values[k], values[k + 1], part);
    };
    const double velocity = between(motion_.velocity_rad_per_s);
    const bool rests = std::abs(velocity) < kNoiseOfRest * motion_.velocity_noise_rad_per_s;
    return {.angle_rad = between(motion_.angle_rad),
            .velocity_rad_per_s = rests ? 0.0 : velocity,
            .torque_N_m = motion_.torque_N_m[k],
            .time_s = time_s};
  }

 private:
  const HubMotion& motion_;
  double period_s_;
};

std::vector<double> torques_with_states(const arm::SmoothHubTorque& smooth,
                                        const HubMotion& motion) {
  constexpr double kStateError = 1e-5;  // of states of order 1; the motion is known to its noise
  if (motion.time_s.size() < 2) return std::vector<double>(motion.time_s.size(), 0.0);
  const ContinuousMotion continuous(motion);
  std::vector<double> instants_s(motion.time_s.size());
  for (std::size_t k = 0; k < instants_s.size(); ++k) {
    instants_s[k] = at_sample(motion, motion.time_s, k) - motion.time_s.front();
  }
  std::vector<double> made;
  LawStates rates(static_cast<std::size_t>(smooth.states));
  LawStates states(rates.size(), 0.0);
  odeint::integrate_times(
      odeint::make_controlled<odeint::runge_kutta_dopri5<LawStates>>(kStateError, kStateError),
      [&](const LawStates& now, LawStates& rate, double time_s) {
        smooth.law(continuous.at(time_s), now, rate);
      },
      states, instants_s.begin(), instants_s.end(), continuous.period_s(),
      [&](const LawStates& now, double time_s) {
        made.push_back(smooth.law(continuous.at(time_s), now, rates).torque_N_m);
      },
      odeint::max_step_checker(kMostLawSteps));
  return made;
}

}  // namespace

HubTorques torques_of(const arm::HubLaw& law, const std::vector<HubMotion>& motions) {
  HubTorques made;
  for (const HubMotion& motion : motions) {
    if (const auto* friction = std::get_if<arm::DryFriction>(&law)) {
      made.push_back(friction_torques(*friction, motion));
      continue;
    }
    const auto& smooth = std::get<arm::SmoothHubTorque>(law);
    made.push_back(smooth.states > 0 ? torques_with_states(smooth, motion)
                                     : smooth_torques(smooth, motion));
  }
  return made;
}

}  // namespace flexarm::diagnose
