#include "diagnose/search/problem_revision.hpp"

#include "diagnose/parallel.hpp"
#include "diagnose/search/admission.hpp"
#include "diagnose/search/channel_independence.hpp"
#include "diagnose/search/dependence_test.hpp"

#include <algorithm>
#include <utility>

namespace flexarm::diagnose {

template <class Change>
void ProblemRevision::change_problem(Change change) {
  const Problem before = problem_;
  try {
    change();
  } catch (const Cancelled&) {
    problem_ = before;
    throw;
  }
}

/// All that was fitted to all data once more, from where it is, with the problem as it is now: all
/// of it, or nothing where that is cancelled. What is far from the best is only evaluated.
void ProblemRevision::refit(Selection& made) const {
  const Fit* best = &made.chosen.fit;
  for (const auto* sets : {&made.singles, &made.combinations}) {
    if (sets->empty() || !(sets->front().fit.sum_of_squares < best->sum_of_squares)) continue;
    best = &sets->front().fit;
  }
  const auto again = [&, this](const Explanation& explanation) {
    const Candidate& candidate = explanation.fit.candidate;
    if (is_near(explanation.fit, *best, options_)) return fits_.fitted(candidate);
    return explain(problem_, fit(problem_, candidate, {.most_steps = 0, .work = &work_}));
  };
  const auto all_again = [&](std::vector<Explanation> explanations) {
    in_parallel(explanations.size(),
                [&](std::size_t i) { explanations[i] = again(explanations[i]); });
    sort_by_fit(explanations);
    return explanations;
  };
  Explanation nothing = fits_.fitted(made.nothing.fit.candidate);
  Explanation chosen = fits_.fitted(made.chosen.fit.candidate);
  std::vector<Explanation> singles = all_again(made.singles);
  made.combinations = all_again(made.combinations);
  made.nothing = std::move(nothing);
  made.chosen = std::move(chosen);
  made.singles = std::move(singles);
}

void ProblemRevision::see_noise(Selection& made) {
  const Explanation* best = &made.chosen;
  if (best->fit.candidate.effects.empty() && !made.singles.empty()) best = &made.singles.front();
  const Candidate candidate = best->fit.candidate;
  change_problem([&] {
    const auto& noise = problem_.predictor().noise();
    const bool is_changed = noise && !noise->is_torque_noise()
                                ? problem_.estimate_noise(candidate, [this] { work_.go_on(); })
                                : problem_.lower_noise(candidate);
    if (is_changed) refit(made);
  });
}

void ProblemRevision::colour_noise_of_nothing(Selection& made) {
  colour_noise(made, made.nothing, options_.least_share, kResidualLevel);
}

void ProblemRevision::colour_noise_beside_singles(Selection& made) {
  if (std::ranges::any_of(made.singles, &Explanation::leaves_noise)) return;
  if (colour_noise(made, made.nothing, 1.0, kResidualLevel) || made.singles.empty()) return;
  colour_noise(made, made.singles.front(), 1.0, kResidualLevel);
}

bool ProblemRevision::colour_noise_beside(Selection& made, const Explanation& set) {
  return !set.leaves_noise() && colour_noise(made, set, 1.0, kResidualLevel);
}

void ProblemRevision::colour_noise_at_last(Selection& made) {
  if (colour_noise(made, made.nothing, 1.0, kCertainDependence)) return;
  colour_noise(made, made.chosen, 1.0, kCertainDependence);
}

bool ProblemRevision::is_for_timing(const Selection& made, const Explanation& left) const {
  return problem_.is_driven_by_torque() && !made.timing &&
         left.estimation.unexplained_error() <= options_.largest_timing_error;
}

/// With the noise that `best` leaves, if that is noise at `level` of the dependence test; of what
/// it leaves an effect may account for so much before whitening. Returns whether it is.
bool ProblemRevision::colour_noise(Selection& made, const Explanation& best, double largest_share,
                                   double level) {
  const bool is_known = problem_.predictor().noise() || problem_.has_coloured_noise();
  if (is_known || runs_away(best, options_)) return false;
  const std::pair same_fit(best.fit.candidate.labels(), best.fit.sum_of_squares);
  const auto dependence = dependence_.find(same_fit);
  if (dependence != dependence_.end() && dependence->second < level) return false;
  if (is_for_timing(made, best) && !made.undecided_timing &&
      torque_timing(problem_, best.fit).share >= options_.least_timing_share) {
    return false;
  }
  const auto coloured = with_settled_noise(best.fit.candidate);
  if (!coloured) {
    dependence_[same_fit] = 0.0;
    return false;
  }
  const DependenceTest found =
      test_dependence(coloured->problem, problem_, coloured->fitted, work_, level);
  dependence_[same_fit] = found.p_value;
  if (found.p_value < level || found.largest_share > largest_share) return false;
  change_problem([&] {
    problem_ = coloured->problem;
    refit(made);
  });
  return true;
}

/// Least squares in white noise leaves other errors than the fit beside their coloured noise, so
/// that noise model and fit are made in turn until a fit moves residuals by less than `kSettled`
/// standard deviations in all: iterated generalised least squares. Empty where what is left is not
/// noise, or more than noise of one sensor.
std::optional<ProblemRevision::ColouredFit> ProblemRevision::with_settled_noise(
    Candidate candidate) const {
  constexpr double kSettled = 0.5;
  constexpr int kMostFits = 4;
  std::optional<Problem> coloured;
  for (int fits = 0; fits < kMostFits; ++fits) {
    coloured = problem_.with_coloured_noise(candidate);
    if (!coloured || exceeds_noise_of_one_sensor(*coloured, problem_)) return std::nullopt;
    const Explanation left = explain(*coloured, fit(*coloured, candidate, {.work = &work_}));
    if (!left.leaves_noise()) return std::nullopt;
    const Eigen::VectorXd moved = left.fit.candidate.coordinates() - candidate.coordinates();
    candidate = left.fit.candidate;
    if ((left.fit.jacobian * moved).norm() <= kSettled) break;
  }
  return ColouredFit{*std::move(coloured), std::move(candidate)};
}

void ProblemRevision::correct_timing(Selection& made) {
  if (made.chosen.leaves_noise() || !is_for_timing(made, made.chosen)) return;
  TorqueTiming timing = torque_timing(problem_, made.chosen.fit);
  if (timing.share < options_.least_timing_share) return;
  change_problem([&] { correct_by(made, std::move(timing)); });
}

/// ... where it leaves noise; else it is undecided.
void ProblemRevision::correct_by(Selection& made, TorqueTiming timing) {
  const Problem as_recorded = problem_;
  problem_.replace_torques(retimed(problem_.experiment(), timing));
  // Once more from there: what the first step was too long for, and the runs for validation.
  Explanation corrected = fits_.fitted(made.chosen.fit.candidate);
  problem_.replace_torques(retimed(problem_.experiment(), torque_timing(problem_, corrected.fit)));
  problem_.lower_noise(corrected.fit.candidate);
  corrected = fits_.fitted(corrected.fit.candidate);
  if (!corrected.leaves_noise()) {
    problem_ = as_recorded;
    made.undecided_timing = std::move(timing);
    return;
  }
  refit(made);
  made.timing = std::move(timing);
}

}  // namespace flexarm::diagnose
