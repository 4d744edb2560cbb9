#include "diagnose/predictors/filtered_run.hpp"

#include "arm/input_error.hpp"
#include "diagnose/predictors/initial_state.hpp"

#include <Eigen/Cholesky>

#include <cstddef>

namespace flexarm::diagnose {

using Eigen::Index;

namespace {

Eigen::LLT<Eigen::MatrixXd> factor(const Eigen::MatrixXd& innovation_covariance) {
  Eigen::LLT<Eigen::MatrixXd> covariance(innovation_covariance);
  if (covariance.info() != Eigen::Success) {
    throw arm::InputError("Kalman filter: the covariance of the innovations is singular");
  }
  return covariance;
}

/// The sensors of a run with the hub's in the first place.
Eigen::PermutationMatrix<Eigen::Dynamic> hub_first(const RecordedRun& run) {
  Eigen::PermutationMatrix<Eigen::Dynamic> order(run.deviations.size());
  order.setIdentity();
  if (run.hub_sensor) order.applyTranspositionOnTheRight(0, *run.hub_sensor);
  return order;
}

/// Calls use(filter, first, count) for each stretch of samples with one filter.
template <class Use>
void for_each_filter(const response::FilterGains& gains, Index samples, const Use& use) {
  const auto begun = static_cast<Index>(gains.first.size());
  for (Index k = 0; k < begun; ++k) use(gains.first[static_cast<std::size_t>(k)], k, Index{1});
  if (samples > begun) use(gains.steady, begun, samples - begun);
}

}  // namespace

response::FilterGains filter_gains(const response::ArmSimulator& simulation,
                                   const RecordedRun& run) {
  const response::SampledSystem sampled = simulation.sampled(run.process, run.deviations);
  if (!run.starts_free) return {{}, response::filter_gain(sampled)};
  const std::size_t samples = run.torque_N_m.size();
  const Eigen::VectorXd deviations =
      run.deviations.transpose().replicate(static_cast<Index>(samples), 1).reshaped();
  const Eigen::VectorXd prior =
      prior_of_state(simulation.free_readings(samples), deviations, run.values);
  Eigen::MatrixXd covariance =
      Eigen::MatrixXd::Zero(sampled.transition.rows(), sampled.transition.cols());
  covariance.diagonal().head(prior.size()) = prior.cwiseAbs2();
  for (auto step = simulation.lead(samples); step > 0; --step) {
    covariance = response::covariance_after_step(sampled, covariance);
  }
  return response::filter_gains_from(sampled, covariance, samples);
}

double log_determinant(const response::FilterGains& gains, std::size_t samples) {
  double sum = 0.0;
  for_each_filter(gains, static_cast<Index>(samples),
                  [&](const response::FilterGain& filter, Index /*first*/, Index count) {
                    const auto covariance = factor(filter.innovation_covariance);
                    sum += 2.0 * covariance.matrixLLT().diagonal().array().log().sum() *
                           static_cast<double>(count);
                  });
  return sum;
}

RunInnovations filter_run(const response::ArmSimulator& simulation, const RecordedRun& run) {
  const auto samples = static_cast<Index>(run.torque_N_m.size());
  const Eigen::MatrixXd measured = run.values.reshaped(samples, run.deviations.size());
  const response::FilterGains gains = filter_gains(simulation, run);
  RunInnovations made;
  made.filtered = simulation.filtered(run.torque_N_m, measured, gains);
  made.log_determinant = log_determinant(gains, run.torque_N_m.size());
  const auto order = hub_first(run);
  Eigen::MatrixXd standardised(samples, measured.cols());
  for_each_filter(
      gains, samples, [&](const response::FilterGain& filter, Index first, Index count) {
        const auto covariance = factor(order * filter.innovation_covariance * order.transpose());
        const Eigen::MatrixXd innovations =
            order * made.filtered.innovations.middleRows(first, count).transpose();
        standardised.middleRows(first, count) =
            (order.transpose() * covariance.matrixL().solve(innovations)).transpose();
      });
  made.standardised = standardised.reshaped();
  return made;
}

response::ErrorsAhead run_ahead(const response::ArmSimulator& simulation, const RecordedRun& run,
                                const response::StartsAhead& starts) {
  const Eigen::MatrixXd measured =
      run.values.reshaped(std::ssize(run.torque_N_m), run.deviations.size());
  return simulation.errors_ahead(run.torque_N_m, measured, filter_gains(simulation, run), starts);
}

}  // namespace flexarm::diagnose
