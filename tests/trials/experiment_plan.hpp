#pragma once

#include "arm/sensor.hpp"
#include "measured/files/measurement.hpp"
#include "tests/trials/random.hpp"
#include "tests/trials/trial_arms.hpp"

#include <string>
#include <vector>

namespace flexarm::trials {

/// A run as it is to be measured.
struct PlannedRun {
  std::string id;
  measured::Purpose purpose = measured::Purpose::estimation;
  double payload_kg = 0.0;
  std::vector<double> torque_N_m = {};  ///< of a time run
};

/// Six runs in time, or three payloads in frequency, or four in poles and zeros. `random` draws the
/// torques.
std::vector<PlannedRun> plan(const TrialArm& of, measured::RunKind kind, Random& random);

/// The strain gauge of time and frequency runs.
inline constexpr arm::Sensor kGauge{arm::SensorKind::strain, 0.05};
/// The sensors of time and frequency runs.
const std::vector<arm::Sensor>& planned_sensors();
/// `count` frequencies in equal ratios, from 0.5 Hz to beyond the arm's fourth pole.
std::vector<double> planned_frequencies_Hz(const TrialArm& of, int count);
inline constexpr int kFrequencyLines = 500;
inline constexpr int kModalOrders = 4;

}  // namespace flexarm::trials
