#include "arm/linear_arm.hpp"
#include "diagnose/hypotheses/hypotheses.hpp"

namespace flexarm::diagnose {

Hypothesis payload_inertia(const Scales& scales) {
  const arm::LinearArm& beam = scales.beam;
  const double beam_kg_m2 =
      beam.linear_density_kg_per_m * beam.length_m * beam.length_m * beam.length_m;
  return {.effect = "payload_inertia",
          .parameters = {{"inertia", 1e-5 * beam_kg_m2, 0.1 * beam_kg_m2, Spacing::from_zero}},
          .shows = Shows::in_all,
          .speaks_for = "zeros of tip acceleration move, higher modes most",
          .refuted_by = "zeros of tip acceleration that stay"};
}

}  // namespace flexarm::diagnose
