#include "measured/checks/data_check_signal.hpp"

#include "measured/spectra/robust.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace flexarm::measured {

std::vector<CheckedSignal> signals_of(const TimeRecord& record, std::size_t first,
                                      std::size_t count) {
  std::vector<CheckedSignal> signals;
  const auto add = [&](std::string name, std::optional<arm::Sensor> sensor,
                       const std::vector<double>& values) {
    const auto part = std::span(values).subspan(first, count);
    signals.push_back({std::move(name), sensor, part, standard_deviation(part)});
  };
  add("torque", std::nullopt, record.torque_N_m);
  for (const auto& channel : record.channels) {
    add(arm::to_string(channel.sensor), channel.sensor, channel.values);
  }
  return signals;
}

std::vector<double> without_hum(const CheckedSignal& signal, double period_s) {
  constexpr double kMains_Hz[] = {50.0, 60.0};
  const auto samples = static_cast<Eigen::Index>(signal.values.size());
  const Eigen::Map<const Eigen::VectorXd> values(signal.values.data(), samples);
  if (period_s * 120.0 >= 1.0) return {values.begin(), values.end()};
  Eigen::MatrixXd waves = Eigen::MatrixXd::Ones(samples, 5);
  for (Eigen::Index i = 0; i < 2; ++i) {
    const Eigen::ArrayXd phase =
        2.0 * std::numbers::pi * kMains_Hz[i] * period_s *
        Eigen::ArrayXd::LinSpaced(samples, 0.0, static_cast<double>(samples - 1));
    waves.col(2 * i + 1) = phase.cos();
    waves.col(2 * i + 2) = phase.sin();
  }
  const Eigen::MatrixXd normal = waves.transpose() * waves;
  const Eigen::VectorXd left = values - waves * normal.ldlt().solve(waves.transpose() * values);
  return {left.begin(), left.end()};
}

const CheckedSignal* hub_signal(std::span<const CheckedSignal> signals,
                                const std::vector<bool>& usable) {
  for (const auto kind : {arm::SensorKind::hub_velocity, arm::SensorKind::hub_angle}) {
    for (std::size_t i = 1; i < signals.size(); ++i) {
      if (usable[i] && signals[i].is(kind)) return &signals[i];
    }
  }
  return nullptr;
}

std::vector<EqualRun> equal_runs(std::span<const double> values, std::size_t least) {
  std::vector<EqualRun> runs;
  for (std::size_t first = 0; first < values.size();) {
    std::size_t last = first + 1;
    while (last < values.size() && values[last] == values[first]) ++last;
    if (last - first >= least) runs.push_back({first, last - first});
    first = last;
  }
  return runs;
}

double reading_noise(std::span<const double> values) {
  std::vector<double> bends;
  for (std::size_t k = 2; k < values.size(); ++k) {
    bends.push_back(values[k] - 2.0 * values[k - 1] + values[k - 2]);
  }
  return robust_deviation(bends) / std::sqrt(6.0);
}

std::optional<double> lattice_step(std::span<const double> values, double least_step) {
  constexpr double kDigits = 3e-7;  // half a unit of the seventh digit, and rounding of a product
  constexpr double kOff = 0.02;     // of a step
  std::vector<double> sorted(values.begin(), values.end());
  std::ranges::sort(sorted);
  const double same = kDigits * std::max(std::abs(sorted.front()), std::abs(sorted.back()));
  double step = 0.0;
  std::size_t levels = 1;
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    const double gap = sorted[i] - sorted[i - 1];
    if (gap <= 2.0 * same) continue;
    ++levels;
    step = step == 0.0 ? gap : std::min(step, gap);
    if (step < least_step) return std::nullopt;
  }
  if (levels < 3) return std::nullopt;
  // The smallest gap is off by rounding; over the whole range that counts levels times.
  step = (sorted.back() - sorted.front()) / std::round((sorted.back() - sorted.front()) / step);
  for (const double value : sorted) {
    const double at = (value - sorted.front()) / step;
    if (std::abs(at - std::round(at)) * step > kOff * step + 2.0 * same) return std::nullopt;
  }
  return step;
}

}  // namespace flexarm::measured
