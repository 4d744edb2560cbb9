#pragma once

#include "response/time/arm_simulator.hpp"

#include <Eigen/Core>

#include <span>

namespace flexarm::diagnose {

/// One `time` run seen by a Kalman filter.
struct RunInnovations {
  /// L^-1 e of each sample, where L L^T = S is the covariance of the innovations e: independent
  /// with variance 1 where the model is right. Laid out as a run of `Observations`.
  Eigen::VectorXd standardised;
  double log_determinant = 0.0;  ///< sum of ln |S| over the samples
  response::FilteredRun filtered;
};

struct RecordedRun {
  std::span<const double> torque_N_m;
  Eigen::Ref<const Eigen::VectorXd> values;  ///< as a run of `Observations`
  Eigen::VectorXd deviations;                ///< of the readings, a sensor each
  bool starts_free = false;                  ///< from an unknown state, which is estimated
};

/// Throws InputError as response::ArmSimulator::filtered.
RunInnovations filter_run(const response::ArmSimulator& simulation, const RecordedRun& run,
                          double disturbance_N_m);

}  // namespace flexarm::diagnose
