#include "diagnose/search/set_search.hpp"

#include "diagnose/parallel.hpp"
#include "diagnose/search/moves.hpp"
#include "diagnose/search/part_of_data.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>

namespace flexarm::diagnose {

namespace {

using Labels = std::set<std::string>;

/// A fit that shows which of several starts are worth going on with, and one that goes on.
constexpr MinimiseOptions kFirstLook = {.most_steps = 3, .tolerance = 0.5, .takes_secants = true};
constexpr MinimiseOptions kLook = {.most_steps = 25, .tolerance = 0.5, .takes_secants = true};

/// The moves of a set that are fitted: `predicted` are those that are predicted to lower the score
/// most. `broad` ones also add every effect of several parameters, whether or not that is predicted
/// to lower it: the prediction knows a few of their shapes, and a fit changes these. A climb takes
/// them first, and where no predicted move lowers the score, unless the set leaves noise.
enum class Looks { predicted, broad };

/// A set that was fitted is fitted again from another start that is predicted to be lower by this:
/// fits end so far from their minima.
constexpr double kWorth = 2.0 * kLook.tolerance;

/// How far a climb goes: below all data to a set that leaves noise, since more data are to come.
/// Exchanges do not make a set larger.
enum class Climb { to_noise, to_the_end, exchanges };

bool leaves_noise(const Likelihood& likelihood, const ScoredFit& set) {
  return set.is_possible() && likelihood.is_noise(set.lines);
}

/// Returns the index of an effect that is at the end of its range; none of most sets.
std::optional<std::size_t> effect_at_an_end(const Candidate& set) {
  for (std::size_t i = 0; i < set.effects.size(); ++i) {
    if (set.effects[i].is_at_end_of_range(set.values_of(i))) return i;
  }
  return std::nullopt;
}

/// Returns the fit of a set without the effects that end at the end of their range.
ScoredFit fitted_in_range(const Likelihood& likelihood, const Candidate& start,
                          const ReportedWork& work) {
  ScoredFit made = scored_fit(likelihood, start, work);
  while (const auto ended = effect_at_an_end(made.candidate)) {
    made = scored_fit(likelihood, made.candidate.without(*ended), work);
  }
  return made;
}

/// One climb on a rung of the ladder, which has a part of the data, or all.
class Rung {
 public:
  /// A climb begins without the effects of the labels in `hopeless`.
  Rung(const Likelihood& likelihood, const std::vector<Hypothesis>& hypotheses,
       std::size_t most_effects, const ReportedWork& work, Climb end, const Labels& hopeless = {})
      : likelihood_(likelihood),
        policy_(likelihood.problem().policy()),
        least_time_s_(policy_.least_time *
                      scales_of(likelihood.problem().experiment()).shortest_time_s),
        hypotheses_(hypotheses),
        most_effects_(most_effects),
        work_(work),
        end_(end) {
    const auto left_out = std::ranges::stable_partition(
        hypotheses_, [&](const Hypothesis& one) { return !hopeless.contains(one.label()); });
    searched_ = hypotheses_.size() - left_out.size();
  }

  ScoredFit fitted(const Candidate& start) const {
    return fitted_in_range(likelihood_, start, work_);
  }

  /// Fits the sets of the beam to these data, or the arm as filed where none can be; the best
  /// first.
  void fit(std::vector<ScoredFit>& beam) {
    in_parallel(beam.size(), [&](std::size_t i) { beam[i] = fitted(beam[i].candidate); });
    std::erase_if(beam, [](const ScoredFit& one) { return !one.is_possible(); });
    if (beam.empty()) beam.push_back(fitted(likelihood_.problem().as_filed()));
    keep_best(beam, beam.size());
  }

