#pragma once

#include "arm/deadline.hpp"
#include "diagnose/measured_motion.hpp"
#include "measured/run_identification.hpp"
#include "response/time/arm_simulator.hpp"

#include <Eigen/Core>

namespace flexarm::diagnose {

/// What a `time` run shows by simulation, as a run of `Observations`: its readings and, where it
/// states its controller, the torque behind them, `logged_late_s` later than it acts. The recorded
/// torque drives the arm, or the controller with the recorded reference.
///
/// A run from an unknown state begins in the most likely one by `measured` and its `deviations`. In
/// closed loop it is the rigid arm's, with the angle and velocity of the hub that the first
/// readings show: the controller takes out what vibrates at the start.
///
/// Throws InputError as response::ArmSimulator::readings and closed_loop_readings; arm::Cancelled
/// where the search for that state is beyond the deadline.
Eigen::VectorXd simulated_run(const response::ArmSimulator& simulation,
                              const measured::MeasuredRun& run, double logged_late_s,
                              const Eigen::VectorXd& measured, const Eigen::VectorXd& deviations,
                              const arm::Deadline& deadline);

/// What a `time` run shows whose hub moves as given, the simulation's hub being driven
/// (response::with_driven_hub). From rest the beam is at rest too. In a run from an unknown state
/// the beam begins in the most likely one, as in `simulated_run`; the hub begins as given.
Eigen::VectorXd driven_run(const response::ArmSimulator& simulation, const PrescribedMotion& motion,
                           const measured::MeasuredRun& run, const Eigen::VectorXd& measured,
                           const Eigen::VectorXd& deviations, const arm::Deadline& deadline);

}  // namespace flexarm::diagnose
