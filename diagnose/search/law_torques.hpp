#pragma once

#include "arm/ports.hpp"
#include "diagnose/symptoms/hub_motion.hpp"
#include "diagnose/symptoms/hub_regression.hpp"

#include <vector>

namespace flexarm::diagnose {

/// Torque of a law [N m] at the measured motion of the hub, of each run at each sample; under a
/// zero-order hold midway to the next sample. `law` is smooth, or dry friction.
///
/// States of a law, which must move with the hub's angle alone (arm::SmoothHubTorque::after_turn),
/// begin at 0 and follow the motion, which is linear between samples, exactly. Below `kNoiseOfRest`
/// standard deviations of its noise the velocity is then 0: noise alone would move the states.
HubTorques torques_of(const arm::HubLaw& law, const std::vector<HubMotion>& motions);

/// The hub is taken to rest below this velocity, in standard deviations of its noise.
inline constexpr double kNoiseOfRest = 2.0;

}  // namespace flexarm::diagnose
