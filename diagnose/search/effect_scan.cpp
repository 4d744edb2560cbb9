#include "diagnose/search/effect_scan.hpp"

#include "diagnose/parallel.hpp"
#include "diagnose/search/additions.hpp"
#include "diagnose/search/line_scan.hpp"
#include "diagnose/search/misfit.hpp"
#include "diagnose/search/scan.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>

namespace flexarm::diagnose {

using Eigen::Index;

namespace {

/// Of uncertain numbers on each side. A record in which the phase of a mode turns over has many
/// minima within these.
constexpr double kScannedDeviations = 2.5;

/// The coordinates of where along the beam the last effect is, and of its size.
std::vector<Index> place_and_size(const Candidate& candidate) {
  const Hypothesis& effect = candidate.effects.back();
  std::vector<Index> coordinates;
  for (const auto parameter : {effect.place_parameter(), effect.size_parameter()}) {
    if (!parameter) continue;
    coordinates.push_back(last_coordinates(candidate)[*parameter]);
  }
  return coordinates;
}

double larger_share(const HubLawScan& law, const std::optional<HubLawScan>& early_law) {
  return early_law ? std::max(law.share, early_law->share) : law.share;
}

}  // namespace

double explained_share(const Fit& before, const Fit& after) {
  const double left = beyond_noise(after.residuals) / beyond_noise(before.residuals);
  return std::clamp(1.0 - left, 0.0, 1.0);
}

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
  Fit look = coarse_fit(parts_.coarse(), base, work_);
  if (base.nuisances.empty()) return look;
  std::vector<Index> scanned(base.nuisances.size());
  std::iota(scanned.begin(), scanned.end(), Index{0});
  const ScanOptions scan_options{.evaluations = options_.scan_evaluations.back(),
                                 .starts = options_.scan_starts,
                                 .lowest = -kScannedDeviations,
                                 .highest = kScannedDeviations,
                                 .work = &work_};
  for (const Problem* problem : {&parts_.early(), &parts_.coarse()}) {
    for (const Candidate& place : scan(*problem, base, scanned, scan_options)) {
      Fit found = coarse_fit(parts_.coarse(), coarse_fit(*problem, place, work_).candidate, work_);
      if (found.sum_of_squares < look.sum_of_squares) look = std::move(found);
    }
  }
  return look;
}

Fit EffectScan::first_look(const Candidate& base, const Hypothesis& other) const {
  const Candidate start = base.with(other, other.middle());
  const auto law = hub_law_scan(parts_.coarse(), start);
  const auto early_law = law ? hub_law_scan(parts_.early(), start) : std::nullopt;
  if (law && larger_share(*law, early_law) < options_.least_law_share) {
    // Simulated once, so that it can be compared with other looks.
    return fit(parts_.coarse(), law->starts.front(), {.most_steps = 0, .work = &work_});
  }
  if (other.parameters.size() == 1 || !parts_.is_early_shorter()) {
    return best_look(parts_.coarse(), start, law);
  }
  const Fit at_first = best_look(parts_.early(), start, early_law);
  Fit from_there = coarse_fit(parts_.coarse(), at_first.candidate, work_);
  const bool shows_early =
      !law && explained_share(early_look(base), at_first) >= options_.least_share;
  if (shows_early) return from_there;
  Fit look = best_look(parts_.coarse(), start, law);
  return from_there.sum_of_squares < look.sum_of_squares ? from_there : look;
}

std::optional<HubLawScan> EffectScan::hub_law_scan(const Problem& problem,
                                                   const Candidate& start) const {
  return scan_hub_law(
      problem, start,
      {.evaluations = options_.law_evaluations, .starts = options_.scan_starts, .work = &work_});
}

std::optional<double> EffectScan::share_of_law(const Candidate& base,
                                               const Hypothesis& other) const {
  const Candidate start = base.with(other, other.middle());
  const auto law = hub_law_scan(parts_.coarse(), start);
  if (!law) return std::nullopt;
  return larger_share(*law, hub_law_scan(parts_.early(), start));
}

