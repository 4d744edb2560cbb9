#pragma once

#include "arm/arm.hpp"
#include "response/formulation_maker.hpp"

#include <complex>
#include <string_view>
#include <vector>

namespace flexarm::effects {

/// Undamped flexible poles [rad/s], the lowest `count`.
std::vector<double> pole_frequencies(std::string_view formulation, const arm::Arm& arm, int count);

/// Responses of these sensors at s differ by `tolerance` of those of `wanted` at most.
void expect_same_responses(const response::AnyFormulation& model,
                           const response::AnyFormulation& wanted,
                           const std::vector<std::string_view>& sensors, std::complex<double> s,
                           double tolerance);

/// In each formulation, of an arm with so little damping that the decay of a pole is D_ii/2 of its
/// projection. The error is of the second order in the damping.
void expect_decays_as_projected(const arm::Arm& arm, int poles);

}  // namespace flexarm::effects
