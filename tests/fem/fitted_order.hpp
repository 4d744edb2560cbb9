#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace flexarm::fem {

/// Slope of log(error) over log(1/elements) by least squares.
inline double fitted_order(const std::vector<int>& elements, const std::vector<double>& errors) {
  double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  const auto n = static_cast<double>(elements.size());
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const double x = -std::log(elements[i]);
    const double y = std::log(errors[i]);
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

}  // namespace flexarm::fem
