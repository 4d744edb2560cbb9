#include "diagnose/search/additions.hpp"

#include "diagnose/parallel.hpp"
#include "diagnose/search/hub_law_scan.hpp"
#include "diagnose/search/refit_projection.hpp"

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

/// Sizes of the change that a value makes, where its range does not bound them.
constexpr double kLeastSize = 0.25;
constexpr double kMostSize = 2.5;
/// values_near_base, of the size that a test finds.
constexpr double kNear = 0.05;
/// Starts of an effect at a place along the beam <= this.
constexpr std::size_t kMostPlaces = 3;
/// A change that is smaller than this part of the residuals is rounding.
constexpr double kLeastChange = 1e-6;

using Places = std::vector<double>;

/// The coordinate of an effect's place along the beam; 0 of one without.
double place_along_beam(const Hypothesis& hypothesis, const Places& places) {
  const auto place = hypothesis.place_parameter();
  return place ? places[*place] : 0.0;
}

/// A few values of a hypothesis' parameters, as places in their ranges: over these; of a single
/// one also near to where it does nothing, where the change is its direction; of many one size.
std::vector<Places> samples_of(const Hypothesis& hypothesis) {
  constexpr std::size_t kMany = 4;
  const std::vector<double> spread = {0.15, 0.5, 0.85};
  const std::vector<double> along_beam = {0.1, 0.3, 0.5, 0.7, 0.9};
  const std::size_t n = hypothesis.parameters.size();
  const auto sized = hypothesis.size_parameter();
  std::vector<Places> samples = {{}};
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<double> places = n > 1 && i == hypothesis.place_parameter() ? along_beam : spread;
    if (n >= kMany && i == sized) places = {0.5};
    const double neutral = hypothesis.parameters[i].neutral_coordinate().value_or(0.0);
    for (const double change : {0.004, -0.03, 0.03}) {
      const double place = neutral + change;
      if (n == 1 && neutral > 0.0 && place > 0.0 && place < 1.0) places.push_back(place);
    }
    std::vector<Places> longer;
    for (const Places& sample : samples) {
      for (const double place : places) {
        longer.push_back(sample);
        longer.back().push_back(place);
      }
    }
    samples = std::move(longer);
  }
  return samples;
}

/// Sizes that a change may have, the one at `places` being 1: those within the range of the
/// parameter that gives it, where that goes on both sides of the value at which it does nothing.
std::pair<double, double> sizes_of(const Hypothesis& hypothesis, const Places& places) {
  const auto sized = hypothesis.size_parameter();
  const double neutral = sized ? *hypothesis.parameters[*sized].neutral_coordinate() : 0.0;
  if (!(neutral > 0.0 && neutral < 1.0)) return {kLeastSize, kMostSize};
  const double change = places[*sized] - neutral;
  return std::minmax(-neutral / change, (1.0 - neutral) / change);
}

/// The place at which a parameter does `size` times what it does at `place`. From zero or
/// infinity an effect is proportional to the value or its reciprocal.
double place_at(const SearchedParameter& parameter, double place, double size) {
  switch (parameter.spacing) {
    case effects::Spacing::from_zero:
      return parameter.coordinate(size * parameter.value(place));
    case effects::Spacing::from_infinity:
      return parameter.coordinate(parameter.value(place) / size);
    case effects::Spacing::linear:
    case effects::Spacing::logarithmic:
      break;
  }
  const auto neutral = parameter.neutral_coordinate();
  return neutral ? *neutral + size * (place - *neutral) : place;
}

std::vector<double> values_at(const Hypothesis& hypothesis, Places places, double size) {
  if (const auto sized = hypothesis.size_parameter()) {
    double& place = places[*sized];
    place = std::clamp(place_at(hypothesis.parameters[*sized], place, size), 0.0, 1.0);
  }
  return effects::values_at(hypothesis.parameters, places);
}

/// Of a law of hub torque with several parameters: the best that a regression on the measured
/// motion finds beside the base. A few values would miss its period.
std::optional<Places> scanned_law(const Problem& problem, const Candidate& base,
                                  const Hypothesis& effect, const SelectionOptions& options,
                                  const ReportedWork& work) {
  if (effect.parameters.size() < 2) return std::nullopt;
  const auto law = scan_hub_law(problem, base.with(effect, effect.middle()),
                                {.evaluations = options.law_evaluations, .work = &work});
  if (!law) return std::nullopt;
  const Candidate& best = law->starts.front();
  return effects::coordinates_of(effect.parameters, best.values_of(best.effects.size() - 1));
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
  bool try_at(const Places& places) {
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
    Addition& best = best_at_[place_along_beam(effect_, places)];
    if (best.effect == nullptr || share > best.share) {
      best = {.effect = &effect_,
              .values = values_at(effect_, places, size),
              .values_near_base = values_at(effect_, places, kNear * size),
              .share = share};
    }
    return true;
  }

  /// Some effects of one parameter do nothing up to a threshold: an actuator saturates where a
  /// torque reaches its limit. Between neighbours of these places, one of which changes nothing,
  /// looks nearer to that one.
  void try_threshold(const std::vector<Places>& samples) {
    constexpr int kBisections = 5;
    std::map<double, bool> changes;
    for (const Places& places : samples) changes[places.front()] = try_at(places);
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

  /// The best, with the starts of the next ones along the beam; without an effect where none
  /// changed anything.
  Addition best() const {
    std::vector<Addition> sorted;
    for (const auto& [place, addition] : best_at_) sorted.push_back(addition);
    if (sorted.empty()) return {};
    std::ranges::stable_sort(sorted, std::ranges::greater{}, &Addition::share);
    Addition best = sorted.front();
    for (std::size_t i = 1; i < std::min(kMostPlaces, sorted.size()); ++i) {
      best.values_elsewhere.push_back(sorted[i].values);
    }
    return best;
  }

 private:
  const Problem& problem_;
  const Fit& base_;
  const RefitProjection& refitted_;
  const VectorXd& left_;
  const Hypothesis& effect_;
  const ReportedWork& work_;
  std::map<double, Addition> best_at_ = {};  // by the place along the beam
};

}  // namespace

std::vector<Addition> additions(const Problem& problem, const Fit& base,
                                const std::vector<const Hypothesis*>& others,
                                const SelectionOptions& options, const ReportedWork& work) {
  const RefitProjection refitted(base.jacobian);
  const VectorXd left = refitted(base.residuals);
  const auto of = [&](const Hypothesis& effect) -> Addition {
    if (base.candidate.has_effect(effect.effect)) return {};
    EffectScore score(problem, base, refitted, left, effect, work);
    if (const auto law = scanned_law(problem, base.candidate, effect, options, work)) {
      score.try_at(*law);
    } else if (effect.parameters.size() == 1) {
      score.try_threshold(samples_of(effect));
    } else {
      for (const Places& places : samples_of(effect)) score.try_at(places);
    }
    return score.best();
  };
  std::vector<Addition> made(others.size());
  in_parallel(others.size(), [&](std::size_t i) { made[i] = of(*others[i]); });
  std::erase_if(made, [](const Addition& addition) { return addition.effect == nullptr; });
  std::ranges::stable_sort(made, std::ranges::greater{}, &Addition::share);
  return made;
}

}  // namespace flexarm::diagnose
