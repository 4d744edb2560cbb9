#pragma once

#include "diagnose/symptoms/band_errors.hpp"

#include <vector>

namespace flexarm::diagnose {

/// How the error changes from the least to the largest torque among runs of one payload whose
/// torques have like spectra, and from the least to the largest payload among runs of like torque:
/// band by band the logarithm of the ratio of the errors, each over the torque's part in the band,
/// in the mean of the sensors whose error is beyond noise in both; Student's t over the bands. An
/// error that is linear in the torque does not change with its size.
std::vector<Symptom> trend_symptoms(const std::vector<BandError>& errors);

}  // namespace flexarm::diagnose
