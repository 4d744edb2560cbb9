#pragma once

#include "arm/sensor.hpp"
#include "response/any_formulation.hpp"

#include <complex>
#include <optional>
#include <span>
#include <vector>

namespace flexarm::compare {

/// Natural frequency and damping ratio of a pair of damped roots.
struct NaturalFrequency {
  double frequency_Hz = 0.0;   ///< |s|/2 pi; of two real roots their geometric mean
  double damping_ratio = 0.0;  ///< -Re s/|s|; below 0 in the right half plane
};
NaturalFrequency natural_frequency(const arm::PolePair& pair);

/// Both roots that each undamped zero of torque to `sensor` becomes with the arm's damping [rad/s]:
/// those of exact_tf (ExactArm::damped_zeros), of another formulation its own beside them, by
/// secant steps of its transfer function. Zeros off both axes that exact_tf does not follow are
/// sought from the undamped ones. Empty where the steps do not settle within half the modulus.
std::vector<std::optional<arm::PolePair>> zeros_with_damping(
    const response::AnyFormulation& formulation, const arm::Sensor& sensor,
    std::span<const std::complex<double>> undamped_rad_per_s);

/// The roots of the pair and their conjugates, none twice.
std::vector<std::complex<double>> with_conjugates(const arm::PolePair& pair);

}  // namespace flexarm::compare
