#pragma once

#include "arm/formulation.hpp"

#include <complex>
#include <span>
#include <vector>

namespace flexarm::response {

/// omega_i^2 of mode i [rad^2/s^2]; the lowest may be below 0.
double omega_squared(const arm::ModalModel& model, std::size_t i);

/// Response of the sensors per unit of torque on the hub at s [rad/s], summed over the modes of
/// `model`, which have a value at each of `sensors`:
///
///     s^k sum_i sigma_i q_i,   (s^2 + omega_i^2) q_i + s sum_j D_ij q_j = theta_i/I_T,
///
/// (48)-(49) of the paper put right, k the sensor's derivatives. At a pole the values are not
/// finite, or huge.
std::vector<std::complex<double>> modal_response(const arm::ModalModel& model,
                                                 std::span<const arm::Sensor> sensors,
                                                 std::complex<double> s_rad_per_s);

/// Throws std::invalid_argument unless every mode has a value at each of `sensors` and the damping
/// matrix is n x n, finite, symmetric and positive semidefinite to rounding: any other feeds energy
/// into the arm.
void require_consistent(const arm::ModalModel& model, std::span<const arm::Sensor> sensors);

}  // namespace flexarm::response
