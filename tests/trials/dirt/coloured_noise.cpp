#include "tests/trials/dirt.hpp"

#include <cmath>

namespace flexarm::trials {

namespace {

constexpr double kColouredNoisePart = 0.03;
/// Of one sample with the next: a corner at 2 Hz.
constexpr double kCorrelation = 0.975;

}  // namespace

/// Noise of the first order on every channel, beside the white noise of every trial.
Dirt coloured_noise() {
  return {.name = "coloured_noise", .recording = [](double size, Random& random, Recording& made) {
            if (size == 0.0) return;
            const double fresh = std::sqrt(1.0 - kCorrelation * kCorrelation);
            for (measured::Channel& channel : made.record.channels) {
              const double scale = size * kColouredNoisePart * deviation(channel.values);
              double noise = random.normal();
              for (double& value : channel.values) {
                value += scale * noise;
                noise = kCorrelation * noise + fresh * random.normal();
              }
            }
          }};
}

}  // namespace flexarm::trials
