#include "measured/checks/data_check_described.hpp"

#include "measured/spectra/robust.hpp"

#include <complex>

namespace flexarm::measured {

namespace {

using Lines = std::vector<std::complex<double>>;

/// A signal's transform, of the acceleration of what moves.
Lines lines_of(const CheckedSignal& signal, const Transforms& transforms, std::size_t at) {
  const int order = signal.is_torque() ? 0 : 2 - arm::derivative_order(*signal.sensor);
  Lines lines;
  for (std::size_t bin = 0; bin < transforms.bins(); ++bin) {
    lines.push_back(transforms.derivative(at, order, bin));
  }
  return lines;
}

std::vector<Lines> all_lines(std::span<const CheckedSignal> signals, const Transforms& transforms) {
  std::vector<Lines> all;
  for (std::size_t i = 0; i < signals.size(); ++i) {
    all.push_back(lines_of(signals[i], transforms, i));
  }
  return all;
}

}  // namespace

DescribedStretch::DescribedStretch(std::span<const CheckedSignal> signals,
                                   const Transforms& recorded, const DescribedArm& arm) {
  if (!arm) return;
  std::vector<arm::Sensor> sensors;
  for (const auto& signal : signals.subspan(1)) sensors.push_back(*signal.sensor);
  values = arm(signals[0].values, recorded.period_s, sensors);
  values.insert(values.begin(), {signals[0].values.begin(), signals[0].values.end()});
  std::vector<CheckedSignal> described(signals.begin(), signals.end());
  for (std::size_t i = 1; i < described.size(); ++i) {
    described[i].values = values[i];
    described[i].deviation = standard_deviation(values[i]);
  }
  relations = described_relations(
      signals, recorded, transform(described, recorded.period_s, recorded.from_rest));
}

std::vector<DescribedRelation> described_relations(std::span<const CheckedSignal> signals,
                                                   const Transforms& recorded,
                                                   const Transforms& described) {
  const auto x = all_lines(signals, recorded);
  const auto y = all_lines(signals, described);
  std::vector<DescribedRelation> relations;
  for (std::size_t a = 1; a < signals.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      const auto left = [&](std::size_t bin) { return x[a][bin] * y[b][bin]; };
      const auto right = [&](std::size_t bin) { return x[b][bin] * y[a][bin]; };
      relations.push_back({a, b, fit_gain(recorded, left, right)});
    }
  }
  return relations;
}

}  // namespace flexarm::measured
