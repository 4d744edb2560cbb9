#include "diagnose/search/law_torques.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <variant>

namespace flexarm::diagnose {

namespace {

std::vector<double> friction_torques(const arm::DryFriction& friction, const HubMotion& motion) {
  std::vector<double> made(motion.time_s.size());
  for (std::size_t k = 0; k < made.size(); ++k) {
    const double speed = std::abs(at_sample(motion, motion.velocity_rad_per_s, k));
    made[k] = -sign_at_sample(motion, k) * friction.size(speed).torque_N_m;
  }
  return made;
}

arm::HubState hub_at_sample(const HubMotion& motion, std::size_t k) {
  return {.angle_rad = at_sample(motion, motion.angle_rad, k),
          .velocity_rad_per_s = at_sample(motion, motion.velocity_rad_per_s, k),
          .torque_N_m = motion.torque_N_m[k],
          .time_s = at_sample(motion, motion.time_s, k) - motion.time_s.front()};
}

/// Of a smooth law without states.
std::vector<double> smooth_torques(const arm::SmoothHubTorque& smooth, const HubMotion& motion) {
  std::vector<double> made(motion.time_s.size());
  for (std::size_t k = 0; k < made.size(); ++k) {
    made[k] = smooth.law(hub_at_sample(motion, k), {}, {}).torque_N_m;
  }
  return made;
}

/// Angles that the hub turns forward and backward while its velocity goes in a straight line from
/// `from` to `to` [rad/s], at rest below `rest`; both 0 or more.
struct Turns {
  double forward_rad;
  double backward_rad;
};
Turns turns(double from, double to, double duration_s, double rest) {
  const auto above = [&](double least, double most) {
    if (!(most > rest)) return 0.0;
    const double lower = std::max(least, rest);
    const double part = most > least ? (most - lower) / (most - least) : 1.0;
    return 0.5 * (most + lower) * part * duration_s;
  };
  const auto [least, most] = std::minmax(from, to);
  return {above(least, most), above(-most, -least)};
}

/// Of a law whose states move with the hub's angle alone: exactly, along the motion that is linear
/// between samples.
std::vector<double> torques_after_turns(const arm::SmoothHubTorque& smooth,
                                        const HubMotion& motion) {
  const auto& velocity = motion.velocity_rad_per_s;
  const double rest = kNoiseOfRest * motion.velocity_noise_rad_per_s;
  std::vector<double> states(static_cast<std::size_t>(smooth.states), 0.0);
  std::vector<double> after(states.size());
  std::vector<double> rates(states.size());
  const auto turn = [&](double turn_rad) {
    if (turn_rad == 0.0) return;
    smooth.after_turn(turn_rad, states, after);
    states = after;
  };
  const auto move = [&](double from, double to, double duration_s) {
    const auto [forward, backward] = turns(from, to, duration_s, rest);
    const bool slows = from > to;
    turn(slows ? forward : -backward);
    turn(slows ? -backward : forward);
  };
  std::vector<double> made;
  arm::HubState before;
  for (std::size_t k = 0; k < motion.time_s.size(); ++k) {
    const arm::HubState now = hub_at_sample(motion, k);
    if (k > 0) {
      const double sample_s = motion.time_s[k] - motion.time_s.front();
      move(before.velocity_rad_per_s, velocity[k], sample_s - before.time_s);
      move(velocity[k], now.velocity_rad_per_s, now.time_s - sample_s);
    }
    made.push_back(smooth.law(now, states, rates).torque_N_m);
    before = now;
  }
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
    made.push_back(smooth.states > 0 ? torques_after_turns(smooth, motion)
                                     : smooth_torques(smooth, motion));
  }
  return made;
}

}  // namespace flexarm::diagnose
