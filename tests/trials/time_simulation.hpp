#pragma once

#include "arm/sensor.hpp"
#include "tests/trials/plant.hpp"
#include "tests/trials/world.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace flexarm::trials {

struct TimeOptions {
  double sample_time_s = 2e-3;
  int substeps = 80;  ///< std::runtime_error where these are too long steps for the highest mode
  PlantOptions plant = {};
  std::uint64_t disturbance_seed = 1;
  /// Sensors are read so many steps after each sample, fewer than `substeps`; empty: at it.
  std::vector<int> late_substeps = {};
  /// Closed loop: the command that holds from a sample on, by what the sensors read there. Empty:
  /// the torque as it is given.
  std::function<double(std::size_t sample, std::span<const double> readings)> control = {};
};

/// What is recorded of a run, one vector of readings a sensor.
struct SimulatedRun {
  std::vector<double> torque_N_m;  ///< as commanded
  std::vector<std::vector<double>> channels;
};

/// What the sensors of an arm at rest read under a torque that holds from sample to sample, one
/// vector a sensor; accelerations are those just after a jump of the torque.
///
/// Newmark's method [Newmark1959] with a fixed step and the gamma 1/2, beta 1/12 of
/// [FoxGoodwin1949]: periods are right to (omega h)^4/480, where average acceleration would lengthen
/// them by (omega h)^2/12, more than a fit to such data takes for chance. Stable for omega h <
/// sqrt(6); the highest of the modes kept is far below.
///
/// Friction is a set-valued law for the speed at the end of each step. The speed, not its mean over
/// the step, is what comes to rest: held to a mean of zero it would change its sign at every step.
SimulatedRun simulate_run(const World& world, std::span<const arm::Sensor> sensors,
                          std::span<const double> torque_N_m, const TimeOptions& options = {});

/// The readings alone.
std::vector<std::vector<double>> simulate_in_time(const World& world,
                                                  std::span<const arm::Sensor> sensors,
                                                  std::span<const double> torque_N_m,
                                                  const TimeOptions& options = {});

}  // namespace flexarm::trials
