#include "response/frequency/resonance.hpp"

#include "response/frequency/frequency_response.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace flexarm::response {

namespace {

constexpr int kPoints = 240;
constexpr double kLargestAngle = 0.97 * std::numbers::pi;
/// Half-widths on either side that are shown however near the next pole is.
constexpr double kLeastHalfWidths = 2.0;

double frequency_Hz(const arm::PolePair& pole) {
  return pole.first_rad_per_s.imag() / (2.0 * std::numbers::pi);
}

/// Geometric mean with a neighbour, `otherwise` where there is none that oscillates.
double midway_Hz(std::span<const arm::PolePair> poles, std::size_t i, std::size_t neighbour,
                 double otherwise) {
  if (neighbour >= poles.size() || frequency_Hz(poles[neighbour]) == 0.0) return otherwise;
  return std::sqrt(frequency_Hz(poles[i]) * frequency_Hz(poles[neighbour]));
}

}  // namespace

std::vector<Resonance> resonances(const AnyFormulation& formulation, const LinearChain& chain,
                                  const arm::Sensor& sensor, const arm::DampedPoleSet& poles,
                                  double from_Hz, double to_Hz) {
  std::vector<arm::PolePair> pairs = {poles.lowest};
  pairs.insert(pairs.end(), poles.flexible.begin(), poles.flexible.end());
  const auto response = [&](double f) {
    const auto s = on_imaginary_axis(f);
    return transfer_function(formulation, sensor, s) * actuator_response(chain, s) *
           reading_response(chain, sensor, s);
  };
  std::vector<Resonance> found;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto pole = pairs[i].first_rad_per_s;
    const double centre_Hz = frequency_Hz(pairs[i]);
    const double half_width_Hz = std::abs(pole.real()) / (2.0 * std::numbers::pi);
    if (half_width_Hz == 0.0 || !(centre_Hz > from_Hz && centre_Hz < to_Hz)) continue;
    const double least_Hz = kLeastHalfWidths * half_width_Hz;
    const double lowest =  // i - 1 wraps for the first
        std::max(0.0, std::min(midway_Hz(pairs, i, i - 1, 0.0), centre_Hz - least_Hz));
    const double highest = std::max(
        midway_Hz(pairs, i, i + 1, std::numeric_limits<double>::infinity()), centre_Hz + least_Hz);
    Resonance resonance;
    resonance.order = static_cast<int>(i);
    resonance.pole_rad_per_s = pole;
    for (int j = 0; j <= kPoints; ++j) {
      const double angle = kLargestAngle * (2.0 * j / kPoints - 1.0);
      const double f = centre_Hz + half_width_Hz * std::tan(angle / 2.0);
      if (!(f > lowest && f < highest)) continue;
      resonance.frequency_Hz.push_back(f);
      resonance.values.push_back(response(f));
    }
    resonance.at_pole = response(centre_Hz);
    resonance.above = response(centre_Hz + half_width_Hz);
    if (centre_Hz - half_width_Hz <= 0.0) continue;  // too damped for a circle
    resonance.below = response(centre_Hz - half_width_Hz);
    found.push_back(std::move(resonance));
  }
  return found;
}

}  // namespace flexarm::response
