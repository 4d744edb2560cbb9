#include "diagnose/search/evidence_of_fit.hpp"

#include "diagnose/parallel.hpp"
#include "measured/spectra/tail_probability.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace flexarm::diagnose {

namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Returns a difference that is more than the rounding of two simulations; else 0.
double beyond_rounding(double difference) {
  constexpr double kRoundingOfCosts = 1e-9;
  return std::abs(difference) > kRoundingOfCosts ? difference : 0.0;
}

/// Returns for each channel of these runs the mean squares of residuals over each of kErrorBlocks
/// blocks, relative to the signal: their mean is the square of the channel's NRMSE.
std::vector<ArrayXd> block_squares(const Problem& problem, const std::vector<bool>& runs,
                                   const VectorXd& residuals) {
  const Observations& observations = problem.observations();
  const VectorXd errors = to_errors(observations, residuals);
  std::vector<ArrayXd> made;
  for (const ObservedChannel& channel : observations.channels) {
    if (!runs[channel.run]) continue;
    const Index blocks = std::min<Index>(kErrorBlocks, channel.count);
    ArrayXd squares(blocks);
    for (Index b = 0; b < blocks; ++b) {
      const Index first = b * channel.count / blocks;
      const Index count = (b + 1) * channel.count / blocks - first;
      const auto block = errors.segment(channel.first + first, count);
      squares(b) = block.squaredNorm() / static_cast<double>(count);
    }
    const double error = relative_error(observations, problem.experiment(), channel, residuals);
    const double mean = squares.mean();
    if (mean > 0.0) squares *= error * error / mean;
    made.push_back(std::move(squares));
  }
  return made;
}

/// Sets the NRMSE and its increase in `evidence`, from the block squares without the effect and
/// with it. The standard error is that of the mean difference of the squares over the blocks of
/// each channel.
void set_errors(const std::vector<ArrayXd>& without, const std::vector<ArrayXd>& with,
                EffectEvidence& evidence) {
  double error = 0.0;
  double increase = 0.0;
  double variance = 0.0;
  double channels = 0.0;
  for (std::size_t c = 0; c < with.size(); ++c) {
    const ArrayXd differences = without[c] - with[c];
    const double more = std::sqrt(without[c].mean());
    const double sum = more + std::sqrt(with[c].mean());
    if (!(sum > 0.0)) continue;
    const auto n = static_cast<double>(differences.size());
    error += more;
    increase += differences.mean() / sum;
    variance += (differences - differences.mean()).square().sum() /
                (n * std::max(1.0, n - 1.0) * sum * sum);
    channels += 1.0;
  }
  if (channels == 0.0) return;
  evidence.error_without = error / channels;
  evidence.error_increase = beyond_rounding(increase / channels);
  evidence.error_increase_std_error = beyond_rounding(std::sqrt(variance) / channels);
}

/// The estimates of one effect by each run alone.
class RunEstimates {
 public:
  RunEstimates(const Likelihood& all_runs, const ScoredFit& fit)
      : all_runs_(all_runs), fit_(fit), weights_(all_runs.weights(fit.lines)) {}

