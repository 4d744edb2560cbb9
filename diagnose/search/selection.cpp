#include "diagnose/search/selection.hpp"

#include "diagnose/search/coarse.hpp"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <tbb/parallel_for.h>
#include <utility>

namespace flexarm::diagnose {

namespace {

/// Fraction of the work that is done with the effects by themselves.
constexpr double kSinglesDone = 0.4;
/// ... and when pairs of the best of them have been tried.
constexpr double kPairsDone = 0.8;
constexpr FitOptions kCoarseFit{.most_steps = 8, .tolerance = 1e-4};

/// A few values of a hypothesis' parameters, over their ranges.
std::vector<std::vector<double>> samples_of(const Hypothesis& hypothesis) {
  const std::vector<double> places = hypothesis.parameters.size() == 1
                                         ? std::vector{0.15, 0.35, 0.45, 0.55, 0.65, 0.85}
                                         : std::vector{0.2, 0.5, 0.8};
  std::vector<std::vector<double>> samples = {{}};
  for (const SearchedParameter& parameter : hypothesis.parameters) {
    std::vector<std::vector<double>> longer;
    for (const auto& sample : samples) {
      for (const double place : places) {
        longer.push_back(sample);
        longer.back().push_back(parameter.value(place));
      }
    }
    samples = std::move(longer);
  }
  return samples;
}

/// What a candidate's effects are, in whatever order: sensor_lag is another on each sensor.
std::set<std::string> labels_of(const Candidate& candidate) {
  std::set<std::string> labels;
  for (const Hypothesis& effect : candidate.effects) labels.insert(effect.label());
  return labels;
}

/// One that has another effect in the place of one of the other's.
bool is_rival(const Candidate& one, const Candidate& other) {
  const auto shared = std::ranges::count_if(
      one.effects, [&](const Hypothesis& effect) { return other.has(effect); });
  return one.effects.size() == other.effects.size() && shared + 1 == std::ssize(one.effects);
}

class Search {
 public:
  Search(const Problem& problem, const std::vector<Hypothesis>& hypotheses,
         const SelectionOptions& options, const DiagnosisProgress& progress)
      : problem_(problem),
        hypotheses_(hypotheses),
        options_(options),
        work_(progress),
        coarse_experiment_(coarse(problem.experiment(), options.coarse_samples)),
        short_experiment_(coarse(problem.experiment(), options.short_samples)),
        coarse_(coarse_experiment_, coarse_options()),
        short_(short_experiment_, coarse_options()) {}

  Selection run() {
    Selection made = found();
    made.problem = problem_;
    return made;
  }

 private:
  Selection found() {
    Selection made{problem_};
    made.nothing = fitted(problem_.as_filed());
    made.chosen = made.nothing;
    see_noise(made);
    correct_timing(made, options_.sure_timing_share);
    if (is_enough(made)) return made;
    made.singles = all_with(made.nothing.fit.candidate, "effects one by one", 0.0, kSinglesDone,
                            options_.singles_refitted);
    if (!made.singles.empty()) {
      see_noise(made);
      extend(made);
      if (correct_timing(made, options_.least_timing_share) && !is_enough(made)) {
        combined_.clear();
        made.combinations.clear();
        extend(made);
      }
    }
    const bool is_single = made.chosen.fit.candidate.effects.size() == 1;
    std::ranges::copy_if(is_single ? made.singles : made.combinations,
                         std::back_inserter(made.rivals), [&](const Explanation& other) {
                           return is_rival(other.fit.candidate, made.chosen.fit.candidate);
                         });
    made.cancelled = work_.is_cancelled();
    return made;
  }

  ProblemOptions coarse_options() const {
    return {
        .flexible_modes = std::min(options_.coarse_modes, problem_.predictor().flexible_modes()),
        .logarithmic_responses = true};
  }

  /// The noise that is seen under what the best so far leaves.
  void see_noise(Selection& made) {
    const Explanation& best = made.singles.empty() ? made.nothing : made.singles.front();
    if (problem_.lower_noise(best.fit.candidate)) refit(made);
  }

