#include "diagnose/search/problem.hpp"

#include "diagnose/noise_floor.hpp"
#include "diagnose/predictors/noise_estimate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace flexarm::diagnose {

namespace {

/// Whether the mean of errors is more than the mean of noise with the spectrum of the rest would
/// be: an offset of the sensor, which an autoregression would hide. The variance of the mean of n
/// numbers is the power at frequency 0 over n.
bool has_constant(const Eigen::VectorXd& errors) {
  constexpr double kMostDeviations = 5.0;
  const auto n = static_cast<double>(errors.size());
  const double mean = errors.mean();
  const Eigen::VectorXd rest = errors.array() - mean;
  const double size = rest.norm() / std::sqrt(n);
  if (!(size > 0.0)) return mean != 0.0;
  const double power = Autoregression(rest / size, kMostNoiseOrder).power(0.0);
  return std::abs(mean) > kMostDeviations * size * std::sqrt(power / n);
}

/// With the simulation's own error beside the noise; the signal's deviation is that by which both
/// are relative.
void widen(Observations& observations, const std::vector<double>& errors) {
  for (std::size_t c = 0; c < errors.size(); ++c) {
    ObservedChannel& channel = observations.channels[c];
    if (errors[c] == 0.0) continue;
    channel.numerical_error = errors[c];
    observations.deviations.segment(channel.first, channel.count) *=
        channel.floor() / channel.noise;
  }
}

Predictor predictor_for(const Experiment& experiment, Observations& observations,
                        const ProblemOptions& options) {
  ModeChoice modes{options.flexible_modes.value_or(0)};
  if (!options.flexible_modes) {
    modes = modes_needed(experiment, observations, arm::halfway(options.deadline));
  }
  if (is_driven_by_motion(experiment)) {
    modes.errors.resize(observations.channels.size(), 0.0);
    const auto of_motion =
        errors_of_motion(experiment, observations, modes.flexible_modes, options.deadline);
    for (std::size_t c = 0; c < of_motion.size(); ++c) {
      modes.errors[c] = std::hypot(modes.errors[c], of_motion[c]);
    }
  }
  widen(observations, modes.errors);
  return {experiment, observations, modes.flexible_modes, options.noise, options.deadline};
}

}  // namespace

Problem::Problem(const Experiment& experiment, const ProblemOptions& options)
    : Problem(experiment, observe(experiment), options) {}

Problem::Problem(const Experiment& experiment, Observations observations,
                 const ProblemOptions& options)
    : experiment_(&experiment),
      observations_(std::move(observations)),
      policy_(options.policy),
      predictor_(predictor_for(experiment, observations_, options)) {
  for (const auto& run : experiment.runs) {
    estimation_runs_.push_back(run.run.purpose == measured::Purpose::estimation);
    validation_runs_.push_back(run.run.purpose == measured::Purpose::validation);
  }
}

Problem::Problem(std::shared_ptr<const Experiment> experiment, const ProblemOptions& options)
    : Problem(experiment, observe(*experiment), options) {}

Problem::Problem(std::shared_ptr<const Experiment> experiment, Observations observations,
                 const ProblemOptions& options)
    : Problem(*experiment, std::move(observations), options) {
  own_experiment_ = std::move(experiment);
}

bool Problem::has_validation_runs() const {
  return std::ranges::count(validation_runs_, true) > 0;
}

const std::vector<bool>& Problem::judged_runs() const {
  return has_validation_runs() ? validation_runs_ : estimation_runs_;
}

double Problem::judged_error(const arm::Arm& arm) const {
  if (const auto left = residuals(arm, {}, judged_runs())) {
    const double error = misfit(observations_, *experiment_, *left, judged_runs()).relative_error;
    if (std::isfinite(error)) return error;
  }
  return std::numeric_limits<double>::infinity();
}

Problem Problem::with_modes(int flexible_modes) const {
  Problem made = *this;
  made.predictor_ = predictor_with(flexible_modes, predictor_.noise());
  return made;
}

Problem Problem::with_noise(const NoiseModel& noise) const {
  Problem made = *this;
  made.predictor_ = predictor_with(predictor_.flexible_modes(), noise);
  return made;
}

Problem Problem::until(const arm::Deadline& deadline) const {
  Problem made = *this;
  made.predictor_.set_deadline(deadline);
  return made;
}

Predictor Problem::predictor_with(int flexible_modes,
                                  const std::optional<NoiseModel>& noise) const {
  return {*experiment_, observations_, flexible_modes, noise, predictor_.deadline()};
}

void Problem::replace_torques(Experiment experiment) {
  own_experiment_ = std::make_shared<const Experiment>(std::move(experiment));
  experiment_ = own_experiment_.get();
  predictor_ = predictor_with(predictor_.flexible_modes(), predictor_.noise());
}

bool Problem::lower_noise(const Candidate& candidate) {
  const auto& noise = predictor_.noise();
  if (has_coloured_noise() || (noise && !noise->is_torque_noise())) return false;
  const auto left = residuals(candidate, std::vector<bool>(experiment_->runs.size(), true));
  if (!left) return false;
  const Eigen::VectorXd expected = with_expected_errors(observations_, *left);
  Observations lowered = observations_;
  bool fell = false;
  for (ObservedChannel& channel : lowered.channels) {
    if (experiment_->runs[channel.run].run.kind != measured::RunKind::time) continue;
    const auto part = expected.segment(channel.first, channel.count);
    // Residuals are in standard deviations of noise and numerical error together.
    const double widened = channel.floor();
    const double seen = std::max(
        kLeastNoise, widened * white_noise({part.data(), static_cast<std::size_t>(part.size())}));
    if (!(seen < channel.noise)) continue;
    fell = fell || seen < (1.0 - kLower) * channel.noise;
    channel.noise = seen;
    lowered.deviations.segment(channel.first, channel.count) *= channel.floor() / widened;
  }
  if (fell) {
    observations_ = std::move(lowered);
    predictor_ = predictor_with(predictor_.flexible_modes(), predictor_.noise());
  }
  return fell;
}

