#include "response/time/torque_for_motion.hpp"

#include "arm/input_error.hpp"
#include "response/time/modal_dynamics.hpp"
#include "response/time/propagator.hpp"
#include "response/time/torque_path.hpp"

#include <cmath>
#include <cstddef>

namespace flexarm::response {

namespace {

/// Returns what acts on the linear arm alone, driven by the hub's acceleration.
ArmParts driven_linear_arm(const ArmParts& parts) {
  ArmParts made;
  made.linear = parts.linear;
  made.hub_is_driven = true;
  return made;
}

}  // namespace

DrivenMotion torque_for_motion(const arm::ModalModel& model, const ArmParts& parts,
                               double angle_rad, double velocity_rad_per_s,
                               std::span<const double> acceleration_rad_per_s2,
                               double sample_time_s) {
  if (!parts.beam_forces.empty()) {
    throw arm::InputError("torque of a motion: forces along the beam are not linear");
  }
  const ModalDynamics driven = modal_dynamics(model, driven_linear_arm(parts), {});
  ArmParts free_parts;
  free_parts.linear = parts.linear;
  const Reading free = modal_dynamics(model, free_parts, {}).turning.hub_acceleration;
  // theta'' = free.state X + free.actuator T, and theta'' is given.
  const Propagator step = propagator(driven.turning, sample_time_s, Precision::working);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(driven.size());
  x(0) = angle_rad * driven.scale_rad_per_s(0) / driven.hub_slope(0);
  x(driven.modes) = velocity_rad_per_s / driven.hub_slope(0);
  DrivenMotion made;
  for (std::size_t k = 0; k < acceleration_rad_per_s2.size(); ++k) {
    const double here = acceleration_rad_per_s2[k];
    if (k > 0) {
      const double before = acceleration_rad_per_s2[k - 1];
      x = step.state * x + step.actuator_begin * before + step.actuator_end * here;
    }
    made.angle_rad.push_back(driven.hub_angle(x));
    made.velocity_rad_per_s.push_back(driven.hub_velocity(x));
    made.torque_N_m.push_back((here - free.state.dot(x)) / free.actuator);
  }
  return made;
}

std::vector<double> transmitted_torque_N_m(const Actuator& actuator,
                                           std::span<const double> torque_N_m, double sample_time_s,
                                           TorqueHold hold) {
  const TorquePath path(actuator, torque_N_m, sample_time_s, hold);
  const double decay = actuator.lag_s > 0.0 ? std::exp(-sample_time_s / actuator.lag_s) : 0.0;
  // Part of an interval's mean that is what the lag began with.
  const double kept = actuator.lag_s > 0.0 ? actuator.lag_s / sample_time_s *
                                                 -std::expm1(-sample_time_s / actuator.lag_s)
                                           : 0.0;
  double lagged_N_m = 0.0;
  TorquePath::Pieces pieces;
  std::vector<double> made;
  for (std::size_t k = 0; k < torque_N_m.size(); ++k) {
    path.pieces(static_cast<std::ptrdiff_t>(k), pieces);
    double mean_N_m = 0.0;
    for (const TorquePiece& piece : pieces) {
      mean_N_m += 0.5 * (piece.end - piece.begin) * (piece.begin_N_m + piece.end_N_m);
    }
    made.push_back(mean_N_m + kept * (lagged_N_m - mean_N_m));
    lagged_N_m = mean_N_m + decay * (lagged_N_m - mean_N_m);
  }
  return made;
}

}  // namespace flexarm::response