  /// All that was fitted to all data once more, from where it is, with the problem as it is now.
  void refit(Selection& made) {
    const auto again = [this](Explanation& explanation) {
      explanation = fitted(explanation.fit.candidate);
    };
    again(made.nothing);
    again(made.chosen);
    for (auto* explanations : {&made.singles, &made.combinations}) {
      tbb::parallel_for(std::size_t{0}, explanations->size(),
                        [&](std::size_t i) { again((*explanations)[i]); });
      sort_by_fit(*explanations);
    }
  }

  bool is_enough(const Selection& made) const {
    return is_explained(made.chosen.estimation, made.nothing.estimation, options_);
  }

  /// Where a little is left of which the timing of the torque explains `least_share`: the torques
  /// as that timing has them, and what has been fitted once more. Returns whether that was so.
  bool correct_timing(Selection& made, double least_share) {
    if (made.timing || made.chosen.estimation.is_noise() ||
        made.chosen.estimation.unexplained_error() > options_.largest_timing_error) {
      return false;
    }
    TorqueTiming timing = torque_timing(problem_, made.chosen.fit);
    if (timing.share < least_share) return false;
    problem_.replace_torques(retimed(problem_.experiment(), timing));
    made.timing = std::move(timing);
    // Once more from there: what the first step was too long for, and the runs for validation.
    made.chosen = fitted(made.chosen.fit.candidate);
    problem_.replace_torques(
        retimed(problem_.experiment(), torque_timing(problem_, made.chosen.fit)));
    problem_.lower_noise(made.chosen.fit.candidate);
    refit(made);
    return true;
  }

  Explanation fitted(const Candidate& start) const {
    return explain(problem_, fit(problem_, start));
  }

  /// `base` with hypotheses that it has not, each found by a scan of a coarse problem; the
  /// `refitted` best of these fitted to all data, the best first.
  std::vector<Explanation> all_with(const Candidate& base, std::string_view what, double from,
                                    double to, std::size_t refitted) {
    std::vector<const Hypothesis*> others;
    for (const Hypothesis& hypothesis : hypotheses_) {
      if (!base.has(hypothesis)) others.push_back(&hypothesis);
    }
    if (!base.effects.empty()) keep_promising(base, others, what, from);
    if (others.empty() || work_.is_cancelled()) return {};
    std::vector<Fit> looks(others.size());
    const double middle = from + 0.6 * (to - from);
    work_.in_parallel(others.size(), what, from, middle, [&](std::size_t i) {
      const Hypothesis& other = *others[i];
      std::vector<double> values;
      for (const auto& parameter : other.parameters) values.push_back(parameter.value(0.5));
      looks[i] = first_look(base.with(other, values));
    });
    if (work_.is_cancelled()) return {};
    std::ranges::stable_sort(looks, {}, &Fit::sum_of_squares);
    looks.resize(std::min(refitted, looks.size()));
    std::vector<Explanation> found(looks.size());
    work_.in_parallel(looks.size(), what, middle, to,
                      [&](std::size_t i) { found[i] = fitted(looks[i].candidate); });
    sort_by_fit(found);
    return found;
  }

  /// The last effect of `start` scanned, and all refitted to the coarse problem.
  Fit first_look(const Candidate& start) const {
    const std::size_t parameters = start.effects.back().parameters.size();
    const int evaluations =
        options_.scan_evaluations[std::min(parameters, options_.scan_evaluations.size()) - 1];
    Fit look = fit(coarse_, scan(coarse_, start, evaluations), kCoarseFit);
    const bool is_shorter =
        short_.observations().values.size() < coarse_.observations().values.size();
    if (parameters == 1 || !is_shorter) return look;
    const Fit at_first = fit(short_, scan(short_, start, evaluations), kCoarseFit);
    Fit from_there = fit(coarse_, at_first.candidate, kCoarseFit);
    return from_there.sum_of_squares < look.sum_of_squares ? from_there : look;
  }

