#include "tests/trials/dirt.hpp"

#include <cmath>
#include <numbers>

namespace flexarm::trials {

namespace {

/// Lines of the encoder, each counted four times.
constexpr double kCounts_per_rev = 4.0 * 1024.0;

}  // namespace

/// The hub angle in counts of an encoder, and no hub velocity.
Dirt encoder_counts() {
  return {.name = "encoder_counts",
          .changes_sensors = true,
          .recording = [](double size, Random& /*random*/, Recording& made) {
            if (size == 0.0) return;
            std::erase_if(made.record.channels, [](const measured::Channel& channel) {
              return channel.sensor.kind == arm::SensorKind::hub_velocity;
            });
            const double count_rad = size * 2.0 * std::numbers::pi / kCounts_per_rev;
            for (measured::Channel& channel : made.record.channels) {
              if (is_analogue(channel)) continue;
              for (double& value : channel.values) {
                value = count_rad * std::round(value / count_rad);
              }
            }
          }};
}

}  // namespace flexarm::trials
