#include "diagnose/search/set_fits.hpp"

#include "diagnose/search/admission.hpp"
#include "diagnose/search/set_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <limits>
#include <utility>

namespace flexarm::diagnose {

namespace {

/// Effects by themselves that are fitted before the others: where one leaves noise, these may be
/// out of the question.
constexpr std::size_t kFittedFirst = 4;

}  // namespace

Explanation SetFits::fitted(const Candidate& start) const {
  return explain(problem_, fit(problem_, start, {.work = &work_}));
}

std::vector<Fit> SetFits::add_with(const Candidate& base, std::vector<const Hypothesis*> others,
                                   std::string_view what, double to, const Tried& tried,
                                   std::vector<Explanation>& found) {
  std::erase_if(others, [&](const Hypothesis* other) { return base.has_effect(other->effect); });
  untried_ = labels_with(base, others);
  if (!base.effects.empty()) {
    others = scan_.promising(base, std::move(others), tried.looks, what);
  }
  if (others.empty()) return {};
  constexpr double kLooks = 0.6;
  const double middle = work_.done() + kLooks * (to - work_.done());
  std::vector<Fit> looks = scan_.first_looks(base, others, what, work_.done(), middle);
  if (!base.effects.empty()) {
    add_near(looks, tried.refitted, what, to, found);
    return {};
  }
  const std::span<const Fit> best(looks.begin(), std::min(looks.size(), tried.refitted));
  const std::size_t first = std::min(best.size(), kFittedFirst);
  std::vector<Fit> left_out = add_in_turn(best.first(first), best.subspan(first), what, to, found);
  left_out.insert(left_out.end(), looks.begin() + std::ssize(best), looks.end());
  return left_out;
}

void SetFits::add_beside(const Candidate& base, const std::vector<const Hypothesis*>& others,
                         std::string_view what, double to, const Tried& tried,
                         std::vector<Explanation>& found) {
  untried_ = labels_with(base, others);
  work_.tell(what, work_.done());
  const SetSearch search(parts_, others, {}, options_, work_);
  add_near(search.beside(base, tried.looks), tried.refitted, what, to, found);
}

void SetFits::add_near(std::vector<Fit> looks, std::size_t most, std::string_view what, double to,
                       std::vector<Explanation>& found) {
  if (looks.empty()) return;
  const Fit best = looks.front();
  const bool is_far = !is_near_noise(best);
  if (is_far) most = std::min(most, options_.far_sets_refitted);
  looks.resize(std::min(most, looks.size()));
  std::erase_if(looks, [&](const Fit& look) {
    const auto known = find_set(found, look.candidate);
    const bool is_of_no_use = known != found.end() && (is_far || known->leaves_noise());
    return is_of_no_use || !is_near(look, best, options_);
  });
  const auto has_more_parameters = [&](const Fit& look) {
    return look.candidate.values.size() > best.candidate.values.size();
  };
  const auto more = std::ranges::stable_partition(looks, std::not_fn(has_more_parameters));
  add_in_turn({looks.begin(), more.begin()}, more, what, to, found);
}

std::vector<Fit> SetFits::add_in_turn(std::span<const Fit> looks, std::span<const Fit> others,
                                      std::string_view what, double to,
                                      std::vector<Explanation>& found) {
  std::vector<Fit> out_of_reach;
  try {
    out_of_reach = add_looks(looks, what, to, found);
  } catch (const Cancelled&) {
    for (const Fit& look : others) leave_untried({look.candidate.label()});
    throw;
  }
  std::ranges::move(add_looks(others, what, to, found), std::back_inserter(out_of_reach));
  return out_of_reach;
}

double SetFits::highest_of_use(const Candidate& set, const std::vector<Explanation>& found) const {
  constexpr double kDecisive = 4.0;  // times as much: odds of e^20
  const auto best = std::ranges::find_if(found, [&](const Explanation& other) {
    return other.fit.candidate.effects.size() == set.effects.size();
  });
  constexpr double kAny = std::numeric_limits<double>::infinity();
  if (best == found.end()) return kAny;
  const bool leaves_noise = best->leaves_noise();
  // Larger sets begin with effects that fit badly by themselves; and a disturbance is not judged by
  // a sum of squares.
  if (!leaves_noise && (set.effects.size() == 1 || best->estimation.disturbance)) return kAny;
  const double n = std::max(2.0, best->estimation.independent);
  const double more = static_cast<double>(set.values.size()) -
                      static_cast<double>(best->fit.candidate.values.size());
  const double least = best->fit.sum_of_squares;
  const double worse = kDecisive * options_.least_information_gain - more * std::log(n);
  // The scale is free where the best leaves more than noise (information_gain).
  return leaves_noise ? least + worse : least * std::exp(worse / n);
}

std::vector<Fit> SetFits::add_looks(std::span<const Fit> looks, std::string_view what, double to,
                                    std::vector<Explanation>& found) {
  std::vector<std::string> sets;
  std::vector<Start> starts;
  for (const Fit& look : looks) {
    sets.push_back(look.candidate.label());
    starts.push_back({look.candidate, highest_of_use(look.candidate, found)});
  }
  std::vector<Fit> out_of_reach;
  for (const std::size_t i :
       add_all(std::move(sets), what, to, found, [&](std::size_t k) { return starts[k]; })) {
    out_of_reach.push_back(looks[i]);
  }
  return out_of_reach;
}

std::vector<std::size_t> SetFits::add_all(
    std::vector<std::string> sets, std::string_view what, double to,
    std::vector<Explanation>& found,
    const std::function<std::optional<Start>(std::size_t)>& start) {
  std::vector<std::optional<Explanation>> made(sets.size(), Explanation{});
  untried_ = std::move(sets);
  try {
    work_.in_parallel(made.size(), what, work_.done(), to, [&](std::size_t i) {
      std::optional<Explanation> of_set;
      if (const auto from = start(i)) {
        Fit best = fit(problem_, from->candidate,
                       {.highest_minimum = from->highest_minimum, .work = &work_});
        if (!best.is_out_of_reach) {
          of_set = without_unidentified(explain(problem_, std::move(best)));
        }
      }
      made[i] = std::move(of_set);
    });
  } catch (const Cancelled&) {
    keep(std::move(made), found);
    throw;
  }
  std::vector<std::size_t> of_no_use;
  for (std::size_t i = 0; i < made.size(); ++i) {
    if (!made[i]) of_no_use.push_back(i);
  }
  keep(std::move(made), found);
  return of_no_use;
}

void SetFits::leave_untried(const std::vector<std::string>& sets) {
  untried_.insert(untried_.end(), sets.begin(), sets.end());
}

/// An effect that the others do not need may have led the fit to their values.
Explanation SetFits::without_unidentified(Explanation set) const {
  while (set.fit.candidate.effects.size() > 1) {
    const auto unidentified = unidentified_effect(set);
    if (!unidentified) break;
    set = fitted(set.fit.candidate.without(*unidentified));
  }
  return set;
}

/// `made` are of the sets of `untried_`: empty where no fit was needed, without residuals where
/// none was made.
void SetFits::keep(std::vector<std::optional<Explanation>> made, std::vector<Explanation>& found) {
  std::vector<std::string> untried;
  for (std::size_t i = 0; i < made.size(); ++i) {
    if (!made[i]) continue;
    Explanation& one = *made[i];
    if (one.fit.residuals.size() == 0) {
      untried.push_back(untried_[i]);
      continue;
    }
    if (!is_identified(one)) continue;
    const auto same = find_set(found, one.fit.candidate);
    if (same == found.end()) {
      found.push_back(std::move(one));
    } else if (one.fit.sum_of_squares < same->fit.sum_of_squares) {
      *same = std::move(one);
    }
  }
  untried_ = std::move(untried);
  sort_by_fit(found);
}

std::vector<std::string> labels_with(const Candidate& base,
                                     const std::vector<const Hypothesis*>& others) {
  std::vector<std::string> labels;
  for (const Hypothesis* other : others) {
    if (!base.has_effect(other->effect)) labels.push_back(base.with(*other, {}).label());
  }
  return labels;
}

}  // namespace flexarm::diagnose
