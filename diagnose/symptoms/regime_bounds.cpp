#include "diagnose/symptoms/regime_bounds.hpp"

#include <algorithm>
#include <cmath>

namespace flexarm::diagnose {

namespace {

/// Returns the distinct values of an ascending sequence; more than kRegimes of them are cut short.
std::vector<RegimeBounds> distinct_values(const std::vector<double>& ascending, double apart) {
  std::vector<RegimeBounds> made;
  for (const double value : ascending) {
    if (made.empty() || value - made.back().from > apart) made.push_back({value, value});
    made.back().to = value;
    if (made.size() > kRegimes) break;
  }
  return made;
}

}  // namespace

std::vector<RegimeBounds> equal_regimes(std::vector<double> values) {
  if (values.empty()) return {};
  std::ranges::sort(values);
  const double apart = kSameValue * std::max(std::abs(values.front()), std::abs(values.back()));
  std::vector<RegimeBounds> made = distinct_values(values, apart);
  if (made.size() <= kRegimes) return made;
  made.clear();
  for (std::size_t quarter = 1; quarter <= kRegimes; ++quarter) {
    const double from = made.empty() ? values.front() : made.back().to;
    const double to = values[(quarter * values.size() + kRegimes - 1) / kRegimes - 1];
    if (made.empty() || to - from > apart) {
      made.push_back({from, to});
    } else {
      made.back().to = to;
    }
  }
  return made;
}

std::vector<RegimeBounds> equal_parts(double to) {
  std::vector<RegimeBounds> made;
  for (std::size_t part = 0; part < kRegimes; ++part) {
    const auto parts = static_cast<double>(kRegimes);
    made.push_back(
        {to * static_cast<double>(part) / parts, to * static_cast<double>(part + 1) / parts});
  }
  return made;
}

}  // namespace flexarm::diagnose
