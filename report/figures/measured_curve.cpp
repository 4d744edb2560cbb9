#include "report/figures/measured_curve.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace flexarm::report {
namespace {

constexpr std::size_t kFewPoints = 200;
constexpr double kGap = 10.0;

void add_point(Series& series, double x, double y, double y_to) {
  series.x.push_back(x);
  series.y.push_back(y);
  if (series.style.filled) series.y_to.push_back(y_to);
}

void add_gap(Series& series, double x) {
  add_point(series, x, kNotDrawn, kNotDrawn);
}

}  // namespace

bool begins_band(const std::vector<double>& frequency_Hz, std::size_t i) {
  if (i == 0 || frequency_Hz.size() < 3) return false;
  double beside_Hz = 0.0;
  if (i >= 2) beside_Hz = frequency_Hz[i - 1] - frequency_Hz[i - 2];
  if (i + 1 < frequency_Hz.size()) {
    beside_Hz = std::max(beside_Hz, frequency_Hz[i + 1] - frequency_Hz[i]);
  }
  return frequency_Hz[i] - frequency_Hz[i - 1] > kGap * beside_Hz;
}

Series measured_curve(std::string name, const std::vector<double>& frequency_Hz,
                      const std::vector<double>& values) {
  Series series{std::move(name), {}, {}, {.line_width_px = 1.1}};
  if (values.size() < kFewPoints) {
    series.style.line = Line::none;
    series.style.marker = Marker::disc;
    series.style.marker_size = 0.35;
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (begins_band(frequency_Hz, i)) add_gap(series, frequency_Hz[i]);
    add_point(series, frequency_Hz[i], values[i], 0.0);
  }
  return series;
}

Series measured_interval(std::string name, const std::vector<double>& frequency_Hz,
                         const std::vector<double>& low, const std::vector<double>& high) {
  Series series{std::move(name), {}, {}, {.colour = grey, .tint = 0.6}};
  series.style.filled = low.size() >= kFewPoints;
  series.style.line_width_px = 3.0;
  for (std::size_t i = 0; i < low.size(); ++i) {
    if (series.style.filled) {
      if (begins_band(frequency_Hz, i)) add_gap(series, frequency_Hz[i]);
      add_point(series, frequency_Hz[i], low[i], high[i]);
    } else {
      add_point(series, frequency_Hz[i], low[i], 0.0);
      add_point(series, frequency_Hz[i], high[i], 0.0);
      add_gap(series, frequency_Hz[i]);
    }
  }
  return series;
}

}  // namespace flexarm::report