Fit EffectScan::best_from_scan(const Problem& problem, const Candidate& start,
                               const std::vector<Index>& scanned) const {
  const LinearRefit refit(problem, start.without(start.effects.size() - 1), work_);
  if (scanned.size() == 1) {
    const Candidate least = least_in_range(refit, start, scanned.front());
    return coarse_fit(problem, refit.refitted(least), work_);
  }
  const std::size_t n = std::min(scanned.size(), options_.scan_evaluations.size());
  const ScanOptions scan_options{.evaluations = options_.scan_evaluations[n - 1],
                                 .starts = options_.scan_starts,
                                 .work = &work_};
  const auto sum = [&](const Candidate& candidate) { return refit.sum_of_squares(candidate); };
  const auto best_at = [&](std::vector<Candidate> starts) {
    for (Candidate& one : starts) one = refit.refitted(one);
    return best_fit(problem, starts);
  };
  Fit found = best_at(scan(sum, start, scanned, scan_options));
  if (std::ssize(scanned) <= kMostOfGrid || !start.effects.back().place_parameter()) return found;
  Fit moved = best_at(scan(sum, found.candidate, place_and_size(found.candidate),
                           {.evaluations = options_.scan_evaluations[kMostOfGrid - 1],
                            .starts = options_.scan_starts,
                            .work = &work_}));
  return moved.sum_of_squares < found.sum_of_squares ? moved : found;
}

Candidate EffectScan::least_in_range(const LinearRefit& refit, const Candidate& start,
                                     Index scanned) const {
  const auto places = grid_places(1, options_.scan_evaluations.front());
  const auto candidate_at = [&](int i) {
    Candidate made = start;
    Eigen::VectorXd coordinates = start.coordinates();
    coordinates(scanned) = places[static_cast<std::size_t>(i)](0);
    made.put(coordinates);
    return made;
  };
  const auto residuals_at = [&](int i) {
    work_.go_on();
    return refit.residuals(candidate_at(i));
  };
  return candidate_at(least_on_line(residuals_at, static_cast<int>(places.size())));
}

Fit EffectScan::best_look(const Problem& part, const Candidate& start,
                          const std::optional<HubLawScan>& law) const {
  return law ? best_fit(part, law->starts) : best_from_scan(part, start, last_coordinates(start));
}

Fit EffectScan::best_fit(const Problem& problem, const std::vector<Candidate>& starts) const {
  std::vector<Fit> found(starts.size());
  in_parallel(starts.size(),
              [&](std::size_t i) { found[i] = coarse_fit(problem, starts[i], work_); });
  return *std::ranges::min_element(found, {}, &Fit::sum_of_squares);
}

Fit EffectScan::early_look(const Candidate& base, const Hypothesis& other) const {
  const Candidate start = base.with(other, other.middle());
  return best_look(parts_.early(), start, hub_law_scan(parts_.early(), start));
}

Fit EffectScan::early_look(const Candidate& candidate) const {
  return coarse_fit(parts_.early(), candidate, work_);
}

Fit EffectScan::coarse_look(const Candidate& candidate) const {
  return coarse_fit(parts_.coarse(), candidate, work_);
}

Fit EffectScan::look_in_place(const Candidate& candidate, std::size_t index,
                              const Hypothesis& other) const {
  Fit look = first_look(candidate.without(index), other);
  if (!other.contains(candidate.effects[index].effect)) return look;
  std::optional<Fit> near_limit = look_with_limits_values(candidate, index, other);
  return near_limit && near_limit->sum_of_squares < look.sum_of_squares ? *near_limit : look;
}

Fit EffectScan::look_from_limit(const Candidate& limited, std::size_t index,
                                const Hypothesis& general) const {
  const std::optional<Fit> look = look_with_limits_values(limited, index, general);
  return look ? *look : look_in_place(limited, index, general);
}

std::optional<Fit> EffectScan::look_with_limits_values(const Candidate& limited, std::size_t index,
                                                       const Hypothesis& general) const {
  const std::vector<SearchedParameter>& known = limited.effects[index].parameters;
  const std::vector<double> known_values = limited.values_of(index);
  std::vector<double> places = effects::coordinates_of(general.parameters, general.middle());
  Candidate start = limited.without(index);
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
  if (scanned.empty()) return coarse_fit(parts_.coarse(), start, work_);
  return best_from_scan(parts_.coarse(), start, scanned);
}

double EffectScan::share_of(const Candidate& base, const Hypothesis& other) const {
  const Fit left = coarse_fit(parts_.coarse(), base, work_);
  const auto found = additions(parts_.coarse(), left, {&other}, 1, options_, work_);
  return found.empty() ? 0.0 : found.front().share;
}

std::vector<const Hypothesis*> EffectScan::promising(const Candidate& base,
                                                     std::vector<const Hypothesis*> others,
                                                     std::size_t most, std::string_view what) {
  if (others.size() <= most) return others;
  work_.tell(what, work_.done());
  const Fit left = coarse_fit(parts_.coarse(), base, work_);
  const auto ranked = additions(parts_.coarse(), left, std::move(others), most, options_, work_);
  others.clear();
  for (const Addition& addition : ranked) others.push_back(addition.effect);
  return others;
}

}  // namespace flexarm::diagnose
