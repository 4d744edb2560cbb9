#include "diagnose/hypotheses/hypotheses.hpp"

namespace flexarm::diagnose {

Hypothesis torque_gain(const Scales& /*scales*/) {
  return {.effect = "torque_gain",
          .parameters = {{.name = "factor", .lowest = 0.3, .highest = 3.0, .neutral = 1.0}},
          .shows = Shows::in_time_and_frequency,
          .speaks_for = "every sensor reads more or less in one ratio; poles and zeros stay",
          .refuted_by = "poles or zeros that move"};
}

}  // namespace flexarm::diagnose
