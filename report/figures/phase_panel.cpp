#include "report/figures/phase_panel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <utility>

namespace flexarm::report {
namespace {

constexpr double kWrap_deg = 225.0;

}  // namespace

Series phase_series(std::string name, const std::vector<double>& frequency_Hz,
                    const std::vector<double>& phase_deg, const Style& style) {
  Series series{std::move(name), {}, {}, style};
  for (std::size_t i = 0; i < phase_deg.size(); ++i) {
    if (i > 0 && std::abs(phase_deg[i] - phase_deg[i - 1]) > kWrap_deg) {
      series.x.push_back(frequency_Hz[i]);
      series.y.push_back(std::numeric_limits<double>::quiet_NaN());
    }
    series.x.push_back(frequency_Hz[i]);
    series.y.push_back(phase_deg[i]);
  }
  return series;
}

Axis phase_axis(std::span<const Series> curves) {
  Axis axis{.label = "phase", .unit = "deg"};
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -lowest;
  for (const Series& series : curves) {
    for (const double phase : series.y) {
      lowest = std::fmin(lowest, phase);
      highest = std::fmax(highest, phase);
    }
  }
  if (!(lowest <= highest)) return axis;
  const int first = static_cast<int>(std::floor(lowest / 90.0 + 0.25));
  const int last = static_cast<int>(std::ceil(highest / 90.0 - 0.25));
  int step = 1;
  while (5 * step < last - first) step *= 2;
  const int lowest_tick = step * static_cast<int>(std::ceil(static_cast<double>(first) / step));
  for (int quarter = lowest_tick; quarter <= last; quarter += step) {
    axis.ticks.push_back(
        {90.0 * quarter, fmt::format("{}{}", quarter < 0 ? "−" : "", std::abs(90 * quarter))});
  }
  axis.minimum = std::min(lowest, axis.ticks.front().position) - 20.0;
  axis.maximum = std::max(highest, axis.ticks.back().position) + 20.0;
  return axis;
}

}  // namespace flexarm::report
