#include "diagnose/unknown/jackknife.hpp"

#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

namespace flexarm::diagnose {

double jackknife_std_error(std::span<const double> without_one) {
  const auto n = static_cast<double>(without_one.size());
  const double mean = std::accumulate(without_one.begin(), without_one.end(), 0.0) / n;
  double squares = 0.0;
  for (const double one : without_one) squares += (one - mean) * (one - mean);
  return std::sqrt((n - 1.0) / n * squares);
}

JackknifedRatio jackknifed_ratio(std::span<const double> values, std::span<const double> totals) {
  const double sum = std::accumulate(values.begin(), values.end(), 0.0);
  const double total = std::accumulate(totals.begin(), totals.end(), 0.0);
  std::vector<double> without;
  for (std::size_t g = 0; g < values.size(); ++g) {
    without.push_back((sum - values[g]) / (total - totals[g]));
  }
  return {sum / total, jackknife_std_error(without)};
}

}  // namespace flexarm::diagnose
