#include "diagnose/hypotheses/hypotheses.hpp"

namespace flexarm::diagnose {

Hypothesis time_delay(const Scales& scales) {
  return {.effect = "time_delay",
          .parameters = {{"delay", 0.02 * scales.shortest_time_s, 200.0 * scales.shortest_time_s,
                          Spacing::from_zero}},
          .shows = Shows::in_time_and_frequency,
          .speaks_for =
              "phase falls in proportion to the frequency; poles, zeros and "
              "amplitudes stay",
          .refuted_by = "amplitudes that fall with frequency"};
}

}  // namespace flexarm::diagnose
