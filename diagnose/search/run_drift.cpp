#include "diagnose/search/run_drift.hpp"

#include "diagnose/parallel.hpp"
#include "diagnose/search/misfit.hpp"
#include "measured/spectra/tail_probability.hpp"

#include <algorithm>
#include <cmath>

namespace flexarm::diagnose {

namespace {

using Eigen::Index;

/// Of a place, between rounding and curvature.
constexpr double kPlaceStep = 1e-4;
constexpr int kMostRunSteps = 4;
/// A step of this part of the standard error, or of the value, is the last.
constexpr double kLastStep = 0.1;
constexpr double kLastChange = 0.003;

/// From the value where the effect does nothing: that of a stiffness, infinity, is as 0 here.
double size_of(const SearchedParameter& parameter, double value) {
  return std::abs(value - parameter.neutral.value_or(0.0));
}

struct RunFit {
  double place = 0.0;
  double std_error = 0.0;  ///< of the place; 0 where the run does not show the parameter
};

std::optional<RunFit> refitted(const Problem& problem, const Candidate& start, Index parameter,
                               std::size_t run) {
  std::vector<bool> only(problem.experiment().runs.size(), false);
  only[run] = true;
  Candidate candidate = start;
  Eigen::VectorXd places = start.coordinates();
  const SearchedParameter known = start.parameters()[static_cast<std::size_t>(parameter)];
  // Behind the nuisances of the arm's uncertain numbers (Candidate::coordinates).
  const Index row = static_cast<Index>(start.nuisances.size()) + parameter;
  RunFit made;
  const auto here = [&](double place) {
    places(row) = place;
    candidate.put(places);
    return problem.residuals(candidate, only);
  };
  double place = places(row);
  double before = -1.0;
  double step = 0.0;
  for (int i = 0; i < kMostRunSteps; ++i) {
    const auto residuals = here(place);
    if (!residuals) return std::nullopt;
    const double squares = residuals->squaredNorm();
    if (before >= 0.0 && squares > before) {  // too far: half the way
      step *= 0.5;
      place -= step;
      continue;
    }
    before = squares;
    const double aside = place < 0.5 ? kPlaceStep : -kPlaceStep;
    const auto beside = here(place + aside);
    if (!beside) return std::nullopt;
    const Eigen::VectorXd slope = (*beside - *residuals) / aside;
    const double information = slope.squaredNorm();
    if (!(information > 0.0)) return std::nullopt;
    const Misfit left = misfit(problem.observations(), problem.experiment(), *residuals, only);
    const double scale = std::max(1.0, squares / left.count) * left.count / left.independent;
    made = {place, std::sqrt(scale / information)};
    step = std::clamp(-slope.dot(*residuals) / information, -place - Candidate::kBeyond,
                      1.0 + Candidate::kBeyond - place);
    place += step;
    made.place = place;
    const double value = known.value(place);
    if (std::abs(step) <= kLastStep * made.std_error ||
        std::abs(value - known.value(place - step)) <= kLastChange * std::abs(value)) {
      break;
    }
  }
  return made;
}

}  // namespace

std::optional<RunDrift> run_drift(const Problem& problem, const Candidate& candidate,
                                  std::size_t effect) {
  const Hypothesis& hypothesis = candidate.effects[effect];
  const std::size_t sized = hypothesis.size_parameter().value_or(0);
  const auto at = static_cast<Index>(candidate.values_before(effect) + sized);
  const SearchedParameter& parameter = hypothesis.parameters[sized];
  const auto& runs = problem.experiment().runs;
  std::vector<std::optional<RunFit>> fits(runs.size());
  in_parallel(runs.size(), [&](std::size_t r) {
    if (hypothesis.shows_in(runs[r].run.kind)) fits[r] = refitted(problem, candidate, at, r);
  });
  RunDrift made;
  made.effect = hypothesis.effect;
  made.parameter = parameter.name;
  made.unit = hypothesis.unit_of(parameter);
  double weights = 0.0;
  double sum = 0.0;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    if (!fits[r]) continue;
    const RunFit& fit = *fits[r];
    RunValue value{runs[r].run.id, parameter.value(fit.place), 0.0};
    const double slope =
        (parameter.value(fit.place + kPlaceStep) - parameter.value(fit.place - kPlaceStep)) /
        (2.0 * kPlaceStep);
    value.std_error = std::abs(slope) * fit.std_error;
    const double of_all = size_of(parameter, candidate.values[static_cast<std::size_t>(at)]);
    const bool is_shown = value.std_error > 0.0 && value.std_error < of_all;
    if (!is_shown || !std::isfinite(value.value)) continue;
    made.values.push_back(value);
    weights += 1.0 / (value.std_error * value.std_error);
    sum += value.value / (value.std_error * value.std_error);
  }
  if (made.values.size() < 2) return std::nullopt;
  made.mean = sum / weights;
  made.size = size_of(parameter, made.mean);
  for (const RunValue& value : made.values) {
    made.chi_squared += std::pow((value.value - made.mean) / value.std_error, 2);
  }
  made.probability =
      measured::chi_squared_tail(made.chi_squared, static_cast<double>(made.values.size() - 1));
  return made;
}

std::pair<RunValue, RunValue> RunDrift::range() const {
  const auto [least, most] = std::ranges::minmax(values, {}, &RunValue::value);
  return {least, most};
}

double RunDrift::spread() const {
  const auto [least, most] = range();
  return (most.value - least.value) / size;
}

}  // namespace flexarm::diagnose
