#include "diagnose/search/selection.hpp"

#include "diagnose/parallel.hpp"
#include "diagnose/search/admission.hpp"
#include "diagnose/search/general_effects.hpp"
#include "diagnose/search/parameter_errors.hpp"
#include "diagnose/search/problem_revision.hpp"
#include "diagnose/search/rivals.hpp"
#include "diagnose/search/set_fits.hpp"
#include "diagnose/search/set_replacements.hpp"
#include "diagnose/search/set_search.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace flexarm::diagnose {

namespace {

/// Fraction of the work that is done with the effects by themselves.
constexpr double kSinglesDone = 0.4;

/// What the sets are, in their order: a look at one may add another.
std::vector<Candidate> candidates_of(const std::vector<Explanation>& sets) {
  std::vector<Candidate> candidates;
  for (const Explanation& set : sets) candidates.push_back(set.fit.candidate);
  return candidates;
}

constexpr std::string_view kNothing = "the arm as filed";
constexpr std::string_view kSingles = "effects one by one";
constexpr std::string_view kSets = "sets of effects";
constexpr std::string_view kExchanged = "exchanged effects";

class Search {
 public:
  Search(const Problem& problem, const std::vector<Hypothesis>& hypotheses,
         const SelectionOptions& options, const DiagnosisProgress& progress)
      : problem_(problem.until(options.deadline)),
        hypotheses_(hypotheses),
        options_(options),
        work_(progress, options.deadline),
        fits_(problem_, options, work_),
        general_(hypotheses, options, fits_),
        replacements_(hypotheses, options, fits_, general_),
        revision_(problem_, options, fits_, work_) {}

  Selection run() {
    Selection made{.problem = problem_, .hypotheses = hypotheses_.size()};
    try {
      search(made);
    } catch (const Cancelled&) {
      if (!work_.is_out_of_time()) throw;
      end_search(made);
    }
    made.rivals = indistinguishable_sets(made, posterior_of(made, options_));
    std::ranges::stable_sort(made.ruled_out, std::ranges::greater{}, &RuledOut::share);
    made.problem = problem_.until({});
    return made;
  }

 private:
  void search(Selection& made) {
    work_.tell(kNothing, 0.0);
    made.nothing = fits_.fitted(fits_.scan().first_look(problem_.as_filed()).candidate);
    made.chosen = made.nothing;
    revision_.see_noise(made);
    if (!is_enough(made)) revision_.colour_noise_of_nothing(made);
    if (!is_enough(made)) try_singles(made);
    if (!made.singles.empty() && !is_out_of_reach(made.nothing, made.singles, options_)) {
      extend(made);
      generalise(made);
      if (!is_enough(made)) try_in_coloured_noise(made, made.chosen);
      exchange_for_general(made);
    }
    if (!is_enough(made)) revision_.colour_noise_at_last(made);
    merge(made);
    leave_out_unnamed(made);
  }

  /// The best so far, where the time is over: of singles one that needs no further fits. General
  /// ones have limits to be compared with; what leaves no noise may stand for one not tried yet.
  void end_search(Selection& made) {
    made.end = SearchEnd{std::string(work_.what()), fits_.untried()};
    work_.lift_deadline();
    problem_ = problem_.until({});
    if (made.nothing.fit.residuals.size() == 0) {
      made.end->untried = labels_with({}, general_.others());
      const Problem in_time = problem_.until(options_.last);
      made.nothing = explain(in_time, fit(in_time, in_time.as_filed(), {.most_steps = 0}));
      made.chosen = made.nothing;
    }
    if (made.chosen.fit.candidate.effects.empty()) {
      const auto best = std::ranges::find_if(made.singles, [&](const Explanation& single) {
        return !general_.has(single.fit.candidate.effects.front()) &&
               may_be_named(single, made.nothing);
      });
      if (best != made.singles.end() && !general_.may_be_behind(*best)) made.chosen = *best;
    }
    leave_out_unnamed(made);
  }

