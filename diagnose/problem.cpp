#include "diagnose/problem.hpp"

#include "arm/input_error.hpp"
#include "diagnose/noise_floor.hpp"

#include <utility>

namespace flexarm::diagnose {

Problem::Problem(const Experiment& experiment, const ProblemOptions& options)
    : Problem(experiment, observe(experiment), options) {}

Problem::Problem(const Experiment& experiment, Observations observations,
                 const ProblemOptions& options)
    : experiment_(&experiment),
      observations_(std::move(observations)),
      predictor_(experiment, observations_,
                 options.flexible_modes ? *options.flexible_modes
                                        : modes_needed(experiment, observations_),
                 options.substeps) {
  for (const auto& run : experiment.runs) {
    estimation_runs_.push_back(run.run.purpose == measured::Purpose::estimation);
    validation_runs_.push_back(run.run.purpose == measured::Purpose::validation);
  }
}

Problem Problem::with_substeps(int substeps) const {
  Problem made = *this;
  made.predictor_ = Predictor(*experiment_, observations_, predictor_.flexible_modes(), substeps);
  return made;
}

bool Problem::lower_noise(const Candidate& candidate) {
  const auto left = residuals(candidate, std::vector<bool>(experiment_->runs.size(), true));
  if (!left) return false;
  Observations lowered = observations_;
  bool fell = false;
  for (ObservedChannel& channel : lowered.channels) {
    if (experiment_->runs[channel.run].run.kind != measured::RunKind::time) continue;
    const Eigen::VectorXd part = left->segment(channel.first, channel.count);
    const double ratio = white_noise({part.data(), static_cast<std::size_t>(part.size())});
    if (!(ratio < 1.0) || !(ratio > 0.0)) continue;
    fell = fell || ratio < 1.0 - kLower;
    channel.noise *= ratio;
    lowered.deviations.segment(channel.first, channel.count) *= ratio;
  }
  if (fell) observations_ = std::move(lowered);
  return fell;
}

std::optional<Eigen::VectorXd> Problem::residuals(const Candidate& candidate,
                                                  const std::vector<bool>& runs) const {
  Eigen::VectorXd made;
  try {
    made = predictor_(candidate.extend(experiment_->arm), runs);
  } catch (const arm::InputError&) {
    return std::nullopt;
  }
  made = (observations_.values - made).cwiseQuotient(observations_.deviations);
  for (const ObservedChannel& channel : observations_.channels) {
    if (!runs[channel.run]) made.segment(channel.first, channel.count).setZero();
  }
  if (!made.allFinite()) return std::nullopt;
  return made;
}

}  // namespace flexarm::diagnose
