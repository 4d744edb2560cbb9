#include "report/figures/refined_curve.hpp"

#include "report/figures/figure_layout.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace flexarm::report {
namespace {

constexpr int kSteps = 1000;
constexpr int kMostHalvings = 12;
constexpr double kLargestStep = 0.1;

}  // namespace

ResponseCurve refined_curve(const std::function<std::complex<double>(double)>& value,
                            double from_Hz, double to_Hz, Scale scale) {
  const Axis axis{.scale = scale};
  const double from = on_scale(from_Hz, axis);
  const double to = on_scale(to_Hz, axis);
  std::vector<std::pair<double, std::complex<double>>> points;
  const auto point = [&](double place) { return std::pair(place, value(from_scale(place, axis))); };
  for (int k = 0; k <= kSteps; ++k) points.push_back(point(from + (to - from) * k / kSteps));
  for (int halving = 0; halving < kMostHalvings; ++halving) {
    decltype(points) finer;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      finer.push_back(points[i]);
      const auto& [place, here] = points[i];
      const auto& [next_place, next] = points[i + 1];
      if (std::abs(next - here) > kLargestStep * std::max(std::abs(here), std::abs(next))) {
        finer.push_back(point(0.5 * (place + next_place)));
      }
    }
    finer.push_back(points.back());
    const bool settled = finer.size() == points.size();
    points = std::move(finer);
    if (settled) break;
  }
  ResponseCurve curve;
  for (const auto& [place, response] : points) {
    curve.frequency_Hz.push_back(from_scale(place, axis));
    curve.response.push_back(response);
  }
  return curve;
}

}  // namespace flexarm::report
