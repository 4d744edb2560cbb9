#include "diagnose/ranked/score_test.hpp"

#include "diagnose/parallel.hpp"
#include "diagnose/search/refit_projection.hpp"
#include "diagnose/search/start_places.hpp"

#include <algorithm>
#include <cmath>

namespace flexarm::diagnose {

using Eigen::VectorXd;

namespace {

/// A change of less than this part of the weighted lines is rounding.
constexpr double kRounding = 1e-6;

/// The score test of effects beside one fit.
class ScoreTest {
 public:
  ScoreTest(const Likelihood& likelihood, const RankedFit& base)
      : likelihood_(likelihood),
        base_(base),
        roots_(likelihood.weights(base.lines).cwiseSqrt()),
        refitted_(roots_.asDiagonal() * base.jacobian),
        left_(refitted_(roots_.cwiseProduct(base.lines))) {}

  /// The effect at a place in its range, at the size that the change there leads to. Its effect is
  /// null where that changes nothing, or has no arm.
  RankedAddition at(const Hypothesis& effect, const StartPlaces& places) const {
    const std::vector<double> values = effects::values_at(effect.parameters, places);
    const auto with =
        likelihood_.problem().residuals(base_.candidate.with(effect, values), likelihood_.runs());
    if (!with) return {};
    const VectorXd change =
        refitted_(roots_.cwiseProduct(likelihood_.lines(*with - base_.residuals)));
    const double squares = change.squaredNorm();
    if (!(squares > kRounding * kRounding * left_.squaredNorm())) return {};
    const auto [least, most] = sizes_of(effect, places);
    const double size = std::clamp(-change.dot(left_) / squares, least, most);
    const VectorXd predicted = (left_ + size * change).cwiseQuotient(roots_.cwiseMax(1e-150));
    const double parameters = static_cast<double>(effect.parameters.size());
    const double effect_price =
        -2.0 * std::log(effects::probability_of(effect.entry->prior)) +
        parameters * std::log1p(kPlaceDeviation * kPlaceDeviation * squares);
    return {&effect, values_at(effect, places, size),
            base_.score - base_.cost + likelihood_.cost(predicted) + effect_price};
  }

  /// The best of a few places.
  RankedAddition best_of(const Hypothesis& effect, const ReportedWork& work) const {
    RankedAddition best;
    for (const StartPlaces& places : samples_of(effect)) {
      work.go_on();
      RankedAddition tried = at(effect, places);
      if (tried.effect == nullptr) continue;
      if (best.effect == nullptr || tried.score < best.score) best = std::move(tried);
    }
    return best;
  }

 private:
  const Likelihood& likelihood_;
  const RankedFit& base_;
  VectorXd roots_;
  RefitProjection refitted_;
  VectorXd left_;
};

}  // namespace

std::vector<RankedAddition> ranked_additions(const Likelihood& likelihood, const RankedFit& base,
                                             const std::vector<const Hypothesis*>& others,
                                             std::size_t most, const ReportedWork& work) {
  const ScoreTest test(likelihood, base);
  std::vector<RankedAddition> tried(others.size());
  in_parallel(others.size(), [&](std::size_t i) {
    if (!base.candidate.has_effect(others[i]->effect)) tried[i] = test.best_of(*others[i], work);
  });
  std::erase_if(tried, [](const RankedAddition& one) { return one.effect == nullptr; });
  std::ranges::stable_sort(tried, {}, &RankedAddition::score);
  tried.resize(std::min(most, tried.size()));
  return tried;
}

}  // namespace flexarm::diagnose
