#pragma once

#include "diagnose/symptoms/hub_response.hpp"
#include "diagnose/symptoms/symptoms_input.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace flexarm::diagnose {

/// A hub sensor of a run, with what the simulation without causes leaves of it.
struct HubReading {
  HubResponse response;
  Eigen::Index first = 0;        ///< of its numbers among those of the Observations
  std::vector<double> residual;  ///< measured less simulated, in the sensor's unit
  double noise = 0.0;            ///< its standard deviation
  double relative_noise = 0.0;   ///< over that of the signal
};

/// How the hub moved in a `time` run that measured it. All vectors have a value a sample.
struct HubMotion {
  std::size_t run = 0;  ///< index of Experiment::runs
  std::string run_id;
  std::vector<double> time_s;
  std::vector<double> torque_N_m;  ///< commanded
  std::vector<double> angle_rad;   ///< measured, or the integral of the velocity
  /// Measured, or the slope of the angle over `kSlope_periods` of the first mode.
  std::vector<double> velocity_rad_per_s;
  double velocity_noise_rad_per_s = 0.0;        ///< standard deviation
  std::vector<double> acceleration_rad_per_s2;  ///< slope of the velocity
  measured::TorqueHold hold = measured::TorqueHold::zero;
  bool starts_free = false;          ///< `initial = "free"`: the initial state is not known
  std::vector<HubReading> readings;  ///< hub velocity before hub angle
};
inline constexpr double kSlope_periods = 0.1;

/// Of a run, without readings; empty unless it is in time and measured the hub's motion.
std::optional<HubMotion> hub_motion(const Problem& problem, std::size_t run);
/// Of the runs in time with a hub sensor.
std::vector<HubMotion> hub_motions(const SymptomsInput& input);

}  // namespace flexarm::diagnose