  /// Replaces fitted sets of the beam by neighbours while the best score falls.
  void climb(std::vector<ScoredFit>& beam, std::size_t width, Looks first_looks) {
    if (!beam.front().is_possible()) return;
    for (const ScoredFit& one : beam) meet(one);
    keep_best(beam, width);
    const auto is_noise = [&] { return leaves_noise(likelihood_, beam.front()); };
    const auto widest = [&] { return is_noise() ? Looks::predicted : first_looks; };
    for (Looks looks = widest(); !is_over(beam.front());) {
      const double before = beam.front().score;
      std::vector<ScoredFit> neighbours;
      for (const ScoredFit& base : beam) {
        if (&base != &beam.front() && is_noise()) break;
        if (!expanded_.insert({base.candidate.labels(), looks}).second) continue;
        std::ranges::move(neighbours_of(base, looks), std::back_inserter(neighbours));
      }
      std::ranges::move(neighbours, std::back_inserter(beam));
      keep_best(beam, width);
      const bool falls = beam.front().score < before;
      if (!falls && looks == widest() && !take_left_out(beam)) break;
      looks = falls ? Looks::predicted : widest();
    }
    beam.front() = fitted(beam.front().candidate);
  }

  /// Climbs on from rivals that are better than the best set of the beam until there is none: the
  /// score test is linear, and far from noise a swap may be better than it predicts.
  void settle(std::vector<ScoredFit>& beam) {
    while (!leaves_noise(likelihood_, beam.front())) {
      std::vector<ScoredFit> others = rivals(beam.front());
      const auto best = std::ranges::min_element(others, {}, &ScoredFit::score);
      if (best == others.end() || !(best->score < beam.front().score - kWorth)) return;
      beam = {*best};
      climb(beam, 1, Looks::predicted);
    }
  }

  /// Returns fits of the most likely swaps of a fitted set whose score is within Policy::near of
  /// that of the set, or lower; of the empty set those of the most likely effects. Tried are those
  /// that are predicted to be near, and, since the prediction is linear, for each effect all of its
  /// family, and the best Policy::beam others.
  std::vector<ScoredFit> rivals(const ScoredFit& base) {
    if (!base.is_possible()) return {};
    const Candidate& set = base.candidate;
    const bool is_empty = set.effects.empty();
    std::vector<Move> swaps = moves_from(base);
    std::map<std::size_t, std::size_t> fitted_for;
    std::set<Labels> tried = {set.labels()};
    std::erase_if(swaps, [&](const Move& one) {
      if (one.added == nullptr || one.dropped.has_value() == is_empty) return true;
      if (!tried.insert(one.of(set).labels()).second) return true;
      if (one.score <= base.score + policy_.near) return false;
      const effects::Family family = one.added->entry->family;
      if (!is_empty && set.effects[*one.dropped].entry->family == family) return false;
      return fitted_for[one.dropped.value_or(0)]++ >= policy_.beam;
    });
    std::vector<ScoredFit> made(swaps.size());
    in_parallel(swaps.size(), [&](std::size_t i) {
      made[i] = scored_fit(likelihood_, start_of(swaps[i], base), work_, kLook, &base);
    });
    std::erase_if(made, [&](const ScoredFit& one) {
      const bool is_near = is_empty || one.score <= base.score + policy_.near;
      return !is_near || !can_be_named(one.candidate);
    });
    return made;
  }

  /// Returns the labels of the effects that are predicted to raise the score of a set by more than
  /// Policy::near, or cannot be computed beside it; of none where the set itself cannot.
  Labels hopeless_beside(const ScoredFit& set) {
    if (!set.is_possible()) return {};
    Labels made;
    for (const Hypothesis& one : hypotheses_) made.insert(one.label());
    for (const Move& move : moves_from(set)) {
      if (move.added != nullptr && move.score < set.score + policy_.near) {
        made.erase(move.added->label());
      }
    }
    return made;
  }

 private:
  bool is_over(const ScoredFit& best) const {
    return end_ == Climb::to_noise && leaves_noise(likelihood_, best);
  }

