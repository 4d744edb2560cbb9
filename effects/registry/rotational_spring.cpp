#include "effects/registry/rotational_spring.hpp"

#include <limits>

namespace flexarm::effects {

arm::EffectParameter rotational_stiffness(double example) {
  return {.name = "stiffness",
          .unit = "N m/rad",
          .range = arm::kPositive,
          .meaning = "rotational stiffness",
          .example = example,
          .neutral = std::numeric_limits<double>::infinity()};
}

SearchedParameter searched_stiffness(const Scales& scales, double stiffest) {
  const double bending = scales.bending_stiffness_N_m_per_rad();
  return {"stiffness", 0.2 * bending, stiffest * bending, Spacing::from_infinity};
}

arm::EffectParameter retardation_time(const std::string& part, double example,
                                      std::optional<double> otherwise) {
  return {.name = "time",
          .unit = "s",
          .range = arm::kNotNegative,
          .meaning =
              "damping coefficient over stiffness; times an angular frequency it is the "
              "loss factor of " +
              part + " there",
          .example = example,
          .otherwise = otherwise};
}

SearchedParameter searched_retardation_time(const Scales& scales) {
  const double scale_rad_per_s = arm::omega_scale_rad_per_s(scales.beam);
  return {"time", 1e-4 / scale_rad_per_s, 1.0 / scale_rad_per_s};
}

}  // namespace flexarm::effects
