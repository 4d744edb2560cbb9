#include "diagnose/ranked/ranked_search.hpp"

#include "diagnose/parallel.hpp"
#include "diagnose/ranked/score_test.hpp"
#include "diagnose/search/coarse.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <utility>

namespace flexarm::diagnose {

namespace {

using Labels = std::set<std::string>;

constexpr RankedFitOptions kLook = {.most_steps = 6, .tolerance = 0.5};
constexpr RankedFitOptions kFit = {};

/// One rung of the ladder: a problem with part of the data, or all.
class Rung {
 public:
  Rung(const Problem& problem, const std::vector<Hypothesis>& hypotheses,
       const RankedOptions& options, const ReportedWork& work)
      : likelihood_(problem, problem.estimation_runs()), options_(options), work_(work) {
    for (const Hypothesis& one : hypotheses) hypotheses_.push_back(&one);
  }

  const Likelihood& likelihood() const { return likelihood_; }

  /// Fits the sets of the beam to these data.
  void refit(std::vector<RankedFit>& beam) {
    in_parallel(beam.size(), [&](std::size_t i) { beam[i] = fitted(beam[i].candidate, kFit); });
    met_.clear();
    for (const RankedFit& one : beam) met_.insert(one.candidate.labels());
    std::ranges::stable_sort(beam, {}, &RankedFit::score);
  }

  /// Adds effects while the best score falls.
  void grow(std::vector<RankedFit>& beam) {
    for (bool falls = true; falls;) {
      std::vector<Candidate> starts;
      for (const RankedFit& base : beam) {
        for (const RankedAddition& one :
             ranked_additions(likelihood_, base, hypotheses_, options_.looks, work_)) {
          Candidate with = base.candidate.with(*one.effect, one.values);
          if (met_.insert(with.labels()).second) starts.push_back(std::move(with));
        }
      }
      std::vector<RankedFit> grown(starts.size());
      in_parallel(starts.size(), [&](std::size_t i) { grown[i] = fitted(starts[i], kLook); });
      const double before = beam.front().score;
      std::ranges::move(grown, std::back_inserter(beam));
      std::ranges::stable_sort(beam, {}, &RankedFit::score);
      beam.resize(std::min(beam.size(), options_.beam));
      falls = beam.front().score < before;
    }
  }

  /// Drops effects of the best set, and swaps them for others, while that lowers its score.
  void improve(RankedFit& best) {
    best = fitted(best.candidate, kFit);
    while (auto better = best_neighbour(best)) best = *std::move(better);
  }

 private:
  RankedFit fitted(const Candidate& start, const RankedFitOptions& options) const {
    return ranked_fit(likelihood_, start, work_, options);
  }

  std::optional<RankedFit> best_neighbour(const RankedFit& best) const {
    constexpr std::size_t kSwaps = 2;
    const std::size_t count = best.candidate.effects.size();
    std::vector<RankedFit> without(count);
    in_parallel(count, [&](std::size_t i) {
      without[i] = fitted(best.candidate.without(i), kLook);
    });
    std::vector<Candidate> swapped;
    for (std::size_t i = 0; i < count; ++i) {
      if (!without[i].is_possible()) continue;
      std::vector<const Hypothesis*> others = hypotheses_;
      std::erase_if(others, [&](const Hypothesis* one) {
        return one->label() == best.candidate.effects[i].label();
      });
      for (const RankedAddition& one :
           ranked_additions(likelihood_, without[i], others, kSwaps, work_)) {
        swapped.push_back(without[i].candidate.with(*one.effect, one.values));
      }
    }
    std::vector<RankedFit> tried(swapped.size());
    in_parallel(swapped.size(), [&](std::size_t i) { tried[i] = fitted(swapped[i], kLook); });
    std::ranges::move(without, std::back_inserter(tried));
    const auto least = std::ranges::min_element(tried, {}, &RankedFit::score);
    if (least == tried.end() || !(least->score < best.score)) return std::nullopt;
    RankedFit better = fitted(least->candidate, kFit);
    return better.score < best.score ? std::optional(std::move(better)) : std::nullopt;
  }

  Likelihood likelihood_;
  const RankedOptions& options_;
  const ReportedWork& work_;
  std::vector<const Hypothesis*> hypotheses_;
  std::set<Labels> met_;
};

/// Samples of the longest `time` run for estimation; 0 without any.
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

RankedSets ranked_search(const Problem& problem, const std::vector<Hypothesis>& hypotheses,
                         const RankedOptions& options, ReportedWork& work) {
  RankedSets made;
  std::vector<RankedFit> beam(1);
  beam.front().candidate = problem.as_filed();
  const auto climb = [&](Rung& rung) {
    rung.refit(beam);
    rung.grow(beam);
    rung.improve(beam.front());
  };
  try {
    const std::size_t longest = longest_run(problem.experiment());
    for (const std::size_t samples : options.rungs) {
      if (samples >= longest) break;
      work.tell("effects on a part of the data", 0.1);
      const Problem part(
          std::make_shared<const Experiment>(coarse(problem.experiment(), samples)),
          {.flexible_modes = problem.predictor().flexible_modes()});
      Rung rung(part, hypotheses, options, work);
      climb(rung);
    }
    work.tell("effects on all data", 0.5);
    Rung rung(problem, hypotheses, options, work);
    made.nothing = ranked_fit(rung.likelihood(), problem.as_filed(), work);
    climb(rung);
  } catch (const Cancelled&) {
    if (!work.is_out_of_time()) throw;
    made.is_complete = false;
    work.lift_deadline();
  }
  made.best = std::move(beam);
  return made;
}

}  // namespace flexarm::diagnose
