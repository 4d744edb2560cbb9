#include "measured/files/resampling.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace flexarm::measured {

namespace {

/// Samples that lie closer make a curve through them out of their noise.
constexpr double kClosest_periods = 0.3;

/// Mean over [from_s, from_s + period_s) of what is held from sample to sample; `i` is the sample
/// that holds at from_s.
double mean_of_held(const std::vector<double>& times_s, const std::vector<double>& values,
                    double from_s, double period_s, std::size_t& i) {
  while (i + 1 < times_s.size() && times_s[i + 1] <= from_s) ++i;
  const double to_s = from_s + period_s;
  double integral = 0.0;
  for (std::size_t j = i; j < times_s.size() && times_s[j] < to_s; ++j) {
    const double end_s = j + 1 < times_s.size() ? std::min(times_s[j + 1], to_s) : to_s;
    integral += values[j] * (end_s - std::max(times_s[j], from_s));
  }
  return integral / period_s;
}

/// Samples of a curve, at times that lie no closer than `kClosest_periods`.
struct Nodes {
  std::vector<double> times_s;
  std::vector<double> values;
};

/// Samples that lie closer together than that are one, their mean.
Nodes nodes_of(const std::vector<double>& times_s, const std::vector<double>& values,
               double period_s) {
  Nodes nodes;
  std::size_t first = 0;
  for (std::size_t k = 1; k <= times_s.size(); ++k) {
    if (k < times_s.size() && times_s[k] - times_s[first] < kClosest_periods * period_s) continue;
    double time_s = 0.0;
    double value = 0.0;
    const auto count = static_cast<double>(k - first);
    for (; first < k; ++first) {
      time_s += times_s[first] / count;
      value += values[first] / count;
    }
    nodes.times_s.push_back(time_s);
    nodes.values.push_back(value);
  }
  return nodes;
}

/// `i` is the node in front of the last time asked for.
double cubic_at(const Nodes& nodes, double time_s, std::size_t& i) {
  constexpr std::size_t kPoints = 4;
  const auto& times_s = nodes.times_s;
  while (i + 2 < times_s.size() && times_s[i + 1] <= time_s) ++i;
  const std::size_t first =
      std::min(i == 0 ? 0 : i - 1, times_s.size() - std::min(times_s.size(), kPoints));
  const std::size_t last = std::min(first + kPoints, times_s.size());
  double value = 0.0;
  for (std::size_t j = first; j < last; ++j) {
    double weight = 1.0;
    for (std::size_t k = first; k < last; ++k) {
      if (k != j) weight *= (time_s - times_s[k]) / (times_s[j] - times_s[k]);
    }
    value += weight * nodes.values[j];
  }
  return value;
}

}  // namespace

std::vector<double> held_means(const std::vector<double>& times_s,
                               const std::vector<double>& values, const std::vector<double>& at_s,
                               double period_s) {
  std::vector<double> means;
  std::size_t i = 0;
  for (const double time_s : at_s) {
    means.push_back(mean_of_held(times_s, values, time_s, period_s, i));
  }
  return means;
}

std::vector<double> linear_values(const std::vector<double>& times_s,
                                  const std::vector<double>& values,
                                  const std::vector<double>& at_s) {
  std::vector<double> linear;
  std::size_t i = 0;
  for (const double at : at_s) {
    const double time_s = std::min(at, times_s.back());
    while (i + 2 < times_s.size() && times_s[i + 1] <= time_s) ++i;
    const double part = (time_s - times_s[i]) / (times_s[i + 1] - times_s[i]);
    linear.push_back(std::lerp(values[i], values[i + 1], part));
  }
  return linear;
}

std::vector<double> cubic_values(const std::vector<double>& times_s,
                                 const std::vector<double>& values, const std::vector<double>& at_s,
                                 double period_s) {
  const Nodes nodes = nodes_of(times_s, values, period_s);
  std::vector<double> cubic;
  std::size_t i = 0;
  for (const double time_s : at_s) cubic.push_back(cubic_at(nodes, time_s, i));
  return cubic;
}

}  // namespace flexarm::measured
