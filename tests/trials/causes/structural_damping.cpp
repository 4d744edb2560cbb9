#include "tests/trials/cause.hpp"

namespace flexarm::trials {

/// Kelvin-Voigt's, beside the file's.
Cause structural_damping() {
  return {.name = "structural_damping",
          .largest = 0.25,
          .parameters = [](const NaturalSizes& natural, double size,
                           const Chance& /*chance*/) -> Parameters {
            return {{"time", size / natural.omega_rad_per_s}};
          },
          .change = [](const Parameters& of, const arm::Sensor& /*sensor*/,
                       TrueArm& arm) { arm.kelvin_voigt_s += of.at("time"); }};
}

}  // namespace flexarm::trials
