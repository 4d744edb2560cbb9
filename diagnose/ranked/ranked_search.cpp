#include "diagnose/ranked/ranked_search.hpp"

#include "diagnose/parallel.hpp"
#include "diagnose/ranked/moves.hpp"
#include "diagnose/search/coarse.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>

namespace flexarm::diagnose {

namespace {

using Labels = std::set<std::string>;

constexpr RankedFitOptions kLook = {.most_steps = 10, .tolerance = 0.5, .takes_secants = true};

/// One climb on a rung of the ladder, which has a part of the data, or all.
class Rung {
 public:
  Rung(const Likelihood& likelihood, const std::vector<Hypothesis>& hypotheses,
       const RankedOptions& options, const ReportedWork& work)
      : likelihood_(likelihood),
        least_time_s_(options.least_time *
                      scales_of(likelihood.problem().experiment()).shortest_time_s),
        hypotheses_(hypotheses),
        options_(options),
        work_(work) {}

  /// Fits the sets of the beam to these data, and replaces them by neighbours while the best score
  /// falls.
  void climb(std::vector<RankedFit>& beam, std::size_t width) {
    in_parallel(beam.size(), [&](std::size_t i) { beam[i] = fitted(beam[i].candidate); });
    std::erase_if(beam, [](const RankedFit& one) { return !one.is_possible(); });
    if (beam.empty()) beam.push_back(fitted(likelihood_.problem().as_filed()));
    if (!beam.front().is_possible()) return;
    for (const RankedFit& one : beam) met_.insert(one.candidate.labels());
    keep_best(beam, width);
    for (bool falls = true; falls;) {
      const double before = beam.front().score;
      std::vector<RankedFit> neighbours;
      for (const RankedFit& base : beam) {
        if (moves_.contains(base.candidate.labels())) continue;
        std::ranges::move(neighbours_of(base), std::back_inserter(neighbours));
      }
      std::ranges::move(neighbours, std::back_inserter(beam));
      keep_best(beam, width);
      falls = beam.front().score < before;
    }
    beam.front() = fitted(beam.front().candidate);
  }

  /// Returns the `most` effects whose moves of this set are predicted to be best, and those of the
  /// families of its effects; all of a set that cannot be computed.
  std::vector<Hypothesis> shortlist(const RankedFit& set, std::size_t most) {
    if (!set.is_possible()) return hypotheses_;
    const auto known = moves_.find(set.candidate.labels());
    const std::vector<Move> moves =
        known != moves_.end() ? known->second : moves_of(likelihood_, set, hypotheses_, work_);
    std::set<std::string> kept;
    for (const Move& move : moves) {
      if (move.added != nullptr && kept.size() < most) kept.insert(move.added->label());
    }
    std::vector<Hypothesis> made;
    for (const Hypothesis& one : hypotheses_) {
      const bool is_of_family = std::ranges::any_of(set.candidate.effects, [&](const auto& own) {
        return own.entry->family == one.entry->family;
      });
      if (is_of_family || kept.contains(one.label())) made.push_back(one);
    }
    return made;
  }

 private:
  static void keep_best(std::vector<RankedFit>& beam, std::size_t width) {
    std::ranges::stable_sort(beam, {}, &RankedFit::score);
    beam.resize(std::min(beam.size(), width));
  }

  RankedFit fitted(const Candidate& start) const { return ranked_fit(likelihood_, start, work_); }
  RankedFit look(const Move& move, const RankedFit& base) const {
    return ranked_fit(likelihood_, move.of(base.candidate), work_, kLook, &base);
  }

  /// Returns fits of the moves that are predicted to lower the score most, to sets that were not
  /// met before.
  std::vector<RankedFit> neighbours_of(const RankedFit& base) {
    std::vector<Move> moves = moves_of(likelihood_, base, hypotheses_, work_);
    moves_[base.candidate.labels()] = moves;
    std::size_t looks = 0;
    std::erase_if(moves, [&](const Move& one) {
      const bool is_looked_at = looks < options_.looks && one.score < base.score &&
                                met_.insert(one.of(base.candidate).labels()).second;
      looks += is_looked_at ? 1 : 0;
      return !is_looked_at;
    });
    std::vector<RankedFit> fits(moves.size());
    in_parallel(moves.size(), [&](std::size_t i) { fits[i] = look(moves[i], base); });
    std::erase_if(fits, [&](const RankedFit& one) {
      return !one.is_possible() || !can_be_timed(one.candidate);
    });
    return fits;
  }

  /// Returns whether the delay or lag that was added last is one that the clock of the data can
  /// tell.
  bool can_be_timed(const Candidate& set) const {
    if (set.effects.empty()) return true;
    const Hypothesis& last = set.effects.back();
    if (last.entry->family != effects::Family::timing) return true;
    return std::abs(set.values_of(set.effects.size() - 1).front()) >= least_time_s_;
  }

  const Likelihood& likelihood_;
  double least_time_s_;
  const std::vector<Hypothesis>& hypotheses_;
  const RankedOptions& options_;
  const ReportedWork& work_;
  std::set<Labels> met_;                       ///< sets that were fitted
  std::map<Labels, std::vector<Move>> moves_;  ///< of those whose neighbours were
};

/// Returns the hypotheses that an arm has in one case of five (effects::Likely).
std::vector<Hypothesis> common_of(std::vector<Hypothesis> hypotheses) {
  std::erase_if(hypotheses,
                [](const Hypothesis& one) { return one.entry->prior != effects::Likely::common; });
  return hypotheses;
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

RankedSets ranked_search(const Likelihood& likelihood, const std::vector<Hypothesis>& hypotheses,
                         const RankedOptions& options, ReportedWork& work) {
  const Problem& problem = likelihood.problem();
  RankedSets made;
  std::vector<RankedFit> beam;
  std::vector<Hypothesis> searched = hypotheses;
  std::vector<Hypothesis> common = common_of(hypotheses);
  std::size_t most = hypotheses.size();
  const auto climb_afresh = [&](const Likelihood& part, std::size_t width) {
    for (const auto* effects : {&common, &searched}) {
      std::vector<RankedFit> fresh(1);
      fresh.front().candidate = problem.as_filed();
      Rung(part, *effects, options, work).climb(fresh, width);
      std::ranges::move(fresh, std::back_inserter(beam));
    }
  };
  const auto climb = [&](const Likelihood& part, std::size_t width) {
    Rung rung(part, searched, options, work);
    rung.climb(beam, width);
    most /= options.halving;
    searched = rung.shortlist(beam.front(), most);
  };
  try {
    std::size_t width = options.beam;
    const std::size_t longest = longest_run(problem.experiment());
    for (const std::size_t samples : options.rungs) {
      if (samples >= longest) break;
      work.tell("effects on a part of the data", 0.1);
      const int modes = std::min(options.coarse_modes, problem.predictor().flexible_modes());
      const Problem part(std::make_shared<const Experiment>(coarse(problem.experiment(), samples)),
                         {.flexible_modes = modes});
      const Likelihood of_part(part, part.estimation_runs());
      climb_afresh(of_part, width);
      climb(of_part, width);
      width = 1;
    }
    work.tell("effects on all data", 0.5);
    if (beam.empty()) climb_afresh(likelihood, width);
    climb(likelihood, width);
  } catch (const Cancelled&) {
    if (!work.is_out_of_time()) throw;
    made.is_complete = false;
  }
  if (beam.empty()) beam.push_back({.candidate = problem.as_filed()});
  made.best = std::move(beam);
  return made;
}

}  // namespace flexarm::diagnose
