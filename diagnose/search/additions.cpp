#include "diagnose/search/additions.hpp"

#include "diagnose/parallel.hpp"
#include "diagnose/search/hub_law_scan.hpp"
#include "diagnose/search/refit_projection.hpp"
#include "diagnose/search/start_places.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iterator>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

namespace flexarm::diagnose {

namespace {

using Eigen::VectorXd;

/// values_near_base, of the size that a test finds.
constexpr double kNear = 0.05;
/// Starts of an effect at a place along the beam <= this.
constexpr std::size_t kMostPlaces = 3;
/// A change that is smaller than this part of the residuals is rounding.
constexpr double kLeastChange = 1e-6;

/// Of a law of hub torque with several parameters: the best that a regression on the measured
/// motion finds beside the base. A few values would miss its period.
std::optional<StartPlaces> scanned_law(const Problem& problem, const Fit& base,
                                       const Hypothesis& effect, const SelectionOptions& options,
                                       const ReportedWork& work) {
  if (effect.parameters.size() < 2) return std::nullopt;
  const auto law = scan_hub_law(
      problem, base.candidate.with(effect, effect.middle()),
      {.evaluations = options.law_evaluations, .base_residuals = &base.residuals, .work = &work});
  if (!law) return std::nullopt;
  const Candidate& best = law->starts.front();
  return places_of(effect, best.values_of(best.effects.size() - 1));
}

/// The score test of one effect beside a fit, value by value.
class EffectScore {
 public:
  /// `refitted` is of the fit's Jacobian, `left` its residuals without their parts along that. The
  /// references must outlive the object.
  EffectScore(const Problem& problem, const Fit& base, const RefitProjection& refitted,
              const VectorXd& left, const Hypothesis& effect, const ReportedWork& work)
      : problem_(problem),
        base_(base),
        refitted_(refitted),
        left_(left),
        effect_(effect),
        work_(work) {}

  /// Returns whether the effect changes residuals there.
  bool try_at(const StartPlaces& places) {
    work_.go_on();
    const auto with = problem_.residuals(
        base_.candidate.with(effect_, effects::values_at(effect_.parameters, places)),
        problem_.estimation_runs());
    if (!with) return true;
    const VectorXd change = refitted_(base_.residuals - *with);
    const double squares = change.squaredNorm();
    if (!(squares > kLeastChange * kLeastChange * base_.sum_of_squares)) return false;
    const auto [least, most] = sizes_of(effect_, places);
    const double along = change.dot(left_);
    const double size = std::clamp(along / squares, least, most);
    const double share = size * (2.0 * along - size * squares) / base_.sum_of_squares;
    const bool has_its_sign = along > 0.0 || least < 0.0;
    Tried& tried = best_at_[place_along_beam(effect_, places)];
    if (has_its_sign) {
      tried.potential = std::max(tried.potential, along * along / squares / base_.sum_of_squares);
    }
    if (tried.addition.effect == nullptr || share > tried.addition.share) {
      tried.size = size;
      tried.addition = {.effect = &effect_,
                        .values = values_at(effect_, places, size),
                        .values_near_base = values_at(effect_, places, kNear * size),
                        .share = share};
    }
    return true;
  }

  /// Some effects of one parameter do nothing up to a threshold: an actuator saturates where a
  /// torque reaches its limit. Between neighbours of these places, one of which changes nothing,
  /// looks nearer to that one.
  void try_threshold(const std::vector<StartPlaces>& samples) {
    constexpr int kBisections = 5;
    std::map<double, bool> changes;
    const auto try_each = [&](double place) { changes[place] = try_at({place}); };
    for (const StartPlaces& places : samples) try_each(places.front());
    const auto is_idle = [](const auto& tried) { return !tried.second; };
    if (std::ranges::none_of(changes, is_idle)) return;
    std::ranges::for_each(kSpreadPlaces, try_each);
    const auto edge = std::ranges::adjacent_find(
        changes, [](const auto& one, const auto& next) { return one.second != next.second; });
    if (edge == changes.end()) return;
    double idle = edge->first;
    double active = std::next(edge)->first;
    if (edge->second) std::swap(idle, active);
    for (int i = 0; i < kBisections; ++i) {
      const double between = std::midpoint(idle, active);
      (try_at({between}) ? active : idle) = between;
    }
  }

