#include "tests/trials/dirt.hpp"

namespace flexarm::trials {

namespace {

constexpr double kOutliersPart = 0.002;  ///< of the samples
constexpr double kOutliersLeast = 4.0;   ///< deviations of the channel
constexpr double kOutliersMost = 12.0;

}  // namespace

/// Single samples of analogue channels that are far off.
Dirt outliers() {
  return {.name = "outliers", .recording = [](double size, Random& random, Recording& made) {
            if (size == 0.0) return;
            for (measured::Channel& channel : made.record.channels) {
              if (!is_analogue(channel)) continue;
              const double unit = deviation(channel.values);
              for (double& value : channel.values) {
                if (random.uniform() >= size * kOutliersPart) continue;
                value += random.sign() * random.uniform(kOutliersLeast, kOutliersMost) * unit;
              }
            }
          }};
}

}  // namespace flexarm::trials
