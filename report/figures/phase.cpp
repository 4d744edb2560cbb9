#include "report/figures/phase.hpp"

#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

namespace flexarm::report {
namespace {

constexpr double kWrapFrom_deg = -225.0;
constexpr double kHalfTurn_deg = 180.0;
constexpr double kUncertain_deg = 10.0;  // about a half turn
constexpr double kRounding_deg = 1e-9;

double angle_deg(std::complex<double> value) {
  if (value == 0.0) return std::numeric_limits<double>::quiet_NaN();
  return std::arg(value) * kHalfTurn_deg / std::numbers::pi;
}

/// The angle that differs by whole turns and lies in [-225, 135).
double wrapped(double angle_deg) {
  return angle_deg - 360.0 * std::floor((angle_deg - kWrapFrom_deg) / 360.0);
}

/// Whether the magnitudes around the step to value i are those of a pole (1), a zero (-1) or
/// neither.
int passage(const std::vector<std::complex<double>>& response, std::size_t i) {
  if (i < 2 || i + 1 >= response.size()) return 0;
  const double in = std::abs(response[i - 1]) - std::abs(response[i - 2]);
  const double out = std::abs(response[i + 1]) - std::abs(response[i]);
  if (in > 0.0 && out < 0.0) return 1;
  if (in < 0.0 && out > 0.0) return -1;
  return 0;
}

/// `change`, the smaller turn, or the larger one the other way where the magnitudes ask for it.
double turn_deg(double change, double from_deg, int passage) {
  const double size = std::abs(change);
  if (size < kHalfTurn_deg - kUncertain_deg) return change;
  const bool is_half = size > kHalfTurn_deg - kRounding_deg;
  const bool up = passage != 0 ? passage < 0 : is_half ? from_deg < -90.0 : change > 0.0;
  if (up == (change > 0.0)) return change;
  return up ? change + 360.0 : change - 360.0;
}

}  // namespace

std::vector<double> phase_deg(const std::vector<std::complex<double>>& response, Phase phase) {
  std::vector<double> phases;
  double last = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < response.size(); ++i) {
    double angle = wrapped(angle_deg(response[i]));
    if (phase == Phase::unwrapped && std::isfinite(last) && std::isfinite(angle)) {
      angle = last + turn_deg(std::remainder(angle - last, 360.0), last, passage(response, i));
    }
    if (std::isfinite(angle)) last = angle;
    phases.push_back(angle);
  }
  return phases;
}

}  // namespace flexarm::report
