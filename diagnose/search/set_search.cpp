#include "diagnose/search/set_search.hpp"

#include "diagnose/parallel.hpp"
#include "diagnose/search/additions.hpp"

#include <algorithm>
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

}  // namespace

void SetSearch::begin(const Candidate& nothing, const std::vector<Candidate>& singles) {
  if (parts_.is_early_shorter()) {
    const Fit before = coarse_fit(parts_.early(), nothing, work_);
    early_sets_ = larger(parts_.early(), {before}, 1, effects_.size(), singles);
  }
  coarse_sets_ = fitted(parts_.coarse(), singles);
}

const std::vector<Fit>& SetSearch::grow(std::string_view what, double to) {
  const double from = work_.done();
  work_.tell(what, from);
  std::vector<Candidate> looks;
  if (parts_.is_early_shorter()) {
    early_sets_ =
        larger(parts_.early(), early_sets_, options_.early_bases, options_.early_additions);
    looks = best_of(early_sets_, options_.early_sets);
    work_.tell(what, from + 0.5 * (to - from));
  }
  coarse_sets_ = larger(parts_.coarse(), coarse_sets_, options_.coarse_bases,
                        options_.coarse_additions, std::move(looks));
  work_.tell(what, to);
  return coarse_sets_;
}

std::vector<Fit> SetSearch::beside(const Candidate& base, std::size_t most) const {
  const auto larger_on = [&](const Problem& part, std::vector<Candidate> starts) {
    return larger(part, {coarse_fit(part, base, work_)}, 1, most, std::move(starts));
  };
  std::vector<Candidate> looks;
  if (parts_.is_early_shorter()) looks = best_of(larger_on(parts_.early(), {}), most);
  return larger_on(parts_.coarse(), std::move(looks));
}

std::vector<Fit> SetSearch::larger(const Problem& part, const std::vector<Fit>& sets,
                                   std::size_t bases, std::size_t most,
                                   std::vector<Candidate> starts) const {
  std::vector<std::vector<Addition>> found(std::min(bases, sets.size()));
  in_parallel(found.size(),
              [&](std::size_t i) { found[i] = additions(part, sets[i], effects_, work_); });
  std::set<std::set<std::string>> known;
  for (const Candidate& start : starts) known.insert(start.labels());
  for (std::size_t i = 0; i < found.size(); ++i) {
    found[i].resize(std::min(most, found[i].size()));
    for (const Addition& addition : found[i]) {
      Candidate made = sets[i].candidate.with(*addition.effect, addition.values);
      if (known.insert(made.labels()).second) starts.push_back(std::move(made));
    }
  }
  return fitted(part, starts);
}

std::vector<Fit> SetSearch::fitted(const Problem& part,
                                   const std::vector<Candidate>& starts) const {
  std::vector<Fit> fits(starts.size());
  in_parallel(starts.size(), [&](std::size_t i) { fits[i] = coarse_fit(part, starts[i], work_); });
  std::ranges::stable_sort(fits, {}, &Fit::sum_of_squares);
  std::set<std::set<std::string>> known;
  std::vector<Fit> sets;
  std::ranges::copy_if(std::make_move_iterator(fits.begin()), std::make_move_iterator(fits.end()),
                       std::back_inserter(sets),
                       [&](const Fit& one) { return known.insert(one.candidate.labels()).second; });
  return sets;
}

}  // namespace flexarm::diagnose
