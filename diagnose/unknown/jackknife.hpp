#pragma once

#include <span>

namespace flexarm::diagnose {

/// Returns the standard error of a statistic by its values without one part of the data each
/// [EfronTibshirani1993].
double jackknife_std_error(std::span<const double> without_one);

struct JackknifedRatio {
  double value = 0.0;
  double std_error = 0.0;
};

/// sum values/sum totals, with its standard error by the jackknife. Both are of the same parts, two
/// or more.
JackknifedRatio jackknifed_ratio(std::span<const double> values, std::span<const double> totals);

}  // namespace flexarm::diagnose
