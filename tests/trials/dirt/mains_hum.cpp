#include "tests/trials/dirt.hpp"

#include <cmath>
#include <numbers>

namespace flexarm::trials {

namespace {

constexpr double kMains_Hz = 50.0;
constexpr double kMainsHumPart = 0.04;
/// Of the third harmonic, over the first.
constexpr double kThird = 0.3;

}  // namespace

/// Hum of the mains and of its third harmonic on analogue channels.
Dirt mains_hum() {
  return {.name = "mains_hum", .recording = [](double size, Random& random, Recording& made) {
            if (size == 0.0) return;
            constexpr double kTurn = 2.0 * std::numbers::pi;
            for (measured::Channel& channel : made.record.channels) {
              if (!is_analogue(channel)) continue;
              const double amplitude =
                  size * kMainsHumPart * std::numbers::sqrt2 * deviation(channel.values);
              const double phase = random.uniform(0.0, kTurn);
              for (std::size_t k = 0; k < channel.values.size(); ++k) {
                const double turned = kTurn * kMains_Hz * made.record.time_s[k] + phase;
                channel.values[k] +=
                    amplitude * (std::sin(turned) + kThird * std::sin(3.0 * turned));
              }
            }
          }};
}

}  // namespace flexarm::trials
