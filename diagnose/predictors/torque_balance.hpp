#pragma once

#include "arm/formulation.hpp"
#include "diagnose/measured_motion.hpp"
#include "measured/files/time_record.hpp"
#include "response/arm_parts.hpp"
#include "response/time/simulation.hpp"

#include <vector>

namespace flexarm::diagnose {

/// The balance of the hub's torque in a run, a value a sample: the mean over the interval behind
/// it.
struct BalancedRun {
  std::vector<double> angle_rad;           ///< of the hub, as smoothed
  std::vector<double> velocity_rad_per_s;  ///< likewise
  /// The recorded torque as it reaches the hub, friction that depends on it included.
  std::vector<double> transmitted_N_m;
  /// The torque that is missing for the motion, before the lag of the drive: behind it noise of the
  /// recorded torque would be less.
  std::vector<double> missing_N_m = {};
};

/// Returns the torque that an arm lacks for a measured motion: what its inertia, its beam and its
/// linear terms take (response::torque_for_motion) less the recorded torque and the laws of hub
/// torque, with the sign of a torque on the hub. Recorded torque and laws pass the filter that
/// smoothed the motion, as in inverse dynamics with parallel filtering [KhalilDombre2002]. Where
/// the hub turns no faster than its velocity is known, dry friction takes what it can.
///
/// `model` is of `parts.linear`. Throws InputError as torque_for_motion.
BalancedRun balance(const arm::ModalModel& model, const response::ArmParts& parts,
                    const measured::TimeRecord& record, response::TorqueHold hold,
                    const MeasuredMotion& motion);

}  // namespace flexarm::diagnose
