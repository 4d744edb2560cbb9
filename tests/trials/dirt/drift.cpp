#include "tests/trials/dirt.hpp"

#include <cmath>

namespace flexarm::trials {

namespace {

/// Of a channel's deviation, from the first to the last sample.
constexpr double kDriftPart = 0.3;
/// Time constant of the warming amplifier over the length of the run.
constexpr double kWarming = 0.6;

}  // namespace

/// The zero of analogue channels moves while their amplifier warms.
Dirt drift() {
  return {.name = "drift", .recording = [](double size, Random& random, Recording& made) {
            if (size == 0.0) return;
            const auto samples = static_cast<double>(made.record.time_s.size());
            for (measured::Channel& channel : made.record.channels) {
              if (!is_analogue(channel)) continue;
              const double all = size * kDriftPart * random.sign() * deviation(channel.values) /
                                 (1.0 - std::exp(-1.0 / kWarming));
              double at = 0.0;
              for (double& value : channel.values) {
                value += all * (1.0 - std::exp(-at / samples / kWarming));
                at += 1.0;
              }
            }
          }};
}

}  // namespace flexarm::trials
