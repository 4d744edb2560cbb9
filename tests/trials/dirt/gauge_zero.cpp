#include "tests/trials/dirt.hpp"

namespace flexarm::trials {

/// The bridge of the strain gauge was not balanced.
Dirt gauge_zero() {
  constexpr double kGaugeZeroPart = 0.2;  // of the largest offset that is hidden as a cause
  return {.name = "gauge_zero",
          .named_as = {"sensor_offset"},
          .hide = [](double size, const TrialArm& of, const World& world, Random& random) {
            return with_named_dirt(world, of, "sensor_offset",
                                   size * kGaugeZeroPart * find_cause("sensor_offset").largest,
                                   arm::to_string(kGauge), random);
          }};
}

}  // namespace flexarm::trials
