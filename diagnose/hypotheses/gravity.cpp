#include "diagnose/hypotheses/hypotheses.hpp"

namespace flexarm::diagnose {

Hypothesis gravity(const Scales& /*scales*/) {
  constexpr double g = 9.81;  // m/s^2
  return {.effect = "gravity",
          .parameters = {{.name = "acceleration",
                          .lowest = -2.0 * g,
                          .highest = 2.0 * g,
                          .spacing = Spacing::linear,
                          .neutral = 0.0}},
          .shows = Shows::in_all,
          .speaks_for =
              "the arm swings about one hub angle, and all poles move up by nearly "
              "the same square",
          .refuted_by = "a rest at any hub angle"};
}

}  // namespace flexarm::diagnose
