#pragma once

#include "arm/deadline.hpp"
#include "measured/run_identification.hpp"
#include "response/time/arm_simulator.hpp"

#include <Eigen/Core>

#include <vector>

namespace flexarm::compare {

/// Readings that a `time` run shows by simulation, sensor after sensor, and, where it states its
/// controller, the torque behind them, `logged_late_s` later than it acts. The recorded torque
/// drives the arm, or the controller with the recorded reference. `measured` and `deviations` are
/// laid out alike; the deviation of a reading that is left out is infinite.
///
/// A run from an unknown state begins in the most likely one by `measured` and its `deviations`. In
/// closed loop it is the rigid arm's, with the angle and velocity of the hub that the first
/// readings show: the controller takes out what vibrates at the start.
///
/// Throws InputError and arm::Cancelled as response::ArmSimulator::readings and
/// closed_loop_readings.
Eigen::VectorXd simulated_run(const response::ArmSimulator& simulation,
                              const measured::MeasuredRun& run, double logged_late_s,
                              const Eigen::VectorXd& measured, const Eigen::VectorXd& deviations,
                              const arm::Deadline& deadline);

/// Readings of a `time` run whose hub moves as given, the simulation's hub being driven
/// (response::with_driven_hub): from angle [rad] and velocity [rad/s] at the first sample with an
/// acceleration a sample. From rest the beam is at rest too. In a run from an unknown state
/// the beam begins in the most likely one, as in `simulated_run`; the hub begins as given.
Eigen::VectorXd driven_run(const response::ArmSimulator& simulation, const Eigen::Vector2d& hub,
                           const std::vector<double>& acceleration_rad_per_s2,
                           const measured::MeasuredRun& run, const Eigen::VectorXd& measured,
                           const Eigen::VectorXd& deviations, const arm::Deadline& deadline);

}  // namespace flexarm::compare
