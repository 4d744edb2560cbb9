#include "response/time/reading_times.hpp"

#include "response/time/sample_delay.hpp"

#include <algorithm>

namespace flexarm::response {

std::vector<double> ReadingTimes::cuts() const {
  std::vector<double> made;
  for (const OfSensor& sensor : sensors) {
    if (sensor.at > 0.0) made.push_back(sensor.at);
  }
  std::ranges::sort(made);
  const auto repeated = std::ranges::unique(made);
  made.erase(repeated.begin(), repeated.end());
  return made;
}

std::ptrdiff_t ReadingTimes::longest_samples() const {
  std::ptrdiff_t longest = 0;
  for (const OfSensor& sensor : sensors) longest = std::max(longest, sensor.samples_later);
  return longest;
}

std::ptrdiff_t ReadingTimes::pending_readings() const {
  std::ptrdiff_t sum = 0;
  for (const OfSensor& sensor : sensors) sum += sensor.samples_later;
  return sum;
}

ReadingTimes reading_times(std::span<const SensorChain> chains,
                           std::span<const arm::Sensor> sensors, double sample_time_s) {
  ReadingTimes made;
  for (const arm::Sensor& sensor : sensors) {
    const auto delay = sample_delay(chain_of(chains, sensor).delay_s, sample_time_s);
    const auto whole = static_cast<std::ptrdiff_t>(std::min(delay.samples, kMostDelaySamples));
    if (delay.fraction == 0.0) {
      made.sensors.push_back({0.0, whole});
    } else {
      made.sensors.push_back({1.0 - delay.fraction, whole + 1});
    }
  }
  return made;
}

}  // namespace flexarm::response
