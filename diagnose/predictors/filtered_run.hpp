#pragma once

#include "response/time/arm_simulator.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace flexarm::diagnose {

/// One `time` run seen by a Kalman filter.
struct RunInnovations {
  /// L^-1 e of each sample, where L L^T = S is the covariance of the innovations e: independent
  /// with variance 1 where the model is right. Laid out as a run of `Observations`. The hub's
  /// sensor is the first in e: the others are what they show beyond the hub's motion. 0 for
  /// readings that are missing; S is then that of the others.
  Eigen::VectorXd standardised;
  Eigen::Index count = 0;        ///< of readings that are not missing
  double log_determinant = 0.0;  ///< RunFilter
  response::FilteredRun filtered;
};

struct RecordedRun {
  std::span<const double> torque_N_m;
  Eigen::Ref<const Eigen::VectorXd> values;  ///< as a run of `Observations`
  Eigen::VectorXd deviations;                ///< of the readings, a sensor each
  response::ProcessNoise process = {};
  bool starts_free = false;                     ///< from an unknown state, which is estimated
  std::optional<Eigen::Index> hub_sensor = {};  ///< the first of the hub's angle or velocity
  std::vector<Eigen::Index> missing = {};       ///< of `values`, those that are no readings
};

/// The filter of a run, whatever it reads.
struct RunFilter {
  response::FilterGains gains;
  /// Sum of ln |S| over the samples of the run, S the covariance of the innovations of the readings
  /// that are not missing.
  double log_determinant = 0.0;
};

/// `system` is simulation.sampled of the run. Throws InputError as response::filter_gain, and for
/// innovations whose covariance is singular.
RunFilter run_filter(const response::ArmSimulator& simulation,
                     const response::SampledSystem& system, const RecordedRun& run);

/// Throws InputError as response::ArmSimulator::filtered, and for innovations whose covariance is
/// singular.
RunInnovations filter_run(const response::ArmSimulator& simulation, const RecordedRun& run,
                          const RunFilter& filter);

/// What the same filter predicts ahead of its samples. Throws InputError as
/// response::ArmSimulator::errors_ahead.
response::ErrorsAhead run_ahead(const response::ArmSimulator& simulation, const RecordedRun& run,
                                const RunFilter& filter, const response::StartsAhead& starts);

}  // namespace flexarm::diagnose
