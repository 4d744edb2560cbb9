#include "diagnose/hypotheses/hypotheses.hpp"

namespace flexarm::diagnose {

Hypothesis hub_radius(const Scales& scales) {
  const double length_m = scales.beam.length_m;
  return {.effect = "hub_radius",
          .parameters = {{"radius", 1e-3 * length_m, 0.3 * length_m, Spacing::from_zero}},
          .shows = Shows::in_all,
          .speaks_for =
              "the rigid body is heavier, poles move and the zeros of the clamped "
              "beam stay",
          .refuted_by = "hub-angle zeros that move"};
}

}  // namespace flexarm::diagnose
