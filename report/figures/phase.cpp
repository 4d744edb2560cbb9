#include "report/figures/phase.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

namespace flexarm::report {
namespace {

constexpr double kWrapFrom_deg = -225.0;
constexpr double kHalfTurn_deg = 180.0;
constexpr double kTurn_deg = 360.0;
/// A step of half a turn has no direction: what damping or rounding makes of it is less.
constexpr double kUndecided_deg = 0.01;
/// A curve that is farther from its reference goes on a turn nearer. Between two poles, or two
/// zeros, that lie apart it is half a turn away.
constexpr double kFarthest_deg = 270.0;

double angle_deg(std::complex<double> value) {
  if (value == 0.0) return std::numeric_limits<double>::quiet_NaN();
  return std::arg(value) * kHalfTurn_deg / std::numbers::pi;
}

double principal_deg(double angle) {
  return angle - kTurn_deg * std::floor((angle - kWrapFrom_deg) / kTurn_deg);
}

/// The phase of a reference at the first of its frequencies that is not below, NaN beyond them.
double phase_at(const PhaseCurve& reference, double frequency_Hz) {
  const auto at = std::ranges::lower_bound(reference.frequency_Hz, frequency_Hz);
  if (at == reference.frequency_Hz.end()) return std::numeric_limits<double>::quiet_NaN();
  return reference.phase_deg[static_cast<std::size_t>(at - reference.frequency_Hz.begin())];
}

}  // namespace

std::vector<double> principal_phase_deg(const std::vector<std::complex<double>>& response) {
  std::vector<double> phases;
  for (const auto& value : response) phases.push_back(principal_deg(angle_deg(value)));
  return phases;
}

std::vector<double> continuous_phase_deg(const std::vector<std::complex<double>>& response) {
  std::vector<double> phases = principal_phase_deg(response);
  double last = std::numeric_limits<double>::quiet_NaN();
  for (double& phase : phases) {
    if (!std::isfinite(phase)) continue;
    const double step = std::remainder(phase - last, kTurn_deg);
    if (std::abs(step) < kHalfTurn_deg - kUndecided_deg) phase = last + step;
    last = phase;
  }
  return phases;
}

double to_principal_turn_deg(const std::vector<double>& phase_deg) {
  const auto first =
      std::ranges::find_if(phase_deg, [](double phase) { return std::isfinite(phase); });
  return first == phase_deg.end() ? 0.0 : principal_deg(*first) - *first;
}

void turn_towards(const PhaseCurve& reference, PhaseCurve& curve) {
  auto& phase = curve.phase_deg;
  for (std::size_t from = 0; from < phase.size();) {
    std::size_t to = from;
    std::vector<double> distances;
    for (; to < phase.size() && std::isfinite(phase[to]); ++to) {
      const double distance = phase_at(reference, curve.frequency_Hz[to]) - phase[to];
      if (std::isfinite(distance)) distances.push_back(distance);
    }
    if (!distances.empty()) {
      const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
      std::ranges::nth_element(distances, middle);
      double turns_deg = kTurn_deg * std::round(*middle / kTurn_deg);
      for (std::size_t k = from; k < to; ++k) {
        phase[k] += turns_deg;
        const double distance = phase_at(reference, curve.frequency_Hz[k]) - phase[k];
        if (!(std::abs(distance) > kFarthest_deg)) continue;
        const double more_deg = kTurn_deg * std::round(distance / kTurn_deg);
        turns_deg += more_deg;
        phase[k] = k == from ? phase[k] + more_deg : std::numeric_limits<double>::quiet_NaN();
      }
    }
    from = to + 1;
  }
}

}  // namespace flexarm::report
