#pragma once

#include "arm/formulation.hpp"
#include "response/arm_parts.hpp"
#include "response/time/simulation.hpp"

#include <span>
#include <vector>

namespace flexarm::response {

/// A motion of the hub and the torque that it takes, a value a sample.
struct DrivenMotion {
  std::vector<double> angle_rad;
  std::vector<double> velocity_rad_per_s;
  std::vector<double> torque_N_m;
};

/// Returns the torque on the hub with which the linear arm of `parts` turns with these
/// accelerations, linear between samples: inverse dynamics, exact for the modes of `model`. The arm
/// begins undeformed, with this angle and velocity of the hub. Actuator, laws of hub torque and
/// sensors have no influence. Throws InputError for forces along the beam, which are not linear,
/// and for a model whose parts do not fit together.
DrivenMotion torque_for_motion(const arm::ModalModel& model, const ArmParts& parts,
                               double angle_rad, double velocity_rad_per_s,
                               std::span<const double> acceleration_rad_per_s2,
                               double sample_time_s);

/// Returns the mean of the torque that reaches the hub over the interval behind each sample: the
/// recorded torque behind delay, maps and lag of the actuator. Before the first sample it is 0, and
/// behind the last it stays as it is.
std::vector<double> transmitted_torque_N_m(const Actuator& actuator,
                                           std::span<const double> torque_N_m, double sample_time_s,
                                           TorqueHold hold);

}  // namespace flexarm::response
