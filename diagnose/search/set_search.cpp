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

/// Of fits to the early part, which are sorted, those that the coarse part is to be asked for:
/// where one leaves noise, those that do.
std::vector<Candidate> looks_of(const std::vector<Fit>& early, std::size_t most) {
  const auto noise = std::ranges::find_if_not(early, is_near_noise) - early.begin();
  return best_of(early, noise > 0 ? std::min(most, static_cast<std::size_t>(noise)) : most);
}

double least_beyond_noise(const std::vector<Fit>& sets) {
  return sets.empty() ? 0.0 : beyond_noise(sets.front().residuals);
}

}  // namespace

void SetSearch::begin(const Candidate& nothing, const std::vector<Candidate>& singles) {
  if (parts_.is_early_shorter()) {
    const Fit before = coarse_fit(parts_.early(), nothing, work_);
    early_sets_ =
        larger(parts_.early(), {before}, {.bases = 1, .fitted = options_.early_growth.fitted},
               fitted(parts_.early(), singles));
  }
  coarse_sets_ = fitted(parts_.coarse(), singles);
}

void SetSearch::refit() {
  early_sets_ = fitted(parts_.early(), best_of(early_sets_, options_.early_growth.bases));
  coarse_sets_ = fitted(parts_.coarse(), best_of(coarse_sets_, options_.coarse_growth.bases));
}

const std::vector<Fit>& SetSearch::grow(std::string_view what, double to) {
  const double from = work_.done();
  work_.tell(what, from);
  std::vector<Candidate> looks;
  if (parts_.is_early_shorter()) {
    early_sets_ = larger(parts_.early(), early_sets_, options_.early_growth);
    looks = looks_of(early_sets_, options_.early_sets);
    work_.tell(what, from + 0.5 * (to - from));
  }
  const double before = least_beyond_noise(coarse_sets_);
  coarse_sets_ = larger_on_coarse(looks, coarse_sets_, options_.coarse_growth);
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
  const SetGrowth growth{.bases = 1, .special = most, .general = 0};
  std::vector<Candidate> looks;
  if (parts_.is_early_shorter()) {
    const Fit early = coarse_fit(parts_.early(), base, work_);
    looks = looks_of(larger(parts_.early(), {early}, growth), most);
  }
  return larger_on_coarse(looks, {coarse_fit(parts_.coarse(), base, work_)}, growth);
}

std::vector<Fit> SetSearch::larger_on_coarse(const std::vector<Candidate>& looks,
                                             const std::vector<Fit>& sets,
                                             const SetGrowth& growth) const {
  std::vector<Fit> looked = fitted(parts_.coarse(), looks);
  if (!looked.empty() && is_near_noise(looked.front())) return looked;
  return larger(parts_.coarse(), sets, growth, std::move(looked));
}

std::vector<Fit> SetSearch::larger(const Problem& part, const std::vector<Fit>& sets,
                                   const SetGrowth& growth, std::vector<Fit> known) const {
  std::vector<std::vector<Start>> found(std::min(growth.bases, sets.size()));
  in_parallel(found.size(),
              [&](std::size_t i) { found[i] = with_additions(part, sets[i], growth); });
  std::vector<Start> grown;
  for (std::vector<Start>& of_one : found) std::ranges::move(of_one, std::back_inserter(grown));
  std::ranges::stable_sort(grown, {}, &Start::expected);
  std::set<std::set<std::string>> labels;
  for (const Fit& set : known) labels.insert(set.candidate.labels());
  std::erase_if(
      grown, [&](const Start& start) { return !labels.insert(start.candidate.labels()).second; });
  grown.resize(std::min(growth.fitted, grown.size()));
  std::ranges::move(fits(part, grown), std::back_inserter(known));
  return ahead_of_limits(std::move(known));
}

std::vector<SetSearch::Start> SetSearch::with_additions(const Problem& part, const Fit& set,
                                                        const SetGrowth& growth) const {
  std::vector<Start> made;
  const auto add = [&](const std::vector<const Hypothesis*>& effects, std::size_t most) {
    if (most == 0) return;
    for (const Addition& addition : additions(part, set, effects, most, options_, work_)) {
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

std::vector<Fit> SetSearch::fitted(const Problem& part,
                                   const std::vector<Candidate>& candidates) const {
  std::vector<Start> starts;
  std::set<std::set<std::string>> labels;
  for (const Candidate& candidate : candidates) {
    if (labels.insert(candidate.labels()).second) starts.push_back({.candidate = candidate});
  }
  return ahead_of_limits(fits(part, starts));
}

std::vector<Fit> SetSearch::fits(const Problem& part, const std::vector<Start>& starts) const {
  std::vector<Fit> made(starts.size());
  in_parallel(starts.size(), [&](std::size_t i) {
    const Start& start = starts[i];
    made[i] = coarse_fit(part, start.candidate, work_);
    const auto try_from = [&](const Candidate& other) {
      Fit again = coarse_fit(part, other, work_);
      if (again.sum_of_squares < made[i].sum_of_squares) made[i] = std::move(again);
    };
    std::ranges::for_each(start.elsewhere, try_from);
    if (made[i].sum_of_squares > start.left_by_base) try_from(start.near_base);
  });
  return made;
}

std::vector<Fit> SetSearch::ahead_of_limits(std::vector<Fit> sets) const {
  std::ranges::stable_sort(sets, {}, &Fit::sum_of_squares);
  std::vector<Fit> ahead;
  std::ranges::copy_if(sets, std::back_inserter(ahead),
                       [&](const Fit& one) { return is_ahead_of_limits(one, sets); });
  return ahead;
}

bool SetSearch::is_ahead_of_limits(const Fit& set, const std::vector<Fit>& sets) const {
  return std::ranges::none_of(sets, [&](const Fit& other) {
    return has_limit_in_place(other.candidate, set.candidate) &&
           !is_ahead_of_limit(set, other, options_);
  });
}

}  // namespace flexarm::diagnose
