#include "diagnose/predictors/filtered_run.hpp"

#include "arm/input_error.hpp"
#include "compare/initial_state.hpp"

#include <Eigen/Cholesky>

#include <cstddef>
#include <limits>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

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

double log_determinant(const Eigen::MatrixXd& innovation_covariance) {
  return 2.0 * factor(innovation_covariance).matrixLLT().diagonal().array().log().sum();
}

/// A row a sample and a column a sensor; not a number where a reading is missing.
Eigen::MatrixXd measured_or_missing(const RecordedRun& run) {
  Eigen::VectorXd values = run.values;
  for (const Index k : run.missing) values(k) = std::numeric_limits<double>::quiet_NaN();
  return values.reshaped(std::ssize(run.torque_N_m), run.deviations.size());
}

/// Of each sample with a missing reading the sensors whose readings are there, the hub's first.
std::map<Index, std::vector<Index>> readings_beside_missing(const RecordedRun& run) {
  const auto samples = std::ssize(run.torque_N_m);
  std::vector<Index> sensors(static_cast<std::size_t>(run.deviations.size()));
  std::iota(sensors.begin(), sensors.end(), Index{0});
  const auto hub = static_cast<std::size_t>(run.hub_sensor.value_or(0));
  std::swap(sensors.front(), sensors[hub]);
  std::map<Index, std::vector<Index>> made;
  for (const Index k : run.missing) {
    std::erase(made.try_emplace(k % samples, sensors).first->second, k / samples);
  }
  return made;
}

/// Calls use(filter, first, count) for each stretch of samples with one filter.
template <class Use>
void for_each_filter(const response::FilterGains& gains, Index samples, const Use& use) {
  const auto begun = static_cast<Index>(gains.first.size());
  for (Index k = 0; k < begun; ++k) use(gains.first[static_cast<std::size_t>(k)], k, Index{1});
  if (samples > begun) use(gains.steady, begun, samples - begun);
}

/// Sum of ln |S| over the samples.
double sum_of_log_determinants(const response::FilterGains& gains, const RecordedRun& run) {
  double sum = 0.0;
  for_each_filter(gains, std::ssize(run.torque_N_m),
                  [&](const response::FilterGain& filter, Index /*first*/, Index count) {
                    sum +=
                        log_determinant(filter.innovation_covariance) * static_cast<double>(count);
                  });
  for (const auto& [sample, there] : readings_beside_missing(run)) {
    const Eigen::MatrixXd& covariance =
        gains.at(static_cast<std::size_t>(sample)).innovation_covariance;
    sum -= log_determinant(covariance);
    if (!there.empty()) sum += log_determinant(covariance(there, there));
  }
  return sum;
}

response::FilterGains gains_of(const response::ArmSimulator& simulation,
                               const response::SampledSystem& system, const RecordedRun& run) {
  if (!run.starts_free) return {{}, response::filter_gain(system)};
  const std::size_t samples = run.torque_N_m.size();
  const Eigen::VectorXd deviations =
      run.deviations.transpose().replicate(static_cast<Index>(samples), 1).reshaped();
  const Eigen::VectorXd prior =
      compare::prior_of_state(simulation.free_readings(samples), deviations, run.values);
  Eigen::MatrixXd covariance =
      Eigen::MatrixXd::Zero(system.transition.rows(), system.transition.cols());
  covariance.diagonal().head(prior.size()) = prior.cwiseAbs2();
  for (auto step = simulation.lead(samples); step > 0; --step) {
    covariance = response::covariance_after_step(system, covariance);
  }
  return response::filter_gains_from(system, covariance, samples);
}

}  // namespace

RunFilter run_filter(const response::ArmSimulator& simulation,
                     const response::SampledSystem& system, const RecordedRun& run) {
  RunFilter made{.gains = gains_of(simulation, system, run)};
  made.log_determinant = sum_of_log_determinants(made.gains, run);
  return made;
}

RunInnovations filter_run(const response::ArmSimulator& simulation, const RecordedRun& run,
                          const RunFilter& filter) {
  const auto samples = static_cast<Index>(run.torque_N_m.size());
  const Eigen::MatrixXd measured = measured_or_missing(run);
  const response::FilterGains& gains = filter.gains;
  RunInnovations made;
  made.filtered = simulation.filtered(run.torque_N_m, measured, gains);
  made.count = measured.size() - std::ssize(run.missing);
  made.log_determinant = filter.log_determinant;
  const auto order = hub_first(run);
  Eigen::MatrixXd standardised(samples, measured.cols());
  for_each_filter(gains, samples, [&](const response::FilterGain& gain, Index first, Index count) {
    const auto covariance = factor(order * gain.innovation_covariance * order.transpose());
    const Eigen::MatrixXd innovations =
        order * made.filtered.innovations.middleRows(first, count).transpose();
    standardised.middleRows(first, count) =
        (order.transpose() * covariance.matrixL().solve(innovations)).transpose();
  });
  for (const auto& [sample, there] : readings_beside_missing(run)) {
    standardised.row(sample).setZero();
    if (there.empty()) continue;
    const response::FilterGain& gain = gains.at(static_cast<std::size_t>(sample));
    const auto covariance = factor(gain.innovation_covariance(there, there));
    const Eigen::VectorXd innovations = made.filtered.innovations.row(sample)(there).transpose();
    standardised.row(sample)(there) = covariance.matrixL().solve(innovations).transpose();
  }
  made.standardised = standardised.reshaped();
  return made;
}

response::ErrorsAhead run_ahead(const response::ArmSimulator& simulation, const RecordedRun& run,
                                const RunFilter& filter, const response::StartsAhead& starts) {
  return simulation.errors_ahead(run.torque_N_m, measured_or_missing(run), filter.gains, starts);
}

}  // namespace flexarm::diagnose
