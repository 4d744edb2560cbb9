#pragma once

#include "arm/sensor.hpp"
#include "response/state_space.hpp"

#include <complex>
#include <vector>

namespace flexarm::response {

/// Eigenvalues of A [rad/s], ascending in |s|, a conjugate pair with Im s > 0 first.
std::vector<std::complex<double>> poles(const StateSpace& system);

/// Finite zeros from the torque to one of the sensors [rad/s], in that order; delays have none.
///
/// With D = 0, y and its derivatives up to the one that the torque acts on, C A^(r-1) B /= 0, are
/// held at zero by tau = -(C A^(r-1) B)^-1 C A^r x. The zeros are the eigenvalues of what moves
/// then, A - B (C A^(r-1) B)^-1 C A^r where C x = ... = C A^(r-1) x = 0; with D /= 0 of
/// A - B D^-1 C. No infinite zero is computed. Without any such r the torque does not reach the
/// sensor, and there are none.
///
/// Throws InputError for a sensor that the system does not have.
std::vector<std::complex<double>> zeros(const StateSpace& system, const arm::Sensor& sensor);

}  // namespace flexarm::response
