#include "diagnose/hypotheses/hypotheses.hpp"

namespace flexarm::diagnose {

Hypothesis shear_and_rotary_inertia(const Scales& /*scales*/) {
  return {.effect = "shear_and_rotary_inertia",
          .parameters = {{"shear_coefficient", 0.2, 2.0}},
          .shows = Shows::in_all,
          .speaks_for = "high modes are lower than a slender beam's, the more the higher",
          .refuted_by = "modes that all move in one ratio"};
}

}  // namespace flexarm::diagnose
