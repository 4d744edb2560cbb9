#include "diagnose/search/scored_fit.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

namespace flexarm::diagnose {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

double price(const Hypothesis& effect, std::span<const Hypothesis> others) {
  const effects::Family family = effect.entry->family;
  const bool is_single = family == effects::Family::timing || family == effects::Family::sensor;
  const bool is_other_form =
      !is_single && std::ranges::any_of(others, [family](const Hypothesis& other) {
        return other.entry->family == family;
      });
  double probability = effects::probability_of(effect.entry->prior);
  if (is_other_form) {
    probability *= effects::probability_of(effects::Likely::possible);
  } else if (effect.is_family_certain) {
    probability /= effects::probability_of(effects::Likely::common);
  }
  return -2.0 * std::log(probability);
}

double place_deviation(const Hypothesis& effect, const Policy& policy) {
  const double usual = effect.entry->usual_deviation;
  if (usual == 0.0) return policy.place_deviation;
  const SearchedParameter& factor = effect.parameters.front();
  const double deviation = factor.coordinate(std::exp(usual)) - *factor.neutral_coordinate();
  return std::min(policy.place_deviation, deviation);
}

double price_of_value(const Hypothesis& effect, std::span<const double> values) {
  const double usual = effect.entry->usual_deviation;
  if (usual == 0.0) return 0.0;
  const double deviation = std::log(values.front()) / usual;
  return 2.0 * std::log1p(deviation * deviation);
}

double price(const Candidate& candidate, const MatrixXd& jacobian, const VectorXd& weights,
             const Policy& policy) {
  const std::span<const Hypothesis> effects = candidate.effects;
  double sum = 0.0;
  for (std::size_t i = 0; i < effects.size(); ++i) {
    sum += price(effects[i], effects.first(i)) + price_of_value(effects[i], candidate.values_of(i));
  }
  if (jacobian.cols() == 0) return sum;
  MatrixXd weighted = weights.cwiseSqrt().asDiagonal() * jacobian;
  Index column = std::ssize(candidate.nuisances);
  for (const Hypothesis& effect : effects) {
    const Index count = std::ssize(effect.parameters);
    weighted.middleCols(column, count) *= place_deviation(effect, policy);
    column += count;
  }
  MatrixXd information = weighted.transpose() * weighted;
  information.diagonal().array() += 1.0;
  const VectorXd pivots = information.ldlt().vectorD();
  return sum + pivots.array().max(1.0).log().sum();
}

ScoredFit scored_fit(const Likelihood& likelihood, const Candidate& start, const ReportedWork& work,
                     const MinimiseOptions& options, const ScoredFit* base) {
  ScoredFit made{minimise(likelihood, start, work, options, base)};
  if (!made.is_possible()) return made;
  made.score = made.cost + price(made.candidate, made.jacobian, likelihood.weights(made.lines),
                                 likelihood.problem().policy());
  return made;
}

}  // namespace flexarm::diagnose
