#include "diagnose/hypotheses/hypotheses.hpp"

namespace flexarm::diagnose {

Hypothesis flexural_rigidity(const Scales& /*scales*/) {
  return {.effect = "flexural_rigidity",
          .parameters = {{.name = "factor", .lowest = 0.4, .highest = 2.5, .neutral = 1.0}},
          .shows = Shows::in_all,
          .speaks_for = "all poles and zeros move in one ratio; the rigid body is as expected",
          .refuted_by = "poles and zeros that move in unlike ratios"};
}

}  // namespace flexarm::diagnose
