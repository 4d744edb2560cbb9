#include "diagnose/hypotheses/hypotheses.hpp"

namespace flexarm::diagnose {

Hypothesis actuator_lag(const Scales& scales) {
  return {.effect = "actuator_lag",
          .parameters = {{"time_constant", 0.02 * scales.shortest_time_s,
                          200.0 * scales.shortest_time_s, Spacing::from_zero}},
          .shows = Shows::in_time_and_frequency,
          .speaks_for =
              "phase falls behind and the response falls off with frequency; poles "
              "and zeros stay",
          .refuted_by =
              "a phase that falls in proportion to the frequency while the amplitude "
              "stays"};
}

}  // namespace flexarm::diagnose
