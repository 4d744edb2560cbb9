#include "response/time/first_crossing.hpp"

#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace flexarm::response {

namespace {

constexpr double kNarrowestInterval = 0x1p-40;

double slope(std::span<const double> series, double r) {
  double sum = 0.0;
  for (std::size_t k = series.size(); k-- > 1;) sum = sum * r + static_cast<double>(k) * series[k];
  return sum;
}

double second_derivative(std::span<const double> series, double r) {
  double sum = 0.0;
  for (std::size_t k = series.size(); k-- > 2;) {
    sum = sum * r + static_cast<double>(k * (k - 1)) * series[k];
  }
  return sum;
}

struct Search {
  std::span<const double> series;
  double third_derivative = 0.0;  // a bound of its size on [0, 1]

  std::optional<double> within(double a, double pa, double b, double pb) const {
    const double length = b - a;
    const double middle = 0.5 * (a + b);
    const double curvature =
        std::abs(second_derivative(series, middle)) + 0.5 * length * third_derivative;
    if (pb >= 0.0 && std::min(pa, pb) >= curvature * length * length / 8.0) return std::nullopt;
    if (length < kNarrowestInterval) return pb < 0.0 ? std::optional(b) : std::nullopt;
    if (pa > 0.0 && pb < 0.0 && -slope(series, middle) > curvature * length / 2.0) {
      return bracketed(a, pa, b, pb);
    }
    const double pm = value(series, middle);
    if (const auto early = within(a, pa, middle, pm)) return early;
    return pm < 0.0 ? std::optional(middle) : within(middle, pm, b, pb);
  }

  double bracketed(double a, double pa, double b, double pb) const {
    constexpr int kBits = 53;
    std::uintmax_t evaluations = 100;
    const auto [low, high] = boost::math::tools::toms748_solve(
        [this](double r) { return value(series, r); }, a, b, pa, pb,
        boost::math::tools::eps_tolerance<double>(kBits), evaluations);
    return 0.5 * (low + high);
  }
};

}  // namespace

double value(std::span<const double> series, double r) {
  double sum = 0.0;
  for (std::size_t k = series.size(); k-- > 0;) sum = sum * r + series[k];
  return sum;
}

std::optional<double> first_crossing(std::span<const double> series) {
  if (series.empty()) return std::nullopt;
  if (series[0] < 0.0) return 0.0;
  Search search{series};
  for (std::size_t k = 3; k < series.size(); ++k) {
    search.third_derivative += static_cast<double>(k * (k - 1) * (k - 2)) * std::abs(series[k]);
  }
  const double end = value(series, 1.0);
  // No bound would ever hold in the halves of an interval.
  if (!std::isfinite(end) || !std::isfinite(search.third_derivative)) return std::nullopt;
  return search.within(0.0, series[0], 1.0, end);
}

}  // namespace flexarm::response
