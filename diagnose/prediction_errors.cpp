#include "diagnose/prediction_errors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <variant>

namespace flexarm::diagnose {

namespace {

using Eigen::Index;

response::StartsAhead starts_in(std::size_t samples) {
  response::StartsAhead starts;
  for (const std::size_t ahead : kSamplesAhead) {
    if (2 * ahead <= samples) starts.horizons.push_back(static_cast<Index>(ahead));
  }
  if (starts.horizons.empty()) return starts;
  const std::size_t possible = samples - static_cast<std::size_t>(starts.horizons.back());
  starts.stride = static_cast<Index>((possible + kMostStarts - 1) / kMostStarts);
  return starts;
}

/// What is predicted, of both arms alike.
struct PredictedRuns {
  std::vector<bool> runs;
  std::vector<response::StartsAhead> starts;
};

/// Root mean square, of readings that are not missing.
double rms_of(const std::vector<Eigen::VectorXd>& errors, Index sensor) {
  double squares = 0.0;
  double count = 0.0;
  for (const Eigen::VectorXd& of_start : errors) {
    if (std::isnan(of_start(sensor))) continue;
    squares += of_start(sensor) * of_start(sensor);
    count += 1.0;
  }
  return std::sqrt(squares / count);
}

/// Of one arm, channel by channel: of each horizon, and of the simulation. Empty for an arm that
/// cannot be computed.
std::vector<double> errors_of(const Problem& filtered, const arm::Arm& arm,
                              const PredictedRuns& predicted) {
  const Observations& observations = filtered.observations();
  std::vector<double> made;
  try {
    const auto ahead = filtered.predictor().errors_ahead(arm, predicted.runs, predicted.starts);
    const Eigen::VectorXd simulated = filtered.predictor()(arm, predicted.runs);
    Index sensor = 0;
    for (std::size_t c = 0; c < observations.channels.size(); ++c) {
      const ObservedChannel& channel = observations.channels[c];
      const bool is_first = c == 0 || observations.channels[c - 1].run != channel.run;
      sensor = is_first ? 0 : sensor + 1;
      if (!predicted.runs[channel.run]) continue;
      const auto values = observations.values.segment(channel.first, channel.count);
      const double signal = std::sqrt((values.array() - values.mean()).square().mean());
      for (const auto& errors : ahead[channel.run]) made.push_back(rms_of(errors, sensor) / signal);
      Eigen::VectorXd left = values - simulated.segment(channel.first, channel.count);
      for (const std::size_t k : channel.left_out) left(static_cast<Index>(k)) = 0.0;
      made.push_back(left.norm() / std::sqrt(static_cast<double>(channel.used())) / signal);
    }
  } catch (const std::runtime_error&) {
    // An arm that is none, or a simulation that overflows.
    made.clear();
  }
  return made;
}

}  // namespace

std::vector<PredictionError> prediction_errors(const Problem& filtered, const arm::Arm& before,
                                               const arm::Arm& after) {
  const auto& all = filtered.experiment().runs;
  PredictedRuns predicted{filtered.judged_runs(), {}};
  std::vector<PredictionError> made;
  for (std::size_t r = 0; r < all.size(); ++r) {
    const auto* record = std::get_if<measured::TimeRecord>(&all[r].data);
    predicted.runs[r] = predicted.runs[r] && record != nullptr;
    predicted.starts.push_back(predicted.runs[r] ? starts_in(record->time_s.size())
                                                 : response::StartsAhead());
    if (!predicted.runs[r]) continue;
    const double period_s = measured::sampling_period_s(*record);
    for (const auto& channel : record->channels) {
      const PredictionError simulation{all[r].run.id, to_string(channel.sensor)};
      for (const Index ahead : predicted.starts[r].horizons) {
        made.push_back(simulation);
        made.back().samples_ahead = static_cast<std::size_t>(ahead);
        made.back().ahead_s = static_cast<double>(ahead) * period_s;
      }
      made.push_back(simulation);
    }
  }
  constexpr double kNotComputed = std::numeric_limits<double>::infinity();
  const std::vector<double> of_before = errors_of(filtered, before, predicted);
  const std::vector<double> of_after = errors_of(filtered, after, predicted);
  for (std::size_t i = 0; i < made.size(); ++i) {
    made[i].before = of_before.empty() ? kNotComputed : of_before[i];
    made[i].after = of_after.empty() ? kNotComputed : of_after[i];
  }
  return made;
}

}  // namespace flexarm::diagnose