  /// Takes up the effects that were left out, unless the best set of the beam leaves noise. Returns
  /// whether it did.
  bool take_left_out(const std::vector<ScoredFit>& beam) {
    const std::size_t searched = searched_;
    if (searched == hypotheses_.size() || leaves_noise(likelihood_, beam.front())) return false;
    searched_ = hypotheses_.size();
    expanded_.clear();
    for (const ScoredFit& set : beam) {
      const auto known = moves_.find(set.candidate.labels());
      if (known == moves_.end()) continue;
      std::vector<Move> more =
          moves_of(likelihood_, set, std::span(hypotheses_).subspan(searched), work_);
      std::erase_if(more, [](const Move& one) { return one.added == nullptr; });  // known
      std::ranges::move(more, std::back_inserter(known->second));
      std::ranges::stable_sort(known->second, {}, &Move::score);
    }
    return true;
  }

  /// Keeps the fits of the lowest score, of `most` sets of effects and so many of one set.
  static void keep_best(std::vector<ScoredFit>& fits, std::size_t most, std::size_t of_one = 1) {
    std::ranges::stable_sort(fits, {}, &ScoredFit::score);
    std::map<Labels, std::size_t> kept;
    std::erase_if(fits, [&](const ScoredFit& one) {
      const Labels labels = one.candidate.labels();
      return (kept.size() == most && !kept.contains(labels)) || kept[labels]++ >= of_one;
    });
  }

  void meet(const ScoredFit& fit) {
    const auto [at, is_new] = met_.try_emplace(fit.candidate.labels(), fit.score);
    at->second = std::min(at->second, fit.score);
  }

  /// Returns the moves of `set`, which are computed once.
  const std::vector<Move>& moves_from(const ScoredFit& set) {
    const auto [at, is_new] = moves_.try_emplace(set.candidate.labels());
    if (is_new) {
      at->second = moves_of(likelihood_, set, std::span(hypotheses_).first(searched_), work_);
    }
    return at->second;
  }

  /// Returns the moves of `base` that are fitted: to sets that were not met before, and to smaller
  /// ones, and to the set itself, from values that are predicted to be at a lower minimum.
  std::vector<Move> looked_at(const ScoredFit& base, Looks kind) {
    std::vector<Move> moves = moves_from(base);
    const Labels own_labels = base.candidate.labels();
    std::size_t looks = 0;
    std::set<Labels> new_sets;
    const bool is_full = end_ == Climb::exchanges || base.candidate.effects.size() >= most_effects_;
    std::erase_if(moves, [&](const Move& one) {
      if (is_full && one.added != nullptr && !one.dropped) return true;
      const bool is_broad = kind == Looks::broad && one.added != nullptr && !one.dropped &&
                            one.added->parameters.size() > 1;
      if (!is_broad && (one.score >= base.score || looks >= policy_.looks)) return true;
      const Labels labels = one.of(base.candidate).labels();
      const auto met = met_.find(labels);
      const bool is_met_again = one.added == nullptr || labels == own_labels;
      if (met == met_.end() || (is_met_again && one.score < met->second - kWorth)) {
        new_sets.insert(labels);
      }
      if (!new_sets.contains(labels)) return true;
      if (!is_broad) ++looks;
      return false;
    });
    return moves;
  }

  /// Returns the set that a move leads to. In an exchange the effects that stay begin at the values
  /// that a refit is predicted to give them, where these are nearer to the data: they may have been
  /// answers to what is dropped.
  Candidate start_of(const Move& move, const ScoredFit& base) const {
    Candidate start = move.of(base.candidate);
    if (move.step.size() == 0) return start;
    Candidate refitted = move.of(base.candidate, true);
    work_.go_on();
    return likelihood_.cost_of(refitted) < likelihood_.cost_of(start) ? refitted : start;
  }

  /// Returns fits of the moves of `base` (looked_at): those of the lowest score after a first look.
  std::vector<ScoredFit> neighbours_of(const ScoredFit& base, Looks looks) {
    const std::vector<Move> moves = looked_at(base, looks);
    std::vector<ScoredFit> fits(moves.size());
    in_parallel(moves.size(), [&](std::size_t i) {
      fits[i] = scored_fit(likelihood_, start_of(moves[i], base), work_, kFirstLook, &base);
    });
    std::erase_if(fits, [](const ScoredFit& one) { return !one.is_possible(); });
    keep_best(fits, policy_.looks, policy_.beam);
    in_parallel(fits.size(), [&](std::size_t i) {
      fits[i] = scored_fit(likelihood_, fits[i].candidate, work_, kLook, &fits[i]);
    });
    for (const ScoredFit& one : fits) meet(one);
    std::erase_if(fits, [&](const ScoredFit& one) { return !can_be_named(one.candidate); });
    return fits;
  }

