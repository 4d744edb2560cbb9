#include "diagnose/hypotheses/hypotheses.hpp"

namespace flexarm::diagnose {

Hypothesis linear_density(const Scales& /*scales*/) {
  return {.effect = "linear_density",
          .parameters = {{"factor", 0.4, 2.5}},
          .shows = Shows::in_all,
          .speaks_for = "poles and zeros move down together, and the rigid body is heavier",
          .refuted_by = "a rigid-body inertia that is as expected"};
}

}  // namespace flexarm::diagnose
