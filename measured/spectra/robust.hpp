#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace flexarm::measured {

/// The upper median; of nothing, 0.
double median(std::vector<double> values);

/// The value that a fraction `share` of `values` do not exceed; of nothing, 0.
double quantile(std::vector<double> values, double share);

/// 1.4826 median |x|: the standard deviation of normal values of mean 0, whatever a few of them
/// are.
double robust_deviation(std::span<const double> values);

double mean(std::span<const double> values);

/// Root mean square distance from the mean.
double standard_deviation(std::span<const double> values);

/// "", ", and at 1 more place", ", and at 7 more places": of a list whose first is told.
std::string more_places(std::size_t places);

}  // namespace flexarm::measured
