#pragma once

#include "diagnose/search/problem.hpp"

#include <limits>

namespace flexarm::diagnose {

/// Returns `start` with the parameter of its last effect, its only one, at that of `count`
/// equidistant places of its range that leaves the smallest residuals: a start for a fit.
inline Candidate start_on_grid(const Problem& problem, Candidate start, int count) {
  const SearchedParameter parameter = start.effects.back().parameters.at(0);
  Candidate best = start;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < count; ++i) {
    start.values.back() = parameter.value((i + 0.5) / count);
    const auto residuals = problem.residuals(start, problem.estimation_runs());
    if (!residuals || residuals->squaredNorm() >= least) continue;
    least = residuals->squaredNorm();
    best = start;
  }
  return best;
}

}  // namespace flexarm::diagnose
