#include "diagnose/search/effect_scan.hpp"

#include "diagnose/parallel.hpp"
#include "diagnose/search/coarse.hpp"
#include "diagnose/search/linear_refit.hpp"
#include "diagnose/search/scan.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>

namespace flexarm::diagnose {

using Eigen::Index;

namespace {

constexpr int kCoarseSteps = 8;
constexpr double kCoarseTolerance = 1e-4;
/// Of uncertain numbers on each side. A record in which the phase of a mode turns over has many
/// minima within these.
constexpr double kScannedDeviations = 2.5;

/// A few values of a hypothesis' parameters: over their ranges, and of a single one so near to
/// where it does nothing that the change is its direction.
std::vector<std::vector<double>> samples_of(const Hypothesis& hypothesis) {
  std::vector<double> places = {0.2, 0.5, 0.8};
  if (hypothesis.parameters.size() == 1) {
    places = {0.15, 0.35, 0.45, 0.55, 0.65, 0.85};
    const double neutral = hypothesis.parameters.front().neutral_coordinate().value_or(0.0);
    for (const double change : {-0.002, 0.002, -0.01, 0.01, -0.04, 0.04}) {
      const double place = neutral + change;
      if (neutral > 0.0 && place > 0.0 && place < 1.0) places.push_back(place);
    }
  }
  std::vector<std::vector<double>> samples = {{}};
  for (std::size_t i = 0; i < hypothesis.parameters.size(); ++i) {
    std::vector<std::vector<double>> longer;
    for (const auto& sample : samples) {
      for (const double place : places) {
        longer.push_back(sample);
        longer.back().push_back(place);
      }
    }
    samples = std::move(longer);
  }
  for (auto& sample : samples) sample = effects::values_at(hypothesis.parameters, sample);
  return samples;
}

/// The noise model for an experiment with the estimation runs alone.
std::optional<NoiseModel> noise_of_estimation(const Problem& problem) {
  std::optional<NoiseModel> noise = problem.predictor().noise();
  if (!noise || !noise->is_torque_noise()) return noise;
  std::vector<double> of_estimation_N_m;
  for (std::size_t r = 0; r < noise->torque_noise_N_m.size(); ++r) {
    if (problem.estimation_runs()[r]) of_estimation_N_m.push_back(noise->torque_noise_N_m[r]);
  }
  noise->torque_noise_N_m = std::move(of_estimation_N_m);
  return noise;
}

ProblemOptions coarse_options(const Problem& problem, const SelectionOptions& options) {
  return {.flexible_modes = std::min(options.coarse_modes, problem.predictor().flexible_modes()),
          .noise = noise_of_estimation(problem)};
}

Experiment coarse_experiment(const Problem& problem, std::size_t samples) {
  const auto& noise = problem.predictor().noise();
  return noise && !noise->is_torque_noise() ? coarse_whole(problem.experiment(), samples)
                                            : coarse(problem.experiment(), samples);
}

std::size_t coarse_samples(const Problem& problem, const SelectionOptions& options) {
  return has_controllers(problem.experiment()) ? options.coarse_loop_samples
                                               : options.coarse_samples;
}

double larger_share(const HubLawScan& law, const std::optional<HubLawScan>& early_law) {
  return early_law ? std::max(law.share, early_law->share) : law.share;
}

}  // namespace

EffectScan::EffectScan(const Problem& problem, const SelectionOptions& options, ReportedWork& work)
    : options_(options),
      work_(work),
      coarse_experiment_(coarse_experiment(problem, coarse_samples(problem, options))),
      short_experiment_(coarse_experiment(problem, options.short_samples)),
      coarse_(coarse_experiment_, coarse_options(problem, options)),
      short_(short_experiment_, coarse_options(problem, options)) {}

std::vector<Fit> EffectScan::first_looks(const Candidate& base,
                                         const std::vector<const Hypothesis*>& others,
                                         std::string_view what, double from, double to) {
  std::vector<Fit> looks(others.size());
  work_.in_parallel(others.size(), what, from, to,
                    [&](std::size_t i) { looks[i] = first_look(base, *others[i]); });
  std::ranges::stable_sort(looks, {}, &Fit::sum_of_squares);
  return looks;
}

Fit EffectScan::first_look(const Candidate& base) const {
  Fit look = coarse_fit(coarse_, base);
  if (base.nuisances.empty()) return look;
  std::vector<Index> scanned(base.nuisances.size());
  std::iota(scanned.begin(), scanned.end(), Index{0});
  const ScanOptions scan_options{.evaluations = options_.scan_evaluations.back(),
                                 .starts = options_.scan_starts,
                                 .lowest = -kScannedDeviations,
                                 .highest = kScannedDeviations,
                                 .work = &work_};
  for (const Problem* problem : {&short_, &coarse_}) {
    for (const Candidate& place : scan(*problem, base, scanned, scan_options)) {
      Fit found = coarse_fit(coarse_, coarse_fit(*problem, place).candidate);
      if (found.sum_of_squares < look.sum_of_squares) look = std::move(found);
    }
  }
  return look;
}

Fit EffectScan::first_look(const Candidate& base, const Hypothesis& other) const {
  const Candidate start = base.with(other, other.middle());
  const std::vector<Index> scanned = last_coordinates(start);
  const auto law = hub_law_scan(coarse_, start);
  const auto early_law = law ? hub_law_scan(short_, start) : std::nullopt;
  if (law && larger_share(*law, early_law) < options_.least_law_share) {
    // Simulated once, so that it can be compared with other looks.
    return fit(coarse_, law->starts.front(), {.most_steps = 0, .work = &work_});
  }
  Fit look = law ? best_fit(coarse_, law->starts) : best_from_scan(coarse_, start, scanned);
  const bool is_shorter =
      short_.observations().values.size() < coarse_.observations().values.size();
  if (scanned.size() == 1 || !is_shorter) return look;
  const Fit at_first =
      early_law ? best_fit(short_, early_law->starts) : best_from_scan(short_, start, scanned);
  Fit from_there = coarse_fit(coarse_, at_first.candidate);
  return from_there.sum_of_squares < look.sum_of_squares ? from_there : look;
}

std::optional<HubLawScan> EffectScan::hub_law_scan(const Problem& problem,
                                                   const Candidate& start) const {
  const std::size_t n =
      std::min(start.effects.back().parameters.size(), options_.law_evaluations.size());
  return scan_hub_law(problem, start,
                      {.evaluations = options_.law_evaluations[n - 1],
                       .starts = options_.scan_starts,
                       .work = &work_});
}

std::optional<double> EffectScan::share_of_law(const Candidate& base,
                                               const Hypothesis& other) const {
  const Candidate start = base.with(other, other.middle());
  const auto law = hub_law_scan(coarse_, start);
  if (!law) return std::nullopt;
  return larger_share(*law, hub_law_scan(short_, start));
}

Fit EffectScan::coarse_fit(const Problem& problem, const Candidate& start) const {
  return fit(problem, start,
             {.most_steps = kCoarseSteps, .tolerance = kCoarseTolerance, .work = &work_});
}

Fit EffectScan::best_from_scan(const Problem& problem, const Candidate& start,
                               const std::vector<Index>& scanned) const {
  const std::size_t n = std::min(scanned.size(), options_.scan_evaluations.size());
  const ScanOptions scan_options{.evaluations = options_.scan_evaluations[n - 1],
                                 .starts = n == 1 ? 1 : options_.scan_starts,
                                 .work = &work_};
  const LinearRefit refit(problem, start.without(start.effects.size() - 1), work_);
  const auto sum = [&](const Candidate& candidate) { return refit.sum_of_squares(candidate); };
  std::vector<Candidate> starts = scan(sum, start, scanned, scan_options);
  for (Candidate& one : starts) one = refit.refitted(one);
  return best_fit(problem, starts);
}

Fit EffectScan::best_fit(const Problem& problem, const std::vector<Candidate>& starts) const {
  std::vector<Fit> found(starts.size());
  in_parallel(starts.size(), [&](std::size_t i) { found[i] = coarse_fit(problem, starts[i]); });
  return *std::ranges::min_element(found, {}, &Fit::sum_of_squares);
}

Fit EffectScan::look_in_place(const Candidate& candidate, std::size_t index,
                              const Hypothesis& other) const {
  Fit look = first_look(candidate.without(index), other);
  if (!other.contains(candidate.effects[index].effect)) return look;
  std::optional<Fit> near_limit = look_from_limit(candidate, index, other);
  return near_limit && near_limit->sum_of_squares < look.sum_of_squares ? *near_limit : look;
}

std::optional<Fit> EffectScan::look_from_limit(const Candidate& limit, std::size_t index,
                                               const Hypothesis& general) const {
  const std::vector<SearchedParameter>& known = limit.effects[index].parameters;
  const std::vector<double> known_values = limit.values_of(index);
  std::vector<double> places = effects::coordinates_of(general.parameters, general.middle());
  Candidate start = limit.without(index);
  const auto first = start.coordinates().size();
  std::vector<Index> scanned;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const SearchedParameter& parameter = general.parameters[i];
    const auto same = std::ranges::find(known, parameter.name, &SearchedParameter::name);
    if (same == known.end()) {
      scanned.push_back(first + static_cast<Index>(i));
    } else {
      places[i] =
          parameter.coordinate(known_values[static_cast<std::size_t>(same - known.begin())]);
    }
  }
  if (scanned.size() == places.size()) return std::nullopt;
  start = start.with(general, effects::values_at(general.parameters, places));
  if (scanned.empty()) return coarse_fit(coarse_, start);
  return best_from_scan(coarse_, start, scanned);
}

std::vector<const Hypothesis*> EffectScan::promising(const Candidate& base,
                                                     std::vector<const Hypothesis*> others,
                                                     std::size_t most, std::string_view what) {
  if (others.size() <= most) return others;
  const Fit left = coarse_fit(coarse_, base);
  const Eigen::HouseholderQR<Eigen::MatrixXd> refitted(left.jacobian);
  std::vector<std::pair<double, const Hypothesis*>> shares(others.size());
  work_.in_parallel(others.size(), what, work_.done(), work_.done(), [&](std::size_t i) {
    shares[i] = {largest_part(left, refitted, *others[i]), others[i]};
  });
  std::ranges::stable_sort(shares, std::ranges::greater{}, &decltype(shares)::value_type::first);
  others.clear();
  for (std::size_t i = 0; i < most; ++i) others.push_back(shares[i].second);
  return others;
}

/// Part of the residuals of `left` along the change that the hypothesis makes, its parameters
/// refitted: the largest of `samples_of` it.
double EffectScan::largest_part(const Fit& left,
                                const Eigen::HouseholderQR<Eigen::MatrixXd>& refitted,
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

}  // namespace flexarm::diagnose
