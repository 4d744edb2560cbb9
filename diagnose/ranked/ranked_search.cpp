#include "diagnose/ranked/ranked_search.hpp"

#include "diagnose/parallel.hpp"
#include "diagnose/ranked/score_test.hpp"
#include "diagnose/search/coarse.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>

namespace flexarm::diagnose {

namespace {

using Eigen::VectorXd;
using Labels = std::set<std::string>;

constexpr RankedFitOptions kLook = {.most_steps = 6, .tolerance = 0.5};
constexpr RankedFitOptions kFit = {};
constexpr std::size_t kAll = std::numeric_limits<std::size_t>::max();

/// One rung of the ladder: a problem with part of the data, or all.
class Rung {
 public:
  Rung(const Problem& problem, const std::vector<Hypothesis>& hypotheses,
       const RankedOptions& options, const ReportedWork& work)
      : likelihood_(problem, problem.estimation_runs()),
        hypotheses_(hypotheses),
        options_(options),
        work_(work) {
    for (const Hypothesis& one : hypotheses) all_.push_back(&one);
  }

  /// Fits the sets of the beam to these data.
  void refit(std::vector<RankedFit>& beam) {
    in_parallel(beam.size(), [&](std::size_t i) { beam[i] = fitted(beam[i].candidate, kFit); });
    met_.clear();
    for (const RankedFit& one : beam) met_.insert(one.candidate.labels());
    std::ranges::stable_sort(beam, {}, &RankedFit::score);
  }

  /// Adds effects to the best `width` sets while the best score falls.
  void grow(std::vector<RankedFit>& beam, std::size_t width) {
    beam.resize(std::min(beam.size(), width));
    for (bool falls = true; falls;) {
      std::vector<Start> starts;
      for (const RankedFit& base : beam) {
        for (Start& one : starts_beside(base, all_, options_.looks)) {
          if (met_.insert(one.candidate.labels()).second) starts.push_back(std::move(one));
        }
      }
      const double before = beam.front().score;
      std::ranges::move(material_fits(starts), std::back_inserter(beam));
      std::ranges::stable_sort(beam, {}, &RankedFit::score);
      beam.resize(std::min(beam.size(), width));
      falls = beam.front().score < before;
    }
  }

  /// Drops effects of the best set and swaps them for others, while that lowers its score, and
  /// drops those that are not material.
  void improve(RankedFit& best) {
    best = fitted(best.candidate, kFit);
    while (auto better = better_neighbour(best)) best = *std::move(better);
  }

 private:
  /// A set to fit, with the lines of the set without its last effect.
  struct Start {
    Candidate candidate;
    VectorXd lines_without;
  };

  RankedFit fitted(const Candidate& start, const RankedFitOptions& options) const {
    return ranked_fit(likelihood_, start, work_, options);
  }

  bool is_material(const VectorXd& lines_without, const RankedFit& with) const {
    return likelihood_.largest_drop(lines_without, with.lines) >= options_.least_drop;
  }

  std::vector<Start> starts_beside(const RankedFit& base,
                                   const std::vector<const Hypothesis*>& others,
                                   std::size_t most) const {
    std::vector<Start> starts;
    for (const RankedAddition& one : ranked_additions(likelihood_, base, others, most, work_)) {
      starts.push_back({base.candidate.with(*one.effect, one.values), base.lines});
    }
    return starts;
  }

  /// Fits of a few steps, those whose last effect is material.
  std::vector<RankedFit> material_fits(const std::vector<Start>& starts) const {
    std::vector<RankedFit> fits(starts.size());
    in_parallel(starts.size(),
                [&](std::size_t i) { fits[i] = fitted(starts[i].candidate, kLook); });
    std::vector<RankedFit> material;
    for (std::size_t i = 0; i < fits.size(); ++i) {
      const bool is_kept = fits[i].is_possible() && is_material(starts[i].lines_without, fits[i]);
      if (is_kept) material.push_back(std::move(fits[i]));
    }
    return material;
  }

  /// The best set with one effect less or another in its place; empty if none is better.
  std::optional<RankedFit> better_neighbour(const RankedFit& best) const {
    const std::vector<Hypothesis>& effects = best.candidate.effects;
    std::vector<RankedFit> tried(effects.size());
    in_parallel(effects.size(),
                [&](std::size_t i) { tried[i] = fitted(best.candidate.without(i), kLook); });
    for (RankedFit& one : tried) {
      if (one.is_possible() && !is_material(one.lines, best)) return std::move(one);
    }
    std::vector<Start> swaps;
    for (std::size_t i = 0; i < effects.size(); ++i) {
      if (!tried[i].is_possible()) continue;
      for (RankedFit& limit :
           material_fits(starts_beside(tried[i], limits_of(effects[i], hypotheses_), kAll))) {
        if (!is_material(limit.lines, best)) return std::move(limit);
      }
      std::ranges::move(starts_beside(tried[i], all_but(effects[i]), options_.swaps),
                        std::back_inserter(swaps));
    }
    std::ranges::move(material_fits(swaps), std::back_inserter(tried));
    const auto least = std::ranges::min_element(tried, {}, &RankedFit::score);
    if (least == tried.end() || !(least->score < best.score)) return std::nullopt;
    RankedFit better = fitted(least->candidate, kFit);
    return better.score < best.score ? std::optional(std::move(better)) : std::nullopt;
  }

  std::vector<const Hypothesis*> all_but(const Hypothesis& effect) const {
    std::vector<const Hypothesis*> others;
    std::ranges::copy_if(all_, std::back_inserter(others),
                         [&](const Hypothesis* one) { return one->label() != effect.label(); });
    return others;
  }

  Likelihood likelihood_;
  const std::vector<Hypothesis>& hypotheses_;
  const RankedOptions& options_;
  const ReportedWork& work_;
  std::vector<const Hypothesis*> all_;  ///< hypotheses_
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
  std::size_t width = options.beam;
  const auto climb = [&](Rung& rung) {
    rung.refit(beam);
    rung.grow(beam, std::exchange(width, 1));
    rung.improve(beam.front());
  };
  try {
    const std::size_t longest = longest_run(problem.experiment());
    for (const std::size_t samples : options.rungs) {
      if (samples >= longest) break;
      work.tell("effects on a part of the data", 0.1);
      const Problem part(std::make_shared<const Experiment>(coarse(problem.experiment(), samples)),
                         {.flexible_modes = problem.predictor().flexible_modes()});
      Rung rung(part, hypotheses, options, work);
      climb(rung);
    }
    work.tell("effects on all data", 0.5);
    Rung rung(problem, hypotheses, options, work);
    climb(rung);
  } catch (const Cancelled&) {
    if (!work.is_out_of_time()) throw;
    made.is_complete = false;
  }
  made.best = std::move(beam);
  return made;
}

}  // namespace flexarm::diagnose
