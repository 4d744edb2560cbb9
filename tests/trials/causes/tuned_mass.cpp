#include "tests/trials/cause.hpp"

#include <numbers>

namespace flexarm::trials {

/// A mass on a spring and a damper on the beam.
Cause tuned_mass() {
  return {.name = "tuned_mass",
          .largest = 0.5,
          .parameters = [](const NaturalSizes& natural, double size, const Chance& chance)
              -> Parameters {  // 15.4 omega is the first pole of an arm of no hub inertia.
            return {{"mass", size * natural.beam_kg},
                    {"frequency", between(0.5, 3.0, chance.place) * 15.4 * natural.omega_rad_per_s /
                                      (2.0 * std::numbers::pi)},
                    {"damping_ratio", 0.02},
                    {"position", between(0.4, 0.9, chance.ratio) * natural.length_m}};
          },
          .change =
              [](const Parameters& of, const arm::Sensor& /*sensor*/, TrueArm& arm) {
                const double omega = 2.0 * std::numbers::pi * of.at("frequency");
                const double mass_kg = of.at("mass");
                arm.attached.push_back(
                    {.position_m = of.at("position"),
                     .mass_kg = mass_kg,
                     .stiffness_N_per_m = mass_kg * omega * omega,
                     .damping_N_s_per_m = 2.0 * of.at("damping_ratio") * omega * mass_kg});
              }};
}

}  // namespace flexarm::trials
