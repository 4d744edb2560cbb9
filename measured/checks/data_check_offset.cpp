#include "measured/checks/data_check_offset.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace flexarm::measured {

namespace {

constexpr std::size_t kMostRestSamples = 200;

struct Offset {
  double size = 0.0;
  double error = 0.0;  ///< standard error
};

Offset offset_of(std::span<const double> x, std::span<const double> y, double floor_power) {
  double weights = 0.0;
  double sum = 0.0;
  double motion = 0.0;
  for (std::size_t k = 0; k < y.size(); ++k) {
    motion = std::max(motion, std::abs(y[k]));
    const double weight = 1.0 / std::max(floor_power + motion * motion, 1e-300);
    weights += weight;
    sum += weight * (x[k] - y[k]);
  }
  return {sum / weights, 1.0 / std::sqrt(weights)};
}

}  // namespace

std::vector<DataFinding> check_offsets(const Comparison& comparison,
                                       std::span<const std::vector<double>> described) {
  const auto& options = comparison.options;
  const double rest = 0.0;
  const bool is_described = !described.empty() && comparison.usable[0];
  std::vector<DataFinding> findings;
  for (std::size_t i = 1; i < comparison.signals.size(); ++i) {
    const CheckedSignal& signal = comparison.signals[i];
    const bool answers_at_once = signal.is(arm::SensorKind::tip_acceleration);
    if (!comparison.usable[i] || (!is_described && answers_at_once)) continue;
    std::span<const double> y = is_described ? std::span(described[i]) : std::span(&rest, 1);
    y = y.first(std::min({y.size(), signal.values.size(), kMostRestSamples}));
    const Offset offset = offset_of(signal.values, y, comparison.transforms.of[i].floor_power);
    const double size = std::abs(offset.size);
    if (!(size > options.least_offset * signal.deviation) ||
        !(size > options.offset_errors * offset.error)) {
      continue;
    }
    findings.push_back({Fault::offset, signal.name, 0, 0.0, offset.size,
                        fmt::format("{} reads {:.4g} {} at rest (standard error {:.1g}, {:.2g} of "
                                    "its standard deviation)",
                                    signal.name, offset.size, arm::unit(*signal.sensor),
                                    offset.error, size / signal.deviation)});
  }
  return findings;
}

}  // namespace flexarm::measured
