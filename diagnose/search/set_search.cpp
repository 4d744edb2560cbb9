#include "diagnose/search/set_search.hpp"

#include "diagnose/parallel.hpp"
#include "diagnose/search/additions.hpp"
#include "diagnose/search/admission.hpp"
#include "diagnose/search/misfit.hpp"
#include "diagnose/search/rivals.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <set>
#include <string>
#include <utility>

namespace flexarm::diagnose {

namespace {

std::vector<Candidate> best_of(const std::vector<Fit>& sets, std::size_t most) {
  std::vector<Candidate> best;
  for (std::size_t i = 0; i < std::min(most, sets.size()); ++i) best.push_back(sets[i].candidate);
  return best;
}

/// `limited` is `general` with a limit of one of its effects in place of that.
bool has_limit_in_place(const Candidate& limited, const Candidate& general) {
  if (!is_rival(limited, general)) return false;
  const auto own = std::ranges::find_if_not(
      general.effects, [&](const Hypothesis& effect) { return limited.has(effect); });
  return std::ranges::any_of(limited.effects, [&](const Hypothesis& effect) {
    return !general.has(effect) && own->contains(effect.effect);
  });
}

double least_beyond_noise(const std::vector<Fit>& sets) {
  return sets.empty() ? 0.0 : beyond_noise(sets.front().residuals);
}

}  // namespace

void SetSearch::begin(const Candidate& nothing, const std::vector<Candidate>& singles) {
  if (parts_.is_early_shorter()) {
    const Fit before = coarse_fit(parts_.early(), nothing, work_);
    early_sets_ = larger(parts_.early(), {before}, {.bases = 1}, singles);
  }
  coarse_sets_ = fitted(parts_.coarse(), starts_at(singles));
}

void SetSearch::refit() {
  early_sets_ =
      fitted(parts_.early(), starts_at(best_of(early_sets_, options_.early_growth.bases)));
  coarse_sets_ =
      fitted(parts_.coarse(), starts_at(best_of(coarse_sets_, options_.coarse_growth.bases)));
}

const std::vector<Fit>& SetSearch::grow(std::string_view what, double to) {
  const double from = work_.done();
  work_.tell(what, from);
  std::vector<Candidate> looks;
  if (parts_.is_early_shorter()) {
    early_sets_ = larger(parts_.early(), early_sets_, options_.early_growth);
    looks = best_of(early_sets_, options_.early_sets);
    work_.tell(what, from + 0.5 * (to - from));
  }
  const double before = least_beyond_noise(coarse_sets_);
  coarse_sets_ = larger(parts_.coarse(), coarse_sets_, options_.coarse_growth, std::move(looks));
  share_taken_ = before > 0.0 ? 1.0 - least_beyond_noise(coarse_sets_) / before : 0.0;
  work_.tell(what, to);
  return coarse_sets_;
}

double SetSearch::rms_over_noise() const {
  const std::vector<Fit>& sets = parts_.is_early_shorter() ? early_sets_ : coarse_sets_;
  if (sets.empty()) return 0.0;
  const Eigen::VectorXd& left = sets.front().residuals;
  return left.norm() / std::sqrt(static_cast<double>(left.size()));
}

std::vector<Fit> SetSearch::beside(const Candidate& base, std::size_t most) const {
  const auto larger_on = [&](const Problem& part, std::vector<Candidate> starts) {
    return larger(part, {coarse_fit(part, base, work_)},
                  {.bases = 1, .special = most, .general = 0}, std::move(starts));
  };
  std::vector<Candidate> looks;
  if (parts_.is_early_shorter()) looks = best_of(larger_on(parts_.early(), {}), most);
  return larger_on(parts_.coarse(), std::move(looks));
}

std::vector<Fit> SetSearch::larger(const Problem& part, const std::vector<Fit>& sets,
                                   const SetGrowth& growth, std::vector<Candidate> starts) const {
  std::vector<std::vector<Start>> found(std::min(growth.bases, sets.size()));
  in_parallel(found.size(),
              [&](std::size_t i) { found[i] = with_additions(part, sets[i], growth); });
  std::vector<Start> grown;
  for (std::vector<Start>& of_one : found) std::ranges::move(of_one, std::back_inserter(grown));
  std::ranges::stable_sort(grown, {}, &Start::expected);
  std::set<std::set<std::string>> known;
  const auto is_known = [&](const Candidate& start) {
    return !known.insert(start.labels()).second;
  };
  std::erase_if(starts, is_known);
  std::erase_if(grown, [&](const Start& start) { return is_known(start.candidate); });
  grown.resize(std::min(growth.fitted, grown.size()));
  std::vector<Start> all = starts_at(starts);
  std::ranges::move(grown, std::back_inserter(all));
  return fitted(part, all);
}

std::vector<SetSearch::Start> SetSearch::with_additions(const Problem& part, const Fit& set,
                                                        const SetGrowth& growth) const {
  std::vector<Start> made;
  const auto add = [&](const std::vector<const Hypothesis*>& effects, std::size_t most) {
    if (most == 0) return;
    std::vector<Addition> found = additions(part, set, effects, options_, work_);
    found.resize(std::min(most, found.size()));
    for (const Addition& addition : found) {
      made.push_back({.candidate = set.candidate.with(*addition.effect, addition.values),
                      .expected = (1.0 - addition.share) * set.sum_of_squares,
                      .near_base = set.candidate.with(*addition.effect, addition.values_near_base),
                      .left_by_base = set.sum_of_squares});
      for (const std::vector<double>& values : addition.values_elsewhere) {
        made.back().elsewhere.push_back(set.candidate.with(*addition.effect, values));
      }
    }
  };
  add(special_, growth.special);
  add(general_, growth.general);
  return made;
}

std::vector<SetSearch::Start> SetSearch::starts_at(const std::vector<Candidate>& candidates) {
  std::vector<Start> made;
  for (const Candidate& candidate : candidates) made.push_back({.candidate = candidate});
  return made;
}

std::vector<Fit> SetSearch::fitted(const Problem& part, const std::vector<Start>& starts) const {
  std::vector<Fit> fits(starts.size());
  in_parallel(starts.size(), [&](std::size_t i) {
    const Start& start = starts[i];
    fits[i] = coarse_fit(part, start.candidate, work_);
    const auto try_from = [&](const Candidate& other) {
      Fit again = coarse_fit(part, other, work_);
      if (again.sum_of_squares < fits[i].sum_of_squares) fits[i] = std::move(again);
    };
    std::ranges::for_each(start.elsewhere, try_from);
    if (fits[i].sum_of_squares > start.left_by_base) try_from(start.near_base);
  });
  std::ranges::stable_sort(fits, {}, &Fit::sum_of_squares);
  std::vector<Fit> sets;
  std::ranges::copy_if(fits, std::back_inserter(sets),
                       [&](const Fit& one) { return is_ahead_of_limits(one, fits); });
  return sets;
}

bool SetSearch::is_ahead_of_limits(const Fit& set, const std::vector<Fit>& sets) const {
  return std::ranges::none_of(sets, [&](const Fit& other) {
    return has_limit_in_place(other.candidate, set.candidate) &&
           !is_ahead_of_limit(set, other, options_);
  });
}

}  // namespace flexarm::diagnose
