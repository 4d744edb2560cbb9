#pragma once

#include "diagnose/search/candidate.hpp"
#include "diagnose/search/likelihood.hpp"
#include "diagnose/search/reported_work.hpp"

#include <Eigen/Core>

#include <limits>
#include <span>

namespace flexarm::diagnose {

/// A candidate at the maximum of its likelihood on some runs.
struct ScoredFit {
  Candidate candidate = {};
  Eigen::VectorXd lines = {};                              ///< Likelihood::lines_of
  Eigen::MatrixXd jacobian = {};                           ///< lines by Candidate::coordinates
  double cost = std::numeric_limits<double>::infinity();   ///< -2 ln L
  double score = std::numeric_limits<double>::infinity();  ///< cost and price
  bool converged = false;

  bool is_possible() const { return cost < std::numeric_limits<double>::infinity(); }
};

/// Standard deviation of the prior of a place in the range of a parameter.
inline constexpr double kPlaceDeviation = 0.3;

/// Returns the price of an effect beside others, -2 ln p, p the probability that an arm has it
/// before any data (effects::Entry::prior). Effects of a family are forms of one cause: that a
/// cause has another form is `possible` (effects::Likely). Delays, lags and effects on single
/// sensors are causes of their own.
double price(const Hypothesis& effect, std::span<const Hypothesis> others);

/// Returns the standard deviation of the prior of a place of an effect: kPlaceDeviation, and for a
/// factor of a number of the arm file that by which such numbers usually are off
/// (effects::Entry::usual_deviation).
double place_deviation(const Hypothesis& effect);

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
             const Eigen::VectorXd& weights);

struct ScoredFitOptions {
  int most_steps = 30;
  /// Converged where a step is expected to lower -2 ln L by less than this.
  double tolerance = 0.05;
  /// Ends with secants in the place of derivatives, as few of which as possible are computed.
  bool takes_secants = false;
};

/// Returns the fit nearest to `start`: iteratively reweighted least squares with the damping of
/// [Marquardt1963] and secant updates of the derivatives [Broyden1965], places from 0 to 1. It
/// begins with the derivatives that `base` has of the same effects. Not `is_possible` where the
/// start cannot be computed. Throws Cancelled where the work is cancelled.
ScoredFit scored_fit(const Likelihood& likelihood, const Candidate& start, const ReportedWork& work,
                     const ScoredFitOptions& options = {}, const ScoredFit* base = nullptr);

}  // namespace flexarm::diagnose
