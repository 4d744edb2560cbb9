#include "response/frequency/resonance.hpp"

#include "response/frequency/frequency_response.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace flexarm::response {

namespace {

constexpr int kPoints = 240;
constexpr double kLargestAngle = 0.97 * std::numbers::pi;
/// Half-widths on either side that are shown however near the next pole is.
constexpr double kLeastHalfWidths = 2.0;
/// As far as so many times the frequency, and its part, where no neighbour oscillates.
constexpr double kAlone = 2.0;

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
  std::map<double, std::complex<double>> values;  // of all poles: their ranges overlap
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto pole = pairs[i].first_rad_per_s;
    const double centre_Hz = frequency_Hz(pairs[i]);
    const double half_width_Hz = std::abs(pole.real()) / (2.0 * std::numbers::pi);
    if (half_width_Hz == 0.0 || !(centre_Hz > from_Hz && centre_Hz < to_Hz)) continue;
    for (int j = 0; j <= kPoints; ++j) {
      const double angle = kLargestAngle * (2.0 * j / kPoints - 1.0);
      const double f = centre_Hz + half_width_Hz * std::tan(angle / 2.0);
      if (f > 0.0 && !values.contains(f)) values[f] = response(f);
    }
    if (centre_Hz - half_width_Hz <= 0.0) continue;  // too damped for a circle
    Resonance resonance;
    resonance.order = static_cast<int>(i);
    resonance.pole_rad_per_s = pole;
    resonance.at_pole = response(centre_Hz);
    resonance.above = response(centre_Hz + half_width_Hz);
    resonance.below = response(centre_Hz - half_width_Hz);
    found.push_back(std::move(resonance));
  }
  for (Resonance& resonance : found) {
    const auto i = static_cast<std::size_t>(resonance.order);
    const double centre_Hz = frequency_Hz(pairs[i]);
    const double half_width_Hz =
        std::abs(resonance.pole_rad_per_s.real()) / (2.0 * std::numbers::pi);
    const double least_Hz = kLeastHalfWidths * half_width_Hz;
    const double most_Hz = std::tan(kLargestAngle / 2.0) * half_width_Hz;
    // i - 1 wraps for the first. Towards 0 the response may go to infinity.
    const double below_Hz = std::min(midway_Hz(pairs, i, i - 1, centre_Hz / kAlone),
                                     std::max(centre_Hz - least_Hz, centre_Hz / kAlone));
    const double above_Hz =
        std::max(midway_Hz(pairs, i, i + 1, centre_Hz * kAlone), centre_Hz + least_Hz);
    const auto first = values.lower_bound(std::max(below_Hz, centre_Hz - most_Hz));
    const auto end = values.upper_bound(std::min(above_Hz, centre_Hz + most_Hz));
    for (auto at = first; at != end; ++at) {
      resonance.frequency_Hz.push_back(at->first);
      resonance.values.push_back(at->second);
    }
  }
  return found;
}

}  // namespace flexarm::response
