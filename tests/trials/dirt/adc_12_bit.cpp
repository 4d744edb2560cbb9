#include "tests/trials/dirt.hpp"

#include <algorithm>
#include <cmath>

namespace flexarm::trials {

namespace {

constexpr double kSteps = 4096.0;
/// The range of the converter over that of the channel.
constexpr double kHeadroom = 2.5;

}  // namespace

/// Analogue channels in steps of a 12 bit converter whose range is wider than they need.
Dirt adc_12_bit() {
  return {.name = "adc_12_bit", .recording = [](double size, Random& /*random*/, Recording& made) {
            if (size == 0.0) return;
            for (measured::Channel& channel : made.record.channels) {
              if (!is_analogue(channel)) continue;
              const auto [least, most] = std::ranges::minmax(channel.values);
              const double range = 2.0 * kHeadroom * std::max(std::abs(least), std::abs(most));
              const double step = size * range / kSteps;
              if (step == 0.0) continue;
              for (double& value : channel.values) value = step * std::round(value / step);
            }
          }};
}

}  // namespace flexarm::trials