  /// Part of the sum of squares that it explains at whatever size, to first order.
  double potential() const {
    double most = 0.0;
    for (const auto& [place, tried] : best_at_) most = std::max(most, tried.potential);
    return most;
  }

  /// Tries the sizes that the first ones lead to, at the best places along the beam: a change is
  /// not quite proportional to its size.
  void refine() {
    constexpr int kSizes = 2;
    constexpr double kSameSize = 0.1;
    for (const double place : best_places()) {
      const Tried& best = best_at_[place];
      for (int i = 0; i < kSizes && std::abs(best.size - 1.0) > kSameSize; ++i) {
        try_at(places_of(effect_, best.addition.values));
      }
    }
  }

  /// The best, with the starts of the next ones along the beam; without an effect where none
  /// changed anything.
  Addition best() const {
    const std::vector<double> places = best_places();
    if (places.empty()) return {};
    Addition best = best_at_.at(places.front()).addition;
    for (std::size_t i = 1; i < places.size(); ++i) {
      best.values_elsewhere.push_back(best_at_.at(places[i]).addition.values);
    }
    return best;
  }

 private:
  /// At one place along the beam.
  struct Tried {
    double potential = 0.0;
    double size = 0.0;  ///< of `addition`, relative to where it was looked at
    Addition addition = {};
  };

  /// <= kMostPlaces along the beam, the best first.
  std::vector<double> best_places() const {
    std::vector<double> places;
    for (const auto& [place, tried] : best_at_) places.push_back(place);
    std::ranges::stable_sort(places, std::ranges::greater{},
                             [&](double place) { return best_at_.at(place).addition.share; });
    places.resize(std::min(kMostPlaces, places.size()));
    return places;
  }

  const Problem& problem_;
  const Fit& base_;
  const RefitProjection& refitted_;
  const VectorXd& left_;
  const Hypothesis& effect_;
  const ReportedWork& work_;
  std::map<double, Tried> best_at_ = {};  // by the place along the beam
};

}  // namespace

std::vector<Addition> additions(const Problem& problem, const Fit& base,
                                std::vector<const Hypothesis*> others, std::size_t most,
                                const SelectionOptions& options, const ReportedWork& work) {
  constexpr std::size_t kRefined = 2;  // times as many as are asked for
  std::erase_if(others,
                [&](const Hypothesis* other) { return base.candidate.has_effect(other->effect); });
  const RefitProjection refitted(base.jacobian);
  const VectorXd left = refitted(base.residuals);
  std::vector<EffectScore> scores;
  for (const Hypothesis* other : others) {
    scores.emplace_back(problem, base, refitted, left, *other, work);
  }
  in_parallel(scores.size(), [&](std::size_t i) {
    const Hypothesis& effect = *others[i];
    if (const auto law = scanned_law(problem, base, effect, options, work)) {
      scores[i].try_at(*law);
    } else if (effect.parameters.size() == 1) {
      scores[i].try_threshold(samples_of(effect));
    } else {
      for (const StartPlaces& places : samples_of(effect)) scores[i].try_at(places);
    }
  });
  std::vector<EffectScore*> ranked;
  for (EffectScore& score : scores) ranked.push_back(&score);
  std::ranges::stable_sort(ranked, std::ranges::greater{}, &EffectScore::potential);
  ranked.resize(std::min(ranked.size(), kRefined * std::min(most, ranked.size())));
  in_parallel(ranked.size(), [&](std::size_t i) { ranked[i]->refine(); });
  std::vector<Addition> made;
  for (const EffectScore* score : ranked) {
    if (Addition best = score->best(); best.effect != nullptr) made.push_back(std::move(best));
  }
  std::ranges::stable_sort(made, std::ranges::greater{}, &Addition::share);
  made.resize(std::min(most, made.size()));
  return made;
}

}  // namespace flexarm::diagnose
