#pragma once

#include "arm/arm.hpp"
#include "arm/deadline.hpp"
#include "measured/files/time_record.hpp"
#include "measured/run_identification.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace flexarm::compare {

/// One channel of a `time` run and its simulation, in the sensor's unit, a value a sample.
struct MeasuredSignal {
  std::string sensor;  ///< "hub_angle"; "torque" of a closed loop
  std::string unit;
  std::vector<double> measured;
  std::vector<double> simulated;
  std::vector<std::size_t> left_out = {};  ///< samples that are no readings, ascending
  /// 100 |y - yhat|/|y - mean y| over the readings; NaN where the measured signal is constant.
  double nrmse_percent = 0.0;
  /// 100 (1 - |y - yhat|/|y - mean y|), the fit of MATLAB's `compare`.
  double fit_percent() const { return 100.0 - nrmse_percent; }
};

/// A `time` run beside the simulation of an arm with all its effects.
struct MeasuredTimeRun {
  std::string run;
  arm::Payload payload;
  bool closed_loop = false;
  bool free_start = false;  ///< the initial state is the most likely one
  std::vector<double> time_s;
  std::vector<double> torque_N_m;  ///< recorded
  measured::Reference reference;   ///< of a closed loop
  std::vector<MeasuredSignal> signals;
};

/// Simulates the run by exact_tf with as many modes as the recorded torque asks for
/// (response/truncation.hpp), 40 at most: from rest or from the most likely initial
/// state, driven by the recorded torque, or in closed loop by the recorded reference. The run's
/// payload takes the place of the arm's. Throws InputError, with the run's id in front, and
/// arm::Cancelled as compare::simulated_run does.
MeasuredTimeRun run_beside_simulation(const arm::Arm& arm, const measured::MeasuredRun& run,
                                      const arm::Deadline& deadline = {});

}  // namespace flexarm::compare
