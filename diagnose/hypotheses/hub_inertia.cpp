#include "diagnose/hypotheses/hypotheses.hpp"

namespace flexarm::diagnose {

Hypothesis hub_inertia(const Scales& /*scales*/) {
  return {.effect = "hub_inertia",
          .parameters = {{.name = "factor", .lowest = 0.3, .highest = 3.0, .neutral = 1.0}},
          .shows = Shows::in_all,
          .speaks_for =
              "poles move and hub-angle zeros, which are the poles of the arm with "
              "its hub locked, stay",
          .refuted_by = "hub-angle zeros that move too"};
}

}  // namespace flexarm::diagnose