Problem Problem::with_torque_noise(const NoiseModel& noise,
                                   const std::vector<double>& errors) const {
  Problem made = with_noise(noise);
  for (std::size_t c = 0; c < errors.size(); ++c) {
    made.observations_.channels[c].torque_error = errors[c];
  }
  return made;
}

Problem Problem::with_more_noise(const std::vector<double>& more) const {
  Problem made = *this;
  for (std::size_t c = 0; c < more.size(); ++c) {
    ObservedChannel& channel = made.observations_.channels[c];
    const double before = channel.floor();
    channel.noise = std::hypot(channel.noise, more[c]);
    made.observations_.deviations.segment(channel.first, channel.count) *= channel.floor() / before;
  }
  made.predictor_ = made.predictor_with(predictor_.flexible_modes(), predictor_.noise());
  return made;
}

std::optional<Problem> Problem::with_coloured_noise(const Candidate& candidate) const {
  const auto left = residuals(candidate, std::vector<bool>(experiment_->runs.size(), true));
  if (!left) return std::nullopt;
  const Eigen::VectorXd errors =
      with_expected_errors(observations_, to_errors(observations_, *left));
  Problem made = *this;
  for (ObservedChannel& channel : made.observations_.channels) {
    if (experiment_->runs[channel.run].run.kind != measured::RunKind::time) continue;
    Eigen::VectorXd own = errors.segment(channel.first, channel.count);
    if (has_constant(own)) own.array() -= own.mean();
    const double seen = std::sqrt(own.squaredNorm() / static_cast<double>(channel.count));
    if (!(seen > 0.0)) continue;
    const double floor = seen * channel.floor();
    channel.noise = std::sqrt(
        std::max(kLeastNoise * kLeastNoise, floor * floor - std::pow(channel.numerical_error, 2)));
    made.observations_.deviations.segment(channel.first, channel.count) *= seen;
    own /= seen;
    channel.autoregression = Autoregression(own, kMostNoiseOrder);
  }
  made.predictor_ = made.predictor_with(predictor_.flexible_modes(), predictor_.noise());
  return made;
}

bool Problem::has_coloured_noise() const {
  return std::ranges::any_of(observations_.channels, [](const ObservedChannel& channel) {
    return channel.autoregression.order() > 0;
  });
}

bool Problem::estimate_noise(const Candidate& candidate, std::function<void()> go_on) {
  const NoiseModel present = *predictor_.noise();
  const arm::Arm arm = candidate.extend(experiment_->arm);
  const NoiseEstimator estimator(*experiment_, observations_, predictor_, std::move(go_on));
  const double before =
      estimator.disturbance(arm, estimation_runs_, present).minus_two_log_likelihood;
  NoiseEstimate found = estimator.model(arm, estimation_runs_, {present});
  found = estimator.with_modal_force(arm, estimation_runs_, found);
  if (!(found.minus_two_log_likelihood < before - kMoreLikely)) return false;
  predictor_ = predictor_with(predictor_.flexible_modes(), found.model);
  return true;
}

DisturbanceLeft Problem::disturbance_left(const Candidate& candidate,
                                          const std::vector<bool>& runs) const {
  const NoiseEstimator estimator(*experiment_, observations_, predictor_);
  const arm::Arm arm = candidate.extend(experiment_->arm);
  const NoiseEstimate found = estimator.disturbance(arm, runs, *predictor_.noise());
  const double deviation_N_m = found.model.disturbance_N_m;
  return {deviation_N_m, estimator.torque_rms_N_m(),
          estimated_disturbance_N_m(predictor_, arm, runs, *predictor_.noise()),
          found.minus_two_log_likelihood};
}

Candidate Problem::as_filed() const {
  return {.nuisances = std::vector<double>(experiment_->arm.relative_uncertainties.size())};
}

Eigen::Index Problem::residual_count() const {
  const auto uncertain = experiment_->arm.relative_uncertainties.size();
  return observations_.values.size() + static_cast<Eigen::Index>(uncertain);
}

std::optional<Eigen::VectorXd> Problem::residuals(const Candidate& candidate,
                                                  const std::vector<bool>& runs) const {
  try {
    return residuals(candidate.extend(experiment_->arm), candidate.nuisances, runs);
  } catch (const std::runtime_error&) {
    // An arm that is none.
    return std::nullopt;
  }
}

std::optional<Eigen::VectorXd> Problem::residuals(const arm::Arm& arm,
                                                  const std::vector<double>& nuisances,
                                                  const std::vector<bool>& runs) const {
  Eigen::VectorXd made;
  try {
    made = predictor_.residuals(arm, runs);
  } catch (const std::runtime_error&) {
    // An arm that is none, or whose equations no step solves.
    return std::nullopt;
  }
  for (const ObservedChannel& channel : observations_.channels) {
    if (!runs[channel.run]) made.segment(channel.first, channel.count).setZero();
  }
  to_residuals(observations_, made);
  const auto displaced = static_cast<Eigen::Index>(nuisances.size());
  made.conservativeResizeLike(Eigen::VectorXd::Zero(residual_count()));
  made.tail(displaced) = Eigen::VectorXd::Map(nuisances.data(), displaced);
  if (!made.allFinite()) return std::nullopt;
  return made;
}

}  // namespace flexarm::diagnose