  /// Leaves the `scanned_beside` hypotheses that account, at some of a few values each, for most of
  /// what `base` leaves: a score test without refitting.
  void keep_promising(const Candidate& base, std::vector<const Hypothesis*>& others,
                      std::string_view what, double from) {
    if (others.size() <= options_.scanned_beside) return;
    const Fit left = fit(coarse_, base, kCoarseFit);
    const Eigen::HouseholderQR<Eigen::MatrixXd> refitted(left.jacobian);
    std::vector<std::pair<double, const Hypothesis*>> shares(others.size());
    work_.in_parallel(others.size(), what, from, from, [&](std::size_t i) {
      shares[i] = {largest_part(left, refitted, *others[i]), others[i]};
    });
    std::ranges::stable_sort(shares, std::ranges::greater{}, &decltype(shares)::value_type::first);
    others.clear();
    for (std::size_t i = 0; i < options_.scanned_beside; ++i) others.push_back(shares[i].second);
  }

  /// Part of the residuals of `left` along the change that the hypothesis makes, its parameters
  /// refitted: the largest of `samples_of` it.
  double largest_part(const Fit& left, const Eigen::HouseholderQR<Eigen::MatrixXd>& refitted,
                      const Hypothesis& hypothesis) const {
    double largest = 0.0;
    for (const std::vector<double>& values : samples_of(hypothesis)) {
      const auto with =
          coarse_.residuals(left.candidate.with(hypothesis, values), coarse_.estimation_runs());
      if (!with) continue;
      // At the fit's minimum the residuals have no part along its own parameters.
      Eigen::VectorXd change = refitted.householderQ().adjoint() * (left.residuals - *with);
      change.head(left.jacobian.cols()).setZero();
      change = refitted.householderQ() * change;
      const double size = change.norm() * left.residuals.norm();
      if (size > 0.0) largest = std::max(largest, change.dot(left.residuals) / size);
    }
    return largest;
  }

  /// Whether `fuller` has a right to its causes beside `simpler`.
  bool deserves(const Explanation& fuller, const Explanation& simpler) const {
    // A hub that friction never lets go is told by no value of that friction.
    if ((fuller.fit.jacobian.colwise().squaredNorm().array() == 0.0).any()) return false;
    if (lead(fuller, simpler) < options_.least_information_gain) return false;
    if (share_taken(simpler.estimation, fuller.estimation) < options_.least_share) return false;
    // Validation runs that show nothing without the effect must not show anything with it.
    if (simpler.validation.is_noise()) return fuller.validation.is_noise();
    return share_taken(simpler.validation, fuller.validation) >= options_.least_validated_share;
  }

  /// Of those of `found` with so many effects the first, or one with fewer parameters that it has
  /// no right to stand before; null where there are none.
  const Explanation* simplest(const std::vector<Explanation>& found, std::size_t effects) const {
    const Explanation* best = nullptr;
    for (const Explanation& other : found) {
      if (other.fit.candidate.effects.size() != effects) continue;
      const bool is_simpler =
          best != nullptr && other.fit.candidate.values.size() < best->fit.candidate.values.size();
      if (best == nullptr || (is_simpler && !deserves(*best, other))) best = &other;
    }
    return best;
  }

  void extend(Selection& made) {
    const Explanation* single = simplest(made.singles, 1);
    if (deserves(*single, made.nothing)) made.chosen = *single;
    correct_timing(made, options_.sure_timing_share);
    for (int round = 0; round < options_.most_rounds && !is_enough(made); ++round) {
      const std::size_t causes = std::max<std::size_t>(made.chosen.fit.candidate.effects.size(), 1);
      if (static_cast<int>(causes) == options_.most_causes) return;
      combine_further(made);
      const Explanation* larger = simplest(made.combinations, causes + 1);
      if (larger == nullptr || work_.is_cancelled()) return;
      const Explanation best = needed(exchanged(made, *larger));
      if (work_.is_cancelled() || !deserves(best, made.chosen)) return;
      if (best.fit.candidate.effects.size() == 1) replace_single(made, best);
      made.chosen = exchanged(made, best);
      correct_timing(made, options_.sure_timing_share);
    }
  }

  /// One by itself at other values than its scan found: to be combined anew.
  void replace_single(Selection& made, const Explanation& better) {
    const Hypothesis& effect = better.fit.candidate.effects.front();
    for (Explanation& single : made.singles) {
      if (single.fit.candidate.has(effect)) single = better;
    }
    sort_by_fit(made.singles);
    combined_.erase({effect.label()});
  }

