#pragma once

#include "arm/arm.hpp"
#include "exact_tf/exact_arm.hpp"
#include "measured/files/time_record.hpp"
#include "measured/spectra/spectra.hpp"
#include "response/time/simulation.hpp"

#include <cstddef>
#include <random>
#include <string>
#include <vector>

namespace flexarm::benchmarks {

/// The record that is timed, here and by the sister script in Python: an hour at 1 kHz of the
/// paper's arm, damped, with five sensors, driven by random steps of torque.
inline measured::TimeRecord spectra_record(std::size_t samples = 3'600'000) {
  constexpr std::size_t kSamplesAStep = 5;
  constexpr double kPeriod_s = 1e-3;
  constexpr int kFlexibleModes = 4;
  arm::Arm arm = arm::paper_arm();
  arm.damping.kelvin_voigt_s = 1e-4;
  arm.hub.viscous_friction_N_m_s_per_rad = 0.02;
  std::vector<arm::Sensor> sensors;
  for (const char* name :
       {"hub_angle", "hub_velocity", "tip_acceleration", "strain@0.05", "strain@0.25"}) {
    sensors.push_back(arm::parse_sensor(name));
  }
  std::vector<double> torque;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> step(-0.05, 0.05);
  while (torque.size() < samples) torque.insert(torque.end(), kSamplesAStep, step(random));
  torque.resize(samples);
  response::ArmParts parts;
  parts.linear = arm;
  auto made =
      response::simulate(exact_tf::ExactArm(arm).modal_model(kFlexibleModes, sensors, {}), parts,
                         sensors, torque, {.sample_time_s = kPeriod_s, .energy = false});
  measured::TimeRecord record{std::move(made.time_s), std::move(torque), {}};
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    record.channels.push_back({sensors[i], std::move(made.channels[i])});
  }
  return record;
}

/// What SciPy is given too: Hann, half overlapped, the mean of each segment taken off.
inline measured::SegmentPlan spectra_plan() {
  return {8192, 4096, measured::Window::hann, measured::Detrend::mean};
}

}  // namespace flexarm::benchmarks
