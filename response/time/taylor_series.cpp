#include "response/time/taylor_series.hpp"

#include <cmath>
#include <numbers>

namespace flexarm::response {

std::vector<double> taylor_coefficients(
    const std::function<std::complex<double>(std::complex<double>)>& f, double radius, int points,
    int count) {
  std::vector<double> coefficients(static_cast<std::size_t>(count));
  for (int j = 0; j < points / 2; ++j) {
    const double angle = std::numbers::pi * (2.0 * j + 1.0) / points;
    const std::complex<double> value = f(std::polar(radius, angle));
    for (std::size_t k = 0; k < coefficients.size(); ++k) {
      coefficients[k] += (value * std::polar(1.0, -static_cast<double>(k) * angle)).real();
    }
  }
  double scale = 2.0 / points;
  for (double& coefficient : coefficients) {
    coefficient *= scale;
    scale /= radius;
  }
  return coefficients;
}

int points_on_circle(double radius_ratio) {
  constexpr double kBits = 54.0;
  return 2 * static_cast<int>(std::ceil(-0.5 * kBits / std::log2(radius_ratio)));
}

}  // namespace flexarm::response
