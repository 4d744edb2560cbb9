#include "diagnose/hypotheses/hypotheses.hpp"

namespace flexarm::diagnose {

Hypothesis payload_offset(const Scales& scales) {
  const double length_m = scales.beam.length_m;
  return {.effect = "payload_offset",
          .parameters = {{.name = "offset",
                          .lowest = -0.2 * length_m,
                          .highest = 0.2 * length_m,
                          .spacing = Spacing::linear,
                          .neutral = 0.0}},
          .shows = Shows::in_all,
          .speaks_for = "what is off grows with the payload and is not there without one",
          .refuted_by = "a misfit without payload"};
}

}  // namespace flexarm::diagnose
