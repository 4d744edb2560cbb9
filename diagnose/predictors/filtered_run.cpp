#include "diagnose/predictors/filtered_run.hpp"

#include "arm/input_error.hpp"

#include <Eigen/Cholesky>

#include <limits>

namespace flexarm::diagnose {

namespace {

using Eigen::Index;

/// Covariance of an unknown initial state: what each state adds to the readings is about as large
/// as the readings themselves.
Eigen::MatrixXd prior_of_state(const response::ArmSimulator& simulation, const RecordedRun& run,
                               const Eigen::VectorXd& deviations) {
  const Eigen::MatrixXd per_state = simulation.free_readings(run.torque_N_m.size());
  const double size = run.values.cwiseQuotient(deviations).norm();
  const Eigen::VectorXd own =
      (deviations.cwiseInverse().asDiagonal() * per_state).colwise().norm();
  return (size * own.cwiseMax(std::numeric_limits<double>::min()).cwiseInverse())
      .cwiseAbs2()
      .asDiagonal();
}

}  // namespace

RunInnovations filter_run(const response::ArmSimulator& simulation, const RecordedRun& run,
                          double disturbance_N_m) {
  const auto samples = static_cast<Index>(run.torque_N_m.size());
  const Index sensors = run.deviations.size();
  const Eigen::MatrixXd measured = run.values.reshaped(samples, sensors);
  const response::SampledSystem sampled = simulation.sampled(disturbance_N_m, run.deviations);
  response::FilterGains gains;
  if (run.starts_free) {
    const Eigen::VectorXd deviations =
        run.deviations.transpose().replicate(samples, 1).reshaped();
    gains = response::filter_gains_from(sampled, prior_of_state(simulation, run, deviations),
                                        run.torque_N_m.size());
  } else {
    gains.steady = response::filter_gain(sampled);
  }
  RunInnovations made;
  made.filtered = simulation.filtered(run.torque_N_m, measured, gains);
  Eigen::MatrixXd standardised(samples, sensors);
  const auto standardise = [&](const response::FilterGain& filter, Index first, Index count) {
    const Eigen::LLT<Eigen::MatrixXd> covariance(filter.innovation_covariance);
    if (covariance.info() != Eigen::Success) {
      throw arm::InputError("Kalman filter: the covariance of the innovations is singular");
    }
    standardised.middleRows(first, count) =
        covariance.matrixL()
            .solve(made.filtered.innovations.middleRows(first, count).transpose())
            .transpose();
    made.log_determinant += 2.0 * covariance.matrixLLT().diagonal().array().log().sum() *
                            static_cast<double>(count);
  };
  const auto begun = static_cast<Index>(gains.first.size());
  for (Index k = 0; k < begun; ++k) standardise(gains.first[static_cast<std::size_t>(k)], k, 1);
  if (samples > begun) standardise(gains.steady, begun, samples - begun);
  made.standardised = standardised.reshaped();
  return made;
}

}  // namespace flexarm::diagnose