  /// Returns whether no effect is at the end of its range, and the delay or lag that was added last
  /// is one that the clock of the data can tell.
  bool can_be_named(const Candidate& set) const {
    if (set.effects.empty()) return true;
    if (effect_at_an_end(set)) return false;
    const Hypothesis& last = set.effects.back();
    if (last.entry->family != effects::Family::timing) return true;
    return std::abs(set.values_of(set.effects.size() - 1).front()) >= least_time_s_;
  }

  const Likelihood& likelihood_;
  const Policy& policy_;
  double least_time_s_;
  std::vector<Hypothesis> hypotheses_;  ///< those that are left out last; moves refer to them
  std::size_t searched_ = 0;            ///< how many are not left out
  std::size_t most_effects_;
  const ReportedWork& work_;
  Climb end_;
  std::map<Labels, double> met_;                 ///< the lowest score of each set that was fitted
  std::set<std::pair<Labels, Looks>> expanded_;  ///< whose neighbours were
  std::map<Labels, std::vector<Move>> moves_;
};

/// Returns the hypotheses that an arm has in one case of five (effects::Likely).
std::vector<Hypothesis> common_of(std::vector<Hypothesis> hypotheses) {
  std::erase_if(hypotheses,
                [](const Hypothesis& one) { return one.entry->prior != effects::Likely::common; });
  return hypotheses;
}

/// Adds the rivals of the best set (Rung::rivals) that do nearly as well on a part of the data to
/// the beam, fitted to all data. Where that set leaves noise (`exchanges`), its effects are first
/// exchanged for others on the part, and the beam is what comes of it.
void add_rivals(const Likelihood& likelihood, const Likelihood& part, bool exchanges,
                const std::vector<Hypothesis>& hypotheses, const SearchBounds& bounds,
                const ReportedWork& work, std::vector<ScoredFit>& beam) {
  Rung rung(part, hypotheses, bounds.most_effects, work, Climb::exchanges);
  std::vector<ScoredFit> near;
  if (exchanges) {
    near = beam;
    rung.fit(near);
    rung.climb(near, part.problem().policy().beam, Looks::predicted);
  }
  std::vector<ScoredFit> rivals =
      rung.rivals(exchanges ? near.front() : rung.fitted(beam.front().candidate));
  if (exchanges) near.push_back(beam.front());
  std::ranges::move(rivals, std::back_inserter(near));
  in_parallel(near.size(), [&](std::size_t i) {
    near[i] = scored_fit(likelihood, near[i].candidate, work, kLook);
  });
  std::erase_if(near, [](const ScoredFit& one) {
    return !one.is_possible() || effect_at_an_end(one.candidate);
  });
  // After the deadline the last fit ends without a result: the beam is then that of before.
  if (!exchanges || near.empty()) near.insert(near.end(), beam.begin(), beam.end());
  std::ranges::stable_sort(near, {}, &ScoredFit::score);
  near.front() = fitted_in_range(likelihood, near.front().candidate, work);
  beam = std::move(near);
}

/// Returns the number of samples of the longest `time` run for estimation; 0 without any.
std::size_t longest_run(const Experiment& experiment) {
  std::size_t longest = 0;
  for (const auto& [run, data] : experiment.runs) {
    if (run.purpose != measured::Purpose::estimation) continue;
    if (const auto* record = std::get_if<measured::TimeRecord>(&data)) {
      longest = std::max(longest, record->time_s.size());
    }
  }
  return longest;
}

}  // namespace

FoundSets search_sets(const Likelihood& likelihood, const std::vector<Hypothesis>& hypotheses,
                      const SearchBounds& bounds, ReportedWork& work) {
  const Problem& problem = likelihood.problem();
  const Policy& policy = problem.policy();
  const std::size_t to_depth = std::min(bounds.most_effects, policy.depth);
  FoundSets made;
  std::vector<ScoredFit> beam;
  std::vector<Hypothesis> common = common_of(hypotheses);
  Labels hopeless;
  bool has_climbed = false;
  // Returns whether one effect leaves noise: then no set imitates it with fewer numbers.
  const auto climb_afresh = [&](const Likelihood& part, const std::vector<Hypothesis>& effects,
                                std::size_t most_effects, std::size_t width) {
    std::vector<ScoredFit> fresh;
    Rung rung(part, effects, most_effects, work, Climb::to_noise);
    rung.fit(fresh);
    rung.climb(fresh, width, Looks::broad);
    const ScoredFit& best = fresh.front();
    const bool is_one = best.candidate.effects.size() <= 1 && leaves_noise(part, best);
    std::ranges::move(fresh, std::back_inserter(beam));
    return is_one;
  };
  const auto climb = [&](const Likelihood& part, std::size_t width, Climb end, bool settles) {
    Rung rung(part, hypotheses, bounds.most_effects, work, end, hopeless);
    rung.fit(beam);
    const bool is_noise = leaves_noise(part, beam.front());
    if (!is_noise) {
      if (has_climbed) rung.climb(beam, width, Looks::predicted);
      const bool is_one = !has_climbed && climb_afresh(part, hypotheses, to_depth, width);
      if (!is_one) climb_afresh(part, common, bounds.most_effects, width);
    }
    const bool is_broad = !is_noise && !has_climbed;
    rung.climb(beam, width, is_broad ? Looks::broad : Looks::predicted);
    if (settles) rung.settle(beam);
    has_climbed = has_climbed || !is_noise;
    if (has_climbed && end != Climb::to_the_end) hopeless = rung.hopeless_beside(beam.front());
  };
  const auto begin_with_starts = [&] {
    for (const Candidate& start : bounds.starts) {
      if (start.effects.size() <= bounds.most_effects) beam.push_back({{.candidate = start}});
    }
  };
  try {
    begin_with_starts();
    std::size_t width = policy.beam;
    const std::array rungs = {policy.first_samples, 4 * policy.first_samples,
                              16 * policy.first_samples};
    const std::size_t of_rivals = rungs[1];
    std::unique_ptr<const PartOfData> part_for_rivals;  // null where all data are as short
    const std::size_t longest = longest_run(problem.experiment());
    for (const std::size_t samples : rungs) {
      if (samples >= longest) break;
      work.tell("effects on a part of the data", 0.1);
      auto part = std::make_unique<const PartOfData>(problem, samples,
                                                     static_cast<int>(policy.coarse_modes));
      climb(part->likelihood(), width, Climb::to_noise, samples == of_rivals);
      width = has_climbed ? 1 : width;
      if (samples == of_rivals) part_for_rivals = std::move(part);
    }
    work.tell("effects on all data", 0.5);
    begin_with_starts();
    climb(likelihood, width, Climb::to_the_end, false);
    const bool is_noise = leaves_noise(likelihood, beam.front());
    if (is_noise && beam.front().candidate.effects.empty()) return {std::move(beam)};
    work.tell("rivals of the effects that were found", 0.8);
    // Innovations of a Kalman filter are noise whatever the model errs by: its disturbance is that.
    const bool exchanges = is_noise && !problem.predictor().noise();
    const auto sample_size = exchanges ? SampleSize::of_noise : SampleSize::of_model_error;
    const Likelihood whole = likelihood.with(sample_size);
    const Likelihood part =
        part_for_rivals ? part_for_rivals->likelihood().with(sample_size) : whole;
    add_rivals(whole, part, exchanges, hypotheses, bounds, work, beam);
    made.sample_size = sample_size;
  } catch (const Cancelled&) {
    if (!work.is_out_of_time()) throw;
    made.is_complete = false;
  }
  if (beam.empty()) beam.push_back({{.candidate = problem.as_filed()}});
  made.best = std::move(beam);
  return made;
}

}  // namespace flexarm::diagnose
