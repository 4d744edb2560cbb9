#pragma once

#include <span>

namespace flexarm::diagnose {

struct JackknifedRatio {
  double value = 0.0;
  double std_error = 0.0;
};

/// sum values/sum totals, with its standard error by the delete-one jackknife
/// [EfronTibshirani1993]. Both are of the same parts, two or more.
JackknifedRatio jackknifed_ratio(std::span<const double> values, std::span<const double> totals);

}  // namespace flexarm::diagnose
