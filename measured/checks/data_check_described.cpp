#include "measured/checks/data_check_described.hpp"

#include "measured/spectra/robust.hpp"

#include <algorithm>
#include <complex>
#include <functional>
#include <utility>

namespace flexarm::measured {

namespace {

using AccelerationLines = std::vector<std::complex<double>>;

/// A signal's transform, of the acceleration of what moves.
AccelerationLines lines_of(const CheckedSignal& signal, const Transforms& transforms,
                           std::size_t at) {
  const int order = signal.is_torque() ? 0 : 2 - arm::derivative_order(*signal.sensor);
  AccelerationLines lines;
  for (std::size_t bin = 0; bin < transforms.bins(); ++bin) {
    lines.push_back(transforms.derivative(at, order, bin));
  }
  return lines;
}

std::vector<AccelerationLines> all_lines(std::span<const CheckedSignal> signals,
                                         const Transforms& transforms) {
  std::vector<AccelerationLines> all;
  for (std::size_t i = 0; i < signals.size(); ++i) {
    all.push_back(lines_of(signals[i], transforms, i));
  }
  return all;
}

/// What the arm reads in the place of the signals, the torque first; nothing where it cannot.
std::vector<std::vector<double>> readings_of(std::span<const CheckedSignal> signals,
                                             double period_s, const DescribedArm& arm) {
  std::vector<arm::Sensor> sensors;
  for (const auto& signal : signals.subspan(1)) sensors.push_back(*signal.sensor);
  auto values = arm(signals[0].values, period_s, sensors);
  if (values.empty()) return values;
  values.insert(values.begin(), {signals[0].values.begin(), signals[0].values.end()});
  return values;
}

Transforms transforms_of(std::span<const CheckedSignal> signals,
                         const std::vector<std::vector<double>>& values,
                         const Transforms& recorded) {
  std::vector<CheckedSignal> described(signals.begin(), signals.end());
  for (std::size_t i = 1; i < described.size(); ++i) {
    described[i].values = values[i];
    described[i].deviation = standard_deviation(values[i]);
  }
  return transform(described, recorded.period_s, recorded.from_rest);
}

/// X_a Y_b and X_b Y_a.
struct Sides {
  LineValues left;
  LineValues right;
};

Sides sides(const std::vector<AccelerationLines>& x, const std::vector<AccelerationLines>& y,
            std::size_t a, std::size_t b) {
  return {[&x, &y, a, b](std::size_t bin) { return x[a][bin] * y[b][bin]; },
          [&x, &y, a, b](std::size_t bin) { return x[b][bin] * y[a][bin]; }};
}

}  // namespace

DescribedStretch::DescribedStretch(std::span<const CheckedSignal> signals,
                                   const Transforms& recorded, const DescribedArm& arm) {
  if (!arm) return;
  values = readings_of(signals, recorded.period_s, arm);
  if (values.empty()) return;
  const auto x = all_lines(signals, recorded);
  const auto y = all_lines(signals, transforms_of(signals, values, recorded));
  for (std::size_t a = 1; a < signals.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      const auto [left, right] = sides(x, y, a, b);
      relations.push_back({a, b, fit_gain(recorded, left, right)});
    }
  }
}

RecordedLines::RecordedLines(std::span<const CheckedSignal> signals,
                             const std::vector<bool>& usable, const Transforms& recorded,
                             CountedBlocks counted)
    : signals_(signals), recorded_(&recorded), lines_(all_lines(signals, recorded)) {
  for (std::size_t a = 1; a < signals.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      if (!usable[a] || !usable[b]) continue;
      std::vector<bool> blocks;
      if (counted == CountedBlocks::coherent) {
        blocks = coherent_among_blocks(
            recorded, [&](std::size_t bin) { return lines_[a][bin]; },
            [&](std::size_t bin) { return lines_[b][bin]; });
        if (std::ranges::none_of(blocks, std::identity())) continue;
      }
      pairs_.push_back({a, b, std::move(blocks)});
    }
  }
}

double RecordedLines::distance_from(const DescribedArm& arm) const {
  if (pairs_.empty()) return 1.0;
  const auto values = readings_of(signals_, recorded_->period_s, arm);
  if (values.empty()) return 1.0;
  const auto described = all_lines(signals_, transforms_of(signals_, values, *recorded_));
  double sum = 0.0;
  for (const Pair& pair : pairs_) {
    const auto [left, right] = sides(lines_, described, pair.a, pair.b);
    sum += distance(*recorded_, left, right, pair.counted);
  }
  return sum / static_cast<double>(pairs_.size());
}

double described_distance(std::span<const CheckedSignal> signals, const std::vector<bool>& usable,
                          const Transforms& recorded, const DescribedArm& arm) {
  return RecordedLines(signals, usable, recorded, CountedBlocks::all).distance_from(arm);
}

}  // namespace flexarm::measured
