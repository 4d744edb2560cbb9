#pragma once

#include "arm/sensor.hpp"
#include "response/state_space.hpp"

#include <complex>
#include <vector>

namespace flexarm::response {

/// Eigenvalues of A [rad/s], ascending in |s|, a conjugate pair with Im s > 0 first.
std::vector<std::complex<double>> poles(const StateSpace& system);

/// Finite transmission zeros from the torque to one of the sensors [rad/s], in that order. With the
/// first Markov parameter that is not 0, D or C A^(r-1) B, they are the eigenvalues of
///
///     A - B D^-1 C,   or of   A - B (C A^(r-1) B)^-1 C A^r   where C x = ... = C A^(r-1) x = 0,
///
/// so that no infinite one is computed [Schrader1989]. Delays have none. Throws InputError for a
/// sensor that the system does not have.
std::vector<std::complex<double>> zeros(const StateSpace& system, const arm::Sensor& sensor);

}  // namespace flexarm::response