  /// The chosen causes with any other effect; of less than two, the best by themselves: the better
  /// of two causes need not be the best by itself.
  void combine_further(Selection& made) {
    if (made.chosen.fit.candidate.effects.size() > 1) {
      combine(made, made.chosen.fit.candidate, "further effects", halfway());
      return;
    }
    const std::size_t bases = std::min(options_.pair_bases, made.singles.size());
    const double step = (kPairsDone - kSinglesDone) / static_cast<double>(bases);
    for (std::size_t b = 0; b < bases; ++b) {
      combine(made, made.singles[b].fit.candidate, "pairs of effects",
              kSinglesDone + step * static_cast<double>(b + 1));
    }
  }

  /// `base` with any other effect, among the combinations; nothing where these are there. Of the
  /// same effects, begun from another, the better stays.
  void combine(Selection& made, const Candidate& base, std::string_view what, double to) {
    if (!combined_.insert(labels_of(base)).second) return;
    for (Explanation& found : all_with(base, what, work_.done(), to, options_.pairs_refitted)) {
      const auto same = std::ranges::find_if(made.combinations, [&](const Explanation& other) {
        return labels_of(other.fit.candidate) == labels_of(found.fit.candidate);
      });
      if (same == made.combinations.end()) {
        made.combinations.push_back(std::move(found));
      } else if (found.fit.sum_of_squares < same->fit.sum_of_squares) {
        *same = std::move(found);
      }
    }
    sort_by_fit(made.combinations);
  }

  /// `explanation` without effects that the others, refitted, make superfluous: those that take
  /// away less than an effect must.
  Explanation needed(const Explanation& explanation) const {
    const Candidate& candidate = explanation.fit.candidate;
    if (candidate.effects.size() < 2) return explanation;
    std::vector<Explanation> simpler(candidate.effects.size());
    tbb::parallel_for(std::size_t{0}, simpler.size(),
                      [&](std::size_t i) { simpler[i] = fitted(candidate.without(i)); });
    sort_by_fit(simpler);
    for (const Explanation& one : simpler) {
      if (!deserves(explanation, one)) return needed(one);
    }
    return explanation;
  }

  /// `best` with one cause after the other exchanged while that fits decisively better: of two
  /// causes the one may have been found by itself at a value that hides the other.
  Explanation exchanged(Selection& made, Explanation best) {
    for (int exchanges = 0; exchanges < options_.most_exchanges; ++exchanges) {
      const Candidate& candidate = best.fit.candidate;
      for (std::size_t i = 0; i < candidate.effects.size(); ++i) {
        combine(made, candidate.without(i), "exchanged effects", halfway());
      }
      const auto first = std::ranges::find_if(made.combinations, [&](const Explanation& other) {
        return is_rival(other.fit.candidate, candidate);
      });
      if (first == made.combinations.end() ||
          lead(*first, best) < options_.least_information_gain) {
        break;
      }
      best = *first;
    }
    return best;
  }

  /// A stage whose length is not known takes half of the progress that is left.
  double halfway() const { return 0.5 * (work_.done() + 1.0); }

  Problem problem_;
  const std::vector<Hypothesis>& hypotheses_;
  const SelectionOptions& options_;
  ReportedWork work_;
  Experiment coarse_experiment_;
  Experiment short_experiment_;
  Problem coarse_;
  Problem short_;
  std::set<std::set<std::string>> combined_;  // labels of what has been tried with any other
};

}  // namespace

bool is_explained(const Misfit& left, const Misfit& nothing, const SelectionOptions& options) {
  if (left.is_noise()) return true;
  if (left.nuisance_excess() > 0.0) return false;
  const double before = std::min(1.0, nothing.unexplained_error());
  return left.unexplained_error() <=
         std::max(left.simulated * options.negligible_error, options.negligible_share * before);
}

Selection select(Problem problem, const std::vector<Hypothesis>& hypotheses,
                 const SelectionOptions& options, const DiagnosisProgress& progress) {
  return Search(problem, hypotheses, options, progress).run();
}

}  // namespace flexarm::diagnose
