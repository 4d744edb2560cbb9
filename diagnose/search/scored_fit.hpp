#pragma once

#include "diagnose/search/candidate.hpp"
#include "diagnose/search/likelihood.hpp"
#include "diagnose/search/minimise.hpp"
#include "diagnose/search/reported_work.hpp"

#include <Eigen/Core>

#include <limits>
#include <span>

namespace flexarm::diagnose {

/// A candidate at the maximum of its likelihood on some runs: its cost is -2 ln L.
struct ScoredFit : Minimum {
  double score = std::numeric_limits<double>::infinity();  ///< cost and price
};

/// Returns the price of an effect beside others, -2 ln p, p the probability that an arm has it
/// before any data (effects::Entry::prior). Effects of a family are forms of one cause: that a
/// cause has another form is `possible` (effects::Likely). Delays, lags and effects on single
/// sensors are causes of their own.
double price(const Hypothesis& effect, std::span<const Hypothesis> others);

/// Returns the standard deviation of the prior of a place of an effect: that of the policy, and for
/// a factor of a number of the arm file that by which such numbers usually are off
/// (effects::Entry::usual_deviation).
double place_deviation(const Hypothesis& effect, const Policy& policy);

/// Returns the price of the value of an effect that is such a factor,
///
///     2 ln(1 + (ln(value)/s)^2),
///
/// s its usual deviation: the tails of a Cauchy distribution, as a few numbers are wrong by far. 0
/// for other effects.
double price_of_value(const Hypothesis& effect, std::span<const double> values);

/// Returns the price of a fitted candidate beside its -2 ln L,
///
///     sum over effects of (-2 ln p + price_of_value)  +  ln det(I + P J^T W J),
///
/// P the prior variance of nuisances, 1, and of places, place_deviation^2, W the weights of the
/// lines: the Laplace approximation of the evidence. A parameter that the data determine to a
/// thousandth of its range costs 2 ln(0.3/0.001) = 11.4.
double price(const Candidate& candidate, const Eigen::MatrixXd& jacobian,
             const Eigen::VectorXd& weights, const Policy& policy);

/// Returns the fit nearest to `start` (minimise.hpp), with its score.
ScoredFit scored_fit(const Likelihood& likelihood, const Candidate& start, const ReportedWork& work,
                     const MinimiseOptions& options = {}, const ScoredFit* base = nullptr);

}  // namespace flexarm::diagnose
