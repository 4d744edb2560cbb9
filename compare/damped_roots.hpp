#pragma once

#include "arm/sensor.hpp"
#include "response/any_formulation.hpp"

#include <complex>
#include <vector>

namespace flexarm::compare {

/// Both roots of each of the `count` lowest flexible poles with damping [rad/s].
std::vector<std::complex<double>> poles_with_damping(const response::AnyFormulation& formulation,
                                                     int count);

/// What zeros of the undamped transfer function become with damping [rad/s]: each of them, with its
/// conjugate and its mirror images, is followed by secant steps of the transfer function itself.
/// One whose steps do not settle within half its modulus is left out; none is listed twice.
std::vector<std::complex<double>> zeros_with_damping(
    const response::AnyFormulation& formulation, const arm::Sensor& sensor,
    const std::vector<std::complex<double>>& undamped_rad_per_s);

}  // namespace flexarm::compare
