#include "tests/trials/cause.hpp"

#include <cmath>

namespace flexarm::trials {

/// Friction that is highest at rest. The speed over which it falls is compared with the one that
/// the typical torque gives the rigid arm in a swing of its slowest mode.
Cause stribeck_friction() {
  return {.name = "stribeck_friction",
          .shown_in = ShownIn::time,
          .acts_on = ActsOn::hub,
          // Beside Coulomb's it is one friction.
          .in_pairs = false,
          .parameters = [](const NaturalSizes& natural, double size,
                           const Chance& chance) -> Parameters {
            const double torque = size * natural.torque_N_m;
            const double speed =
                natural.torque_N_m / (natural.inertia_kg_m2 * natural.omega_rad_per_s);
            return {{"torque", torque},
                    {"static_torque", torque * between(1.5, 2.5, chance.ratio)},
                    {"velocity", speed * between(0.2, 0.8, chance.place)}};
          },
          .change =
              [](const Parameters& of, const arm::Sensor& /*sensor*/, TrueArm& arm) {
                arm.dry_frictions.push_back([fast_N_m = of.at("torque"),
                                             still_N_m = of.at("static_torque"),
                                             scale = of.at("velocity")](double speed) {
                  const double ratio = speed / scale;
                  return fast_N_m + (still_N_m - fast_N_m) * std::exp(-ratio * ratio);
                });
              }};
}

}  // namespace flexarm::trials