  /// Effects by themselves. Those that have another as a limit come after it.
  void try_singles(Selection& made) {
    const Candidate& none = made.nothing.fit.candidate;
    fits_.lengthen_parts(made.nothing);
    const std::vector<Fit> left_out =
        fits_.add_with(none, general_.others(), kSingles, 0.7 * kSinglesDone,
                       options_.single_effects, made.singles);
    const Fit before = fits_.scan().coarse_look(none);
    for (const Fit& look : left_out) {
      made.ruled_out.push_back({look.candidate.label(), explained_share(before, look)});
    }
    refit_nothing(made);
    revision_.see_noise(made);
    revision_.colour_noise_beside_singles(made);
    if (is_enough(made)) return;
    general_.try_by_themselves(made, kSingles, kSinglesDone);
    revision_.see_noise(made);
    const bool is_general_best =
        !made.singles.empty() && general_.has(made.singles.front().fit.candidate.effects.front());
    if (is_general_best) revision_.colour_noise_beside_singles(made);
  }

  /// The arm's uncertain numbers by themselves, from where the best single has them: what these
  /// explain needs no effect.
  void refit_nothing(Selection& made) const {
    if (problem_.as_filed().nuisances.empty() || made.singles.empty()) return;
    Explanation again = fits_.fitted(made.singles.front().fit.candidate.without(0));
    const double before = made.nothing.fit.sum_of_squares;
    if (again.fit.sum_of_squares < before) made.nothing = made.chosen = std::move(again);
  }

  /// The residual is noise, or what is not is about the error of a simulation.
  bool is_enough(const Selection& made) const {
    if (made.chosen.leaves_noise()) return true;
    const Misfit& left = made.chosen.estimation;
    return left.nuisance_excess() == 0.0 && left.simulation_excess == 0.0 &&
           left.unexplained_error() <= left.simulated * options_.negligible_error;
  }

  bool is_admitted(Selection& made, const Explanation& fuller, const Explanation& simpler) const {
    return may_be_named(fuller, simpler) && replacements_.clears_limits(made, fuller);
  }

  /// Beyond clears_bars, each parameter is identified by the standard errors that are stated.
  bool may_be_named(const Explanation& fuller, const Explanation& simpler) const {
    return clears_bars(fuller, simpler, options_) &&
           !unidentified_effect(fuller.fit.candidate, stated_errors(fuller));
  }

  Eigen::VectorXd stated_errors(const Explanation& explanation) const {
    return coordinate_errors(problem_, explanation, options_.further_modes);
  }

  /// The best admitted single over none, or one with fewer parameters that fits as well by delta
  /// BIC; `nothing` where there is none.
  Explanation best_single(Selection& made) const {
    Explanation best = made.nothing;
    for (const Candidate& candidate : candidates_of(made.singles)) {
      const auto single = find_set(made.singles, candidate);
      const bool is_first = best.fit.candidate.effects.empty();
      const bool is_simpler = candidate.values.size() < best.fit.candidate.values.size() &&
                              lead(best, *single) < options_.least_information_gain;
      if (!(is_first || is_simpler)) continue;
      if (is_admitted(made, *single, made.nothing)) best = *find_set(made.singles, candidate);
    }
    return best;
  }

  void choose(Selection& made, Explanation best) {
    made.chosen = std::move(best);
    revision_.see_noise(made);
    revision_.correct_timing(made);
    revision_.colour_noise_beside(made, made.chosen);
  }

  void extend(Selection& made) {
    const Explanation single = best_single(made);
    // Timing is a nuisance: it loses against a cause that leaves noise, and wins over one that does
    // not.
    if (!single.leaves_noise()) revision_.correct_timing(made);
    if (!is_enough(made)) choose(made, single);
    if (is_enough(made) || !may_sets_explain(made.nothing, made.singles, options_)) return;
    if (try_sets(made) && !is_enough(made)) add_cause(made);
  }

