#include "report/figures/phase.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace flexarm::report {
namespace {

constexpr double kWrapFrom_deg = -225.0;
constexpr double kHalfTurn_deg = 180.0;

double angle_deg(std::complex<double> value) {
  if (value == 0.0) return std::numeric_limits<double>::quiet_NaN();
  return std::arg(value) * kHalfTurn_deg / std::numbers::pi;
}

}  // namespace

std::vector<double> principal_phase_deg(const std::vector<std::complex<double>>& response) {
  std::vector<double> phases;
  for (const auto& value : response) {
    const double angle = angle_deg(value);
    phases.push_back(angle - 360.0 * std::floor((angle - kWrapFrom_deg) / 360.0));
  }
  return phases;
}

}  // namespace flexarm::report
