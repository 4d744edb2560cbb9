#include "diagnose/problem.hpp"

#include "arm/input_error.hpp"

namespace flexarm::diagnose {

Problem::Problem(const Experiment& experiment, const ProblemOptions& options)
    : experiment_(&experiment),
      observations_(observe(experiment)),
      predictor_(experiment,
                 options.flexible_modes ? *options.flexible_modes
                                        : modes_needed(experiment, observations_),
                 options.substeps) {
  for (const auto& run : experiment.runs) {
    estimation_runs_.push_back(run.run.purpose == measured::Purpose::estimation);
    validation_runs_.push_back(run.run.purpose == measured::Purpose::validation);
  }
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