  /// Sets of two effects, of three and of more, as long as the last effect takes enough; the best
  /// is chosen, with each of its effects exchanged. Returns whether one more beside those that are
  /// chosen has not been tried yet, and may be of use.
  bool try_sets(Selection& made) {
    // Of larger sets those with the best so far are told as untried: the others are not known yet.
    const Explanation single = made.singles.empty() ? made.nothing : made.singles.front();
    fits_.leave_untried(labels_with(single.fit.candidate, general_.others()));
    SetSearch search(fits_.parts(), general_.others(), general_.all(), options_, work_);
    work_.tell(kSets, work_.done());
    fits_.lengthen_parts(single);
    search.begin(made.nothing.fit.candidate, candidates_of(made.singles));
    std::optional<Explanation> last;
    bool is_ahead = true;
    std::size_t size = 1;
    while (is_ahead && has_room_beside(size) && !is_enough(made)) {
      ++size;
      if (last) fits_.leave_untried(labels_with(last->fit.candidate, general_.others()));
      const std::vector<Fit>& grown = search.grow(kSets, halfway());
      if (size == 2 && search.rms_over_noise() > options_.largest_of_pairs) return false;
      fits_.add_near(grown, options_.sets_refitted, kSets, halfway(), made.combinations);
      is_ahead = search.share_taken() >= options_.least_share_ahead;
      // Where no set of this size is identified, a larger one may be.
      const Explanation& smaller = last ? *last : single;
      const Explanation* largest = best_of_size(made, size, smaller);
      if (largest != nullptr && revision_.colour_noise_beside(made, *largest)) {
        largest = best_of_size(made, size, smaller);  // in that noise there may be none
      }
      if (largest != nullptr) {
        const Explanation best = replacements_.specialised(made, *largest);
        choose_needed(made, best);
        is_ahead = is_ahead || is_worth_another(best, smaller);
        last = best;
      }
      if (last && fits_.lengthen_parts(*last)) search.refit();
    }
    if (made.chosen.fit.candidate.effects.size() > 1) {
      Explanation better = exchanged(made, made.chosen);
      if (better.fit.candidate.labels() != made.chosen.fit.candidate.labels()) {
        choose(made, std::move(better));
      }
    }
    if (last && !is_enough(made)) {
      const Explanation largest = is_ahead ? exchanged(made, *last) : *last;
      // One that did not meet the bars may do so with other effects.
      if (largest.fit.candidate.labels() != last->fit.candidate.labels()) {
        choose_needed(made, largest);
      }
      try_in_coloured_noise(made, largest);
    }
    return made.chosen.fit.candidate.effects.size() >= size;
  }

  /// The simplest set of `size` effects; one with an effect less where that fits as well and the
  /// search has found it only now, better than `last`.
  const Explanation* best_of_size(const Selection& made, std::size_t size,
                                  const Explanation& last) const {
    const Explanation* const largest = simplest(made.combinations, size, options_);
    const Explanation* const smaller = simplest(made.combinations, size - 1, options_);
    if (smaller == nullptr || lead(*smaller, last) < options_.least_information_gain) {
      return largest;
    }
    const bool is_needed =
        largest != nullptr && lead(*largest, *smaller) >= options_.least_information_gain;
    return is_needed ? largest : smaller;
  }

  /// Coloured noise is excess residual in white noise: beside it the last effects of `largest`, or
  /// a general effect in place of its limit, may not clear the bars. The best that general effects
  /// make of it is tried in the noise that it leaves.
  void try_in_coloured_noise(Selection& made, const Explanation& largest) {
    const Explanation best = replacements_.generalised(made, largest);
    if (!revision_.colour_noise_beside(made, best)) return;
    auto& kept = made.sets_like(best.fit.candidate);
    const auto again = find_set(kept, best.fit.candidate);
    if (again == kept.end()) return;
    choose_needed(made, replacements_.specialised(made, *again));
  }

