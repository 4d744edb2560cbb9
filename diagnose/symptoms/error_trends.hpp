#pragma once

#include "diagnose/symptoms/symptom.hpp"
#include "diagnose/symptoms/symptoms_input.hpp"

#include <vector>

namespace flexarm::diagnose {

/// How the error without causes changes from the least to the largest torque among `time` runs of
/// one payload, and from the least to the largest payload. In each of `kTrendBands` bands of equal
/// ratio in which the torque of both has power, and errors are beyond noise, the logarithm of the
/// error's size over the torque's, in the mean of the sensors, is compared between the two runs;
/// Student's t over the bands. An error that is linear in the torque does not change with its size,
/// whatever the torque's shape.
std::vector<Symptom> trend_symptoms(const SymptomsInput& input);
inline constexpr int kTrendBands = 40;

}  // namespace flexarm::diagnose