  /// Sets the runs of `evidence`, and their agreement, for the effect at `index`.
  void set(std::size_t index, EffectEvidence& evidence) const {
    const Candidate& set = fit_.candidate;
    const auto& parameters = set.effects[index].parameters;
    const auto first = static_cast<Index>(set.nuisances.size() + set.values_before(index));
    const Index count = std::ssize(parameters);
    const VectorXd here = set.coordinates().segment(first, count);
    MatrixXd information = MatrixXd::Zero(count, count);
    VectorXd weighted_steps = VectorXd::Zero(count);
    double squares = 0.0;
    int runs = 0;
    const auto& measured_runs = all_runs_.problem().experiment().runs;
    for (std::size_t r = 0; r < measured_runs.size(); ++r) {
      const auto [of_run, gradient] = normal_equations(r, first, count);
      const Eigen::LLT<MatrixXd> solver(of_run);
      if (solver.info() != Eigen::Success) continue;
      const VectorXd step = -solver.solve(gradient);
      const VectorXd variances = solver.solve(MatrixXd::Identity(count, count)).diagonal();
      if (!(std::sqrt(variances.maxCoeff()) < all_runs_.problem().policy().place_deviation))
        continue;
      ++runs;
      information += of_run;
      weighted_steps += of_run * step;
      squares += step.dot(of_run * step);
      RunEstimate estimate{.run = measured_runs[r].run.id, .values = {}, .std_errors = {}};
      for (Index i = 0; i < count; ++i) {
        const auto& parameter = parameters[static_cast<std::size_t>(i)];
        const double deviation = std::sqrt(variances(i));
        const double place = here(i) + step(i);
        estimate.values.push_back(parameter.value(place));
        estimate.std_errors.push_back(0.5 * std::abs(parameter.value(place + deviation) -
                                                     parameter.value(place - deviation)));
      }
      evidence.runs.push_back(std::move(estimate));
    }
    if (runs < 2) return;
    const VectorXd mean = information.ldlt().solve(weighted_steps);
    const double apart = std::max(0.0, squares - mean.dot(information * mean));
    const auto freedom = static_cast<double>(count * (runs - 1));
    evidence.agreement = measured::chi_squared_tail(apart, freedom);
  }

 private:
  /// Returns J^T W J and J^T W y of these columns over the lines of one run.
  std::pair<MatrixXd, VectorXd> normal_equations(std::size_t run, Index first, Index count) const {
    MatrixXd normal = MatrixXd::Zero(count, count);
    VectorXd gradient = VectorXd::Zero(count);
    for (const ObservedChannel& channel : all_runs_.problem().observations().channels) {
      if (channel.run != run) continue;
      const auto columns = fit_.jacobian.block(channel.first, first, channel.count, count);
      const auto weights = weights_.segment(channel.first, channel.count);
      const MatrixXd weighted = weights.asDiagonal() * columns;
      normal.noalias() += weighted.transpose() * columns;
      gradient.noalias() += weighted.transpose() * fit_.lines.segment(channel.first, channel.count);
    }
    return {normal, gradient};
  }

  const Likelihood& all_runs_;
  const ScoredFit& fit_;
  VectorXd weights_;
};

}  // namespace

std::vector<EffectEvidence> evidence_for_each(const Likelihood& held_out, const ScoredFit& chosen,
                                              const std::vector<ScoredFit>& without,
                                              const ReportedWork& work) {
  const Problem& problem = held_out.problem();
  const Likelihood all_runs(problem, std::vector<bool>(held_out.runs().size(), true));
  const ScoredFit in_all_runs = scored_fit(all_runs, chosen.candidate, work, {.most_steps = 0});
  const auto with = problem.residuals(chosen.candidate, problem.judged_runs());
  std::vector<EffectEvidence> made;
  for (const ScoredFit& one : without) {
    made.push_back({.score = one.score - chosen.score, .estimation = one.cost - chosen.cost});
  }
  if (!with || !in_all_runs.is_possible()) return made;
  const RunEstimates estimates(all_runs, in_all_runs);
  const std::vector<ArrayXd> squares = block_squares(problem, problem.judged_runs(), *with);
  const auto held_out_cost = [&](const VectorXd& residuals) {
    return held_out.cost(held_out.lines(residuals));
  };
  const bool has_held_out = problem.has_validation_runs();
  const double cost = has_held_out ? held_out_cost(*with) : 0.0;
  in_parallel(made.size(), [&](std::size_t i) {
    work.go_on();
    EffectEvidence& evidence = made[i];
    estimates.set(i, evidence);
    const auto left = problem.residuals(without[i].candidate, problem.judged_runs());
    if (left) {
      if (has_held_out) evidence.held_out = beyond_rounding(held_out_cost(*left) - cost);
      set_errors(block_squares(problem, problem.judged_runs(), *left), squares, evidence);
    } else {
      evidence.error_without = std::numeric_limits<double>::infinity();
      evidence.error_increase = evidence.error_without;
      if (has_held_out) evidence.held_out = evidence.error_without;
    }
  });
  return made;
}

}  // namespace flexarm::diagnose
