#include "response/time/sine_correlation.hpp"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

namespace flexarm::response {

using Eigen::Index;

SineCorrelation::SineCorrelation(int samples_per_cycle, int cycles)
    : samples_per_cycle_(samples_per_cycle), cycles_(cycles) {
  const Index n = samples_per_cycle;
  const Index samples = n * cycles;
  sine_.resize(n, 2);
  for (Index k = 0; k < n; ++k) {
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(k) / samples_per_cycle;
    sine_.row(k) << std::cos(angle), std::sin(angle);
  }
  drift_.resize(samples, 3);
  for (Index k = 0; k < samples; ++k) {
    const double t = (2.0 * static_cast<double>(k) + 1.0) / static_cast<double>(samples) - 1.0;
    drift_.row(k) << 1.0, t, t * t;
  }
  Eigen::MatrixXd means(cycles, 3);
  for (Index m = 0; m < cycles; ++m) {
    means.row(m) = drift_.middleRows(m * n, n).colwise().mean();
  }
  of_means_ = means.colPivHouseholderQr().solve(Eigen::MatrixXd::Identity(cycles, cycles));
}

SineCorrelation::Part SineCorrelation::of(std::span<const double> samples) const {
  const Eigen::Map<const Eigen::VectorXd> all(samples.data(), static_cast<Index>(samples.size()));
  // Far from 0 an angle that oscillates little would lose digits.
  Eigen::VectorXd y = all.array() - samples.front();
  const Eigen::VectorXd means =
      y.reshaped(Index{samples_per_cycle_}, Index{cycles_}).colwise().mean();
  y -= drift_ * (of_means_ * means);
  const Eigen::MatrixXd parts = sine_.transpose() *
                                y.reshaped(Index{samples_per_cycle_}, Index{cycles_}) *
                                (2.0 / samples_per_cycle_);
  Part made;
  for (Index m = 0; m < cycles_; ++m) {
    made.cycles.emplace_back(parts(1, m), parts(0, m));
    made.whole += made.cycles.back() / static_cast<double>(cycles_);
  }
  return made;
}

double coherence_of(std::span<const std::complex<double>> cycles) {
  std::complex<double> sum;
  double power = 0.0;
  for (const auto& cycle : cycles) {
    sum += cycle;
    power += std::norm(cycle);
  }
  const double coherence = std::norm(sum) / (static_cast<double>(cycles.size()) * power);
  return coherence > 0.0 ? std::min(1.0, coherence) : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace flexarm::response
