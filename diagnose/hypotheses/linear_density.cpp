#include "diagnose/hypotheses/hypotheses.hpp"

namespace flexarm::diagnose {

Hypothesis linear_density(const Scales& /*scales*/) {
  return {.effect = "linear_density",
          .parameters = {{.name = "factor", .lowest = 0.4, .highest = 2.5, .neutral = 1.0}},
          .shows = Shows::in_all,
          .speaks_for = "poles and zeros move down together, and the rigid body is heavier",
          .refuted_by = "a rigid-body inertia that is as expected"};
}

}  // namespace flexarm::diagnose
