#include "arm/linear_arm.hpp"
#include "diagnose/hypotheses/hypotheses.hpp"

namespace flexarm::diagnose {

Hypothesis payload_mass(const Scales& scales) {
  const arm::LinearArm& beam = scales.beam;
  const double beam_kg = beam.linear_density_kg_per_m * beam.length_m;
  return {.effect = "payload_mass",
          .parameters = {{"mass", 1e-3 * beam_kg, 2.0 * beam_kg, Spacing::from_zero}},
          .shows = Shows::in_all,
          .speaks_for = "hub-angle zeros move, zeros of tip acceleration stay",
          .refuted_by = "zeros of tip acceleration that move"};
}

}  // namespace flexarm::diagnose
