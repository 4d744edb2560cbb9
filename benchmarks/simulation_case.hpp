#pragma once

#include "arm/formulation.hpp"
#include "exact_tf/exact_arm.hpp"
#include "response/time/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

namespace flexarm::benchmarks {

/// The simulation that is timed, here and by other tools (benchmarks/comparison): the paper's arm,
/// damped, at 10 kHz (some eleven samples a period of the tenth mode), with four sensors, driven by
/// random steps of torque, ten a second.
struct SimulationCase {
  arm::Arm arm;
  std::vector<arm::Sensor> sensors;
  arm::ModalModel model;
  std::vector<double> torque_N_m;
  double sample_time_s = 1e-4;
};

/// Largest difference of two signals, relative to the peak of `exact`.
inline double relative_difference(const std::vector<double>& found,
                                  const std::vector<double>& exact) {
  double peak = 0.0;
  double difference = 0.0;
  for (std::size_t k = 0; k < exact.size(); ++k) {
    peak = std::max(peak, std::abs(exact[k]));
    difference = std::max(difference, std::abs(found[k] - exact[k]));
  }
  return difference / peak;
}

inline SimulationCase simulation_case(int flexible_modes,
                                      const std::vector<double>& stations_m = {},
                                      std::size_t samples = 100'000) {
  constexpr std::size_t kSamplesAStep = 1000;
  SimulationCase made;
  made.arm = arm::paper_arm();
  made.arm.damping.kelvin_voigt_s = 2e-5;
  made.arm.hub.viscous_friction_N_m_s_per_rad = 2e-3;
  for (const char* name : {"hub_angle", "hub_velocity", "tip_acceleration", "strain@0.05"}) {
    made.sensors.push_back(arm::parse_sensor(name));
  }
  made.model = exact_tf::ExactArm(made.arm).modal_model(flexible_modes, made.sensors, stations_m);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> torque(-0.05, 0.05);
  while (made.torque_N_m.size() < samples) {
    made.torque_N_m.insert(made.torque_N_m.end(), kSamplesAStep, torque(random));
  }
  return made;
}

}  // namespace flexarm::benchmarks