  /// One effect more beside those that are chosen, after exchanges.
  void add_cause(Selection& made) {
    const Candidate chosen = made.chosen.fit.candidate;
    const std::size_t causes = chosen.effects.size();
    if (causes == 0 || !has_room_beside(causes)) return;
    combine(made, chosen, "further effects", halfway());
    const Explanation* one_more = simplest(made.combinations, causes + 1, options_);
    if (one_more != nullptr) choose_needed(made, exchanged(made, *one_more));
  }

  bool has_room_beside(std::size_t causes) const {
    return static_cast<int>(causes) < options_.most_causes.value_or(4);
  }

  bool is_worth_another(const Explanation& fuller, const Explanation& simpler) const {
    return lead(fuller, simpler) >= options_.least_information_gain &&
           share_taken(simpler.estimation, fuller.estimation) >= options_.least_share_ahead;
  }

  /// What is needed of it, where that is admitted.
  void choose_needed(Selection& made, const Explanation& fuller) {
    const Explanation best = replacements_.needed(fuller);
    if (!is_admitted(made, best, made.chosen)) return;
    if (best.fit.candidate.effects.size() == 1) replace_single(made, best);
    choose(made, best);
  }

  /// Where something is left: each chosen effect exchanged for one that has it as a limit.
  void generalise(Selection& made) {
    const Candidate chosen = made.chosen.fit.candidate;
    for (std::size_t i = 0; i < chosen.effects.size() && !is_enough(made); ++i) {
      for (const Hypothesis* general : general_.with_limit(chosen.effects[i])) {
        const Explanation found = replacements_.replaced(made, chosen, i, *general);
        if (may_be_named(found, made.chosen)) made.chosen = found;
      }
    }
  }

  /// Where something is left of several causes, each exchanged for general effects that none of the
  /// chosen is a limit of: those that the residual without it has most of.
  void exchange_for_general(Selection& made) {
    const Candidate chosen = made.chosen.fit.candidate;
    if (chosen.effects.size() < 2 || is_enough(made)) return;
    for (std::size_t i = 0; i < chosen.effects.size(); ++i) {
      fits_.add_with(chosen.without(i), general_.all(), kExchanged, halfway(),
                     options_.general_effects, made.combinations);
    }
    if (const auto better = better_rival(made, made.chosen)) choose(made, *better);
  }

  /// Where noise is left: two of the causes may stand for one that has one of them as a limit. It
  /// takes their place unless they fit decisively better.
  void merge(Selection& made) const {
    const Candidate chosen = made.chosen.fit.candidate;
    if (!made.chosen.leaves_noise()) return;
    for (std::size_t i = 0; i < chosen.effects.size(); ++i) {
      for (const Hypothesis* general : general_.with_limit(chosen.effects[i])) {
        if (chosen.has_effect(general->effect)) continue;
        for (std::size_t other = 0; other < chosen.effects.size(); ++other) {
          if (other == i) continue;
          const Candidate rest = chosen.without(other);
          const std::size_t index = other < i ? i - 1 : i;
          if (fits_.scan().share_of(rest.without(index), *general) < options_.least_share) continue;
          const auto merged = replacements_.replaced_near_noise(made, rest, index, *general);
          if (!merged || !merged->leaves_noise() || !may_be_named(*merged, made.nothing)) continue;
          if (lead(made.chosen, *merged) >= options_.least_information_gain) continue;
          made.chosen = *merged;
          return;
        }
      }
    }
  }

  /// Without the causes that may not be named, one after the other: those with a parameter that the
  /// data do not identify, those whose estimates are inconsistent between runs, then the improbable
  /// ones. Where the time is over, runs are not fitted one by one.
  void leave_out_unnamed(Selection& made) {
    if (runs_away(made.chosen, options_)) made.chosen = made.nothing;
    while (!made.chosen.fit.candidate.effects.empty()) {
      const Candidate& candidate = made.chosen.fit.candidate;
      auto unnamed = unidentified_effect(candidate, stated_errors(made.chosen));
      if (!unnamed && !made.end) unnamed = inconsistent_cause(made);
      if (!unnamed) unnamed = improbable_effect(made, options_);
      if (!unnamed) return;
      made.chosen = replacements_.without(made, candidate, *unnamed);
      if (!clears_bars(made.chosen, made.nothing, options_)) made.chosen = made.nothing;
    }
  }

