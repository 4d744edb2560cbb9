#include "report/figures/robust_range.hpp"

#include <algorithm>

namespace flexarm::report {
namespace {

constexpr std::size_t kFewValues = 20;
constexpr std::size_t kMostOutliers = 200;  // one in so many, at each end
constexpr double kFarOut = 2.0;             // of the range of the others

}  // namespace

RobustRange robust_range(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t n = values.size();
  RobustRange made{values.front(), values.back()};
  if (n < kFewValues) return made;
  const std::size_t cut = std::max<std::size_t>(1, n / kMostOutliers);
  const double low = values[cut];
  const double high = values[n - 1 - cut];
  const double reach = kFarOut * (high - low);
  if (!(reach > 0.0)) return made;
  const auto first = std::ranges::lower_bound(values, low - reach);
  const auto last = std::ranges::upper_bound(values, high + reach);
  made.low = *first;
  made.high = *(last - 1);
  made.outside = n - static_cast<std::size_t>(last - first);
  return made;
}

}  // namespace flexarm::report
