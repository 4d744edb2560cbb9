#include "measured/spectra/robust.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace flexarm::measured {

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const auto at = std::min(values.size() - 1,
                           static_cast<std::size_t>(share * static_cast<double>(values.size())));
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(at);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double median(std::vector<double> values) {
  return quantile(std::move(values), 0.5);
}

double robust_deviation(std::span<const double> values) {
  constexpr double kNormal = 1.4826022185056018;  // 1/Phi^-1(3/4)
  std::vector<double> sizes(values.size());
  std::ranges::transform(values, sizes.begin(), [](double value) { return std::abs(value); });
  return kNormal * median(std::move(sizes));
}

double mean(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double standard_deviation(std::span<const double> values) {
  const double centre = mean(values);
  double sum = 0.0;
  for (const double value : values) sum += (value - centre) * (value - centre);
  return std::sqrt(sum / static_cast<double>(values.size()));
}

std::string more_places(std::size_t places) {
  if (places <= 1) return "";
  return fmt::format(", and at {} more sample{}", places - 1, places == 2 ? "" : "s");
}

}  // namespace flexarm::measured