  /// Where what is left is no noise: an effect that would be named by itself, and stands for
  /// another one, as it has other values in each run.
  std::optional<std::size_t> inconsistent_cause(Selection& made) const {
    if (made.chosen.leaves_noise()) return std::nullopt;
    const Candidate& candidate = made.chosen.fit.candidate;
    const Posterior posterior = posterior_of(made, options_);
    for (std::size_t i = 0; i < candidate.effects.size(); ++i) {
      if (posterior.of(candidate.effects[i]) < options_.least_probability) continue;
      auto estimates = inconsistent_estimates(problem_, candidate, i);
      if (!estimates) continue;
      made.inconsistent.push_back(*std::move(estimates));
      return i;
    }
    return std::nullopt;
  }

  /// One by itself that its scan did not find, or at other values: to be combined anew.
  void replace_single(Selection& made, const Explanation& better) {
    const auto known = find_set(made.singles, better.fit.candidate);
    if (known != made.singles.end()) {
      *known = better;
    } else {
      made.singles.push_back(better);
    }
    sort_by_fit(made.singles);
    combined_.erase(better.fit.candidate.labels());
  }

  /// `base` with any other special effect, among the combinations; nothing where these are there.
  /// General ones follow: generalise().
  void combine(Selection& made, const Candidate& base, std::string_view what, double to) {
    if (!combined_.insert(base.labels()).second) return;
    fits_.add_beside(base, general_.others(), what, to, options_.effects_beside, made.combinations);
  }

  /// `best` with one cause after the other exchanged while that fits decisively better and takes
  /// enough or leaves noise: one may have been found by itself at a value that hides the other.
  Explanation exchanged(Selection& made, Explanation best) {
    bool goes_on = true;
    for (int exchanges = 0; goes_on && exchanges < options_.most_exchanges; ++exchanges) {
      for (std::size_t i = 0; i < best.fit.candidate.effects.size(); ++i) {
        combine(made, best.fit.candidate.without(i), kExchanged, halfway());
      }
      const auto better = better_rival(made, best);
      if (!better) break;
      goes_on = better->leaves_noise() || is_worth_another(*better, best);
      best = *better;
    }
    return best;
  }

  /// The best combination with one of the causes of `best` exchanged that fits decisively better.
  std::optional<Explanation> better_rival(Selection& made, const Explanation& best) const {
    for (const Candidate& candidate : candidates_of(made.combinations)) {
      if (!is_rival(candidate, best.fit.candidate)) continue;
      const auto rival = find_set(made.combinations, candidate);
      if (lead(*rival, best) < options_.least_information_gain) continue;
      if (replacements_.clears_limits(made, *rival)) return *find_set(made.combinations, candidate);
    }
    return std::nullopt;
  }

  /// A stage whose length is not known takes half of the progress that is left.
  double halfway() const { return 0.5 * (work_.done() + 1.0); }

  Problem problem_;
  const std::vector<Hypothesis>& hypotheses_;
  const SelectionOptions& options_;
  ReportedWork work_;
  SetFits fits_;
  GeneralEffects general_;
  SetReplacements replacements_;
  ProblemRevision revision_;
  std::set<std::set<std::string>> combined_;  // labels of what has been tried with any other
};

}  // namespace

Selection staged_selection(const Problem& problem, const std::vector<Hypothesis>& hypotheses,
                           const SelectionOptions& options, const DiagnosisProgress& progress) {
  try {
    return Search(problem, hypotheses, options, progress).run();
  } catch (const Cancelled&) {
    require_time(options.last);
    Selection made{problem};
    made.cancelled = true;
    return made;
  }
}

}  // namespace flexarm::diagnose
