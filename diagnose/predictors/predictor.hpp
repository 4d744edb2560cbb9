#pragma once

#include "diagnose/experiment.hpp"
#include "diagnose/observations.hpp"
#include "response/time/arm_simulator.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace flexarm::diagnose {

/// As the simulation names what the torque does between samples.
response::TorqueHold simulated_hold(measured::TorqueHold hold);

/// What an arm should have shown in the runs of an experiment.
class Predictor {
 public:
  /// `flexible_modes` move in a simulated run, which is stepped as response::options_of_fit where
  /// forces are not linear; poles, zeros and frequency responses are exact. A run from an unknown
  /// state begins in that which brings it nearest to what was measured. `experiment` must outlive
  /// the object.
  Predictor(const Experiment& experiment, const Observations& observations, int flexible_modes);

  /// One number for each of the experiment's `Observations`, run after run, of those `runs` alone;
  /// the others are 0. `arm` is the experiment's with effects; each run sets its own payload.
  /// Throws InputError for an arm that cannot be computed. Concurrent calls are safe.
  Eigen::VectorXd operator()(const arm::Arm& arm, const std::vector<bool>& runs) const;

  int flexible_modes() const { return flexible_modes_; }

 private:
  /// Runs that one simulation serves.
  struct Condition {
    arm::Payload payload;
    std::vector<arm::Sensor> sensors;
    response::SimulationOptions options;
    std::vector<std::size_t> runs;
  };

  const Experiment* experiment_;
  int flexible_modes_;
  Observations observations_;
  std::vector<Condition> conditions_;  // of `time` runs
};

/// Flexible modes that move in simulated runs, and the error of leaving the others out.
struct ModeChoice {
  int flexible_modes = 0;
  /// Of each channel, root mean square over the deviation of the signal; 0 but in `time` runs.
  std::vector<double> errors = {};
};

/// The fewest modes with which the simulated runs are within `kModeError` of a signal's deviation,
/// or a tenth of its noise if that is more, of those with `kMostModes`; these where none suffice.
ModeChoice modes_needed(const Experiment& experiment, const Observations& observations);
inline constexpr double kModeError = 1e-4;
inline constexpr int kFewestModes = 4;
inline constexpr int kMostModes = 16;

}  // namespace flexarm::diagnose
