#include "diagnose/unknown/jackknife.hpp"

#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

namespace flexarm::diagnose {

JackknifedRatio jackknifed_ratio(std::span<const double> values, std::span<const double> totals) {
  const double sum = std::accumulate(values.begin(), values.end(), 0.0);
  const double total = std::accumulate(totals.begin(), totals.end(), 0.0);
  std::vector<double> without;
  for (std::size_t g = 0; g < values.size(); ++g) {
    without.push_back((sum - values[g]) / (total - totals[g]));
  }
  const auto n = static_cast<double>(without.size());
  const double mean = std::accumulate(without.begin(), without.end(), 0.0) / n;
  double squares = 0.0;
  for (const double one : without) squares += (one - mean) * (one - mean);
  return {sum / total, std::sqrt((n - 1.0) / n * squares)};
}

}  // namespace flexarm::diagnose
