#pragma once

#include "arm/hub_torque_table.hpp"
#include "diagnose/unknown/balanced_motion.hpp"

#include <vector>

namespace flexarm::diagnose {

/// Mean of the residual hub torque over an interval of the hub's angle or velocity.
struct TorqueMean {
  double at = 0.0;  ///< mean of the angles [rad] or velocities [rad/s]
  double torque_N_m = 0.0;
  double std_error_N_m = 0.0;  ///< by the effective sample size
};

/// Means beside the curves of a table, over `kIntervals` intervals of equally many samples. A table
/// over angle and velocity has a curve over the angle for each of its velocities, with the samples
/// that are nearest to that velocity; other tables have one curve.
std::vector<std::vector<TorqueMean>> torque_means(const arm::HubTorqueTable& table,
                                                  const BalancedMotion& motion);

}  // namespace flexarm::diagnose
