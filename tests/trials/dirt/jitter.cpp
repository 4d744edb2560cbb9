#include "tests/trials/dirt.hpp"

namespace flexarm::trials {

namespace {

constexpr double kJitterPart = 0.2;  ///< of the sampling period, at most

}  // namespace

/// Sensors are read up to a fifth of a period after the instant that is recorded.
Dirt jitter() {
  return {
      .name = "jitter",
      .simulation = [](double size, const TrialArm& /*of*/, Random& random, TimeOptions& options) {
        if (size == 0.0) return;
        for (int k = 0; k < kSamples; ++k) {
          options.late_substeps.push_back(
              static_cast<int>(random.uniform(0.0, size * kJitterPart) * options.substeps));
        }
      }};
}

}  // namespace flexarm::trials
