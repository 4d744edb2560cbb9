#include "arm/linear_arm.hpp"
#include "diagnose/hypotheses/hypotheses.hpp"

namespace flexarm::diagnose {

Hypothesis root_compliance(const Scales& scales) {
  const arm::LinearArm& beam = scales.beam;
  const double bending = beam.flexural_rigidity_N_m2 / beam.length_m;
  return {.effect = "root_compliance",
          .parameters = {{"stiffness", 0.5 * bending, 1e3 * bending, Spacing::from_infinity}},
          .shows = Shows::in_all,
          .speaks_for =
              "poles and hub-angle zeros move down, strain at the root falls behind "
              "the hub",
          .refuted_by = "hub-angle zeros that stay"};
}

}  // namespace flexarm::diagnose
