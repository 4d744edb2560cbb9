#include "diagnose/search/admission.hpp"

#include "diagnose/search/misfit.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

namespace flexarm::diagnose {

namespace {

using Eigen::Index;

/// A coordinate within this of an end of its range is at the end,
constexpr double kAtEnd = 1e-3;
/// unless it may be farther inside by so many standard errors.
constexpr double kMayBe = 2.0;

/// Of the coordinates; infinite where the residuals do not depend on one.
Eigen::VectorXd errors_of_least_squares(const Explanation& explanation) {
  const Eigen::MatrixXd& jacobian = explanation.fit.jacobian;
  const Index n = jacobian.cols();
  const Eigen::LDLT<Eigen::MatrixXd> information(jacobian.transpose() * jacobian);
  const Eigen::VectorXd variances = explanation.estimation.variance_of_estimates() *
                                    information.solve(Eigen::MatrixXd::Identity(n, n)).diagonal();
  return variances.unaryExpr([](double variance) {
    return variance > 0.0 ? std::sqrt(variance) : std::numeric_limits<double>::infinity();
  });
}

/// The share that counts for the bars. The level of noise is known to a part of its power, and an
/// error that this hides may be far above that of a simulation where noise is strong. Where the
/// fuller set leaves none, that error was no noise.
double share_named(const Misfit& simpler, const Misfit& fuller, const SelectionOptions& options) {
  const bool is_hidden = simpler.is_noise() && fuller.is_noise() && !simpler.disturbance &&
                         simpler.unexplained_error() > options.negligible_error &&
                         fuller.unexplained_error() <= options.negligible_error;
  return is_hidden ? 1.0 : share_taken(simpler, fuller);
}

/// The sum of squares of noise, and what a fit of few steps with few modes may be off by: a tenth.
double most_of_noise(const Fit& fit) {
  constexpr double kCoarse = 0.1;
  return (1.0 + kCoarse) * static_cast<double>(fit.residuals.size());
}

}  // namespace

std::optional<std::size_t> unidentified_effect(const Candidate& candidate,
                                               const Eigen::VectorXd& errors) {
  if (candidate.effects.empty()) return std::nullopt;
  const Eigen::VectorXd coordinates = candidate.coordinates();
  if (errors.size() != coordinates.size()) return 0;
  Index at = std::ssize(candidate.nuisances);
  for (std::size_t i = 0; i < candidate.effects.size(); ++i) {
    for (const SearchedParameter& parameter : candidate.effects[i].parameters) {
      const double place = coordinates(at);
      const double may_be = kMayBe * errors(at);
      const bool is_inside = place + may_be > kAtEnd && place - may_be < 1.0 - kAtEnd;
      const bool is_significant = errors(at) < parameter.size(place);
      if (!is_significant || !(parameter.periodic || is_inside)) return i;
      ++at;
    }
  }
  return std::nullopt;
}

std::optional<std::size_t> unidentified_effect(const Explanation& explanation) {
  const Candidate& candidate = explanation.fit.candidate;
  if (candidate.parameters().empty()) return std::nullopt;
  const Eigen::VectorXd coordinates = candidate.coordinates();
  if (!coordinates.allFinite() || explanation.fit.jacobian.cols() != coordinates.size()) return 0;
  return unidentified_effect(candidate, errors_of_least_squares(explanation));
}

bool is_identified(const Explanation& explanation) {
  return !unidentified_effect(explanation);
}

bool clears_bars(const Explanation& fuller, const Explanation& simpler,
                 const SelectionOptions& options) {
  if (!is_identified(fuller)) return false;
  if (lead(fuller, simpler) < options.least_information_gain) return false;
  const double share = share_named(simpler.estimation, fuller.estimation, options);
  if (share < options.least_share) return false;
  if (simpler.validation.is_noise()) return fuller.validation.is_noise();
  return share_taken(simpler.validation, fuller.validation) >= options.least_validated_share;
}

bool is_ahead_of_limit(const Fit& general, const Fit& limited, const SelectionOptions& options) {
  return beyond_noise(general.residuals) <= options.general_gain * beyond_noise(limited.residuals);
}

bool is_near(const Fit& set, const Fit& best, const SelectionOptions& options) {
  return set.sum_of_squares <=
         most_of_noise(best) + options.largest_of_looks * beyond_noise(best.residuals);
}

bool is_near_noise(const Fit& look) {
  return look.sum_of_squares <= most_of_noise(look);
}

const Explanation* simplest(const std::vector<Explanation>& found, std::size_t effects,
                            const SelectionOptions& options) {
  const Explanation* best = nullptr;
  for (const Explanation& other : found) {
    if (other.fit.candidate.effects.size() != effects) continue;
    const bool is_simpler =
        best != nullptr && other.fit.candidate.values.size() < best->fit.candidate.values.size();
    if (best == nullptr || (is_simpler && !clears_bars(*best, other, options))) best = &other;
  }
  return best;
}

bool runs_away(const Explanation& explanation, const SelectionOptions& options) {
  return std::ranges::any_of(
      std::array{&explanation.estimation, &explanation.validation}, [&](const Misfit* misfit) {
        if (misfit->simulated == 0.0) return false;
        const auto& disturbance = misfit->disturbance;
        const double left =
            disturbance ? disturbance->estimated_relative() : misfit->unexplained_error();
        return left > options.largest_error_left;
      });
}

bool is_out_of_reach(const Explanation& nothing, const std::vector<Explanation>& singles,
                     const SelectionOptions& options) {
  return runs_away(nothing, options) &&
         nothing.estimation.unexplained_error() > options.runaway_error &&
         std::ranges::all_of(singles,
                             [&](const Explanation& single) { return runs_away(single, options); });
}

bool may_sets_explain(const Explanation& nothing, const std::vector<Explanation>& singles,
                      const SelectionOptions& options) {
  return !nothing.estimation.disturbance ||
         std::ranges::any_of(singles, [&](const Explanation& single) {
           return share_taken(nothing.estimation, single.estimation) >= options.least_share_ahead;
         });
}

std::vector<LimitOfEffect> limits_in(const Candidate& candidate,
                                     const std::vector<Hypothesis>& hypotheses) {
  std::vector<LimitOfEffect> found;
  for (std::size_t i = 0; i < candidate.effects.size(); ++i) {
    for (const Hypothesis* limit : limits_of(candidate.effects[i], hypotheses)) {
      if (!candidate.has_effect(limit->effect)) found.push_back({i, limit});
    }
  }
  return found;
}

}  // namespace flexarm::diagnose
