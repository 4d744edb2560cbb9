#pragma once

#include "effects/registry/search.hpp"

#include <optional>
#include <string>

namespace flexarm::effects {

/// `stiffness` [N m/rad] of an effect that is a rotational spring: infinite, it does nothing.
arm::EffectParameter rotational_stiffness(double example);
/// From EI/(5 l) to `stiffest` EI/l.
SearchedParameter searched_stiffness(const Scales& scales, double stiffest = 1e3);

/// `time` [s], that of the dashpot beside such a spring: damping coefficient over stiffness.
/// `part` is the arm's, "the root"; `otherwise` as EffectParameter has it.
arm::EffectParameter retardation_time(const std::string& part, double example,
                                      std::optional<double> otherwise = {});
SearchedParameter searched_retardation_time(const Scales& scales);

}  // namespace flexarm::effects
