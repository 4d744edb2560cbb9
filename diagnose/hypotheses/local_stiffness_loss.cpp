#include "arm/linear_arm.hpp"
#include "diagnose/hypotheses/hypotheses.hpp"

namespace flexarm::diagnose {

Hypothesis local_stiffness_loss(const Scales& scales) {
  const arm::LinearArm& beam = scales.beam;
  const double bending = beam.flexural_rigidity_N_m2 / beam.length_m;
  return {.effect = "local_stiffness_loss",
          .parameters = {{"position", 0.01 * beam.length_m, 0.99 * beam.length_m, Spacing::linear},
                         {"stiffness", 0.3 * bending, 300.0 * bending, Spacing::from_infinity}},
          .shows = Shows::in_all,
          .contains = {"root_compliance"},
          .speaks_for =
              "poles and zeros move down in unlike ratios: a mode that does not bend "
              "at the crack stays",
          .refuted_by = "modes that all move in one ratio"};
}

}  // namespace flexarm::diagnose
