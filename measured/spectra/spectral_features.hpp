#pragma once

#include "measured/modal/peaks.hpp"
#include "measured/spectra/response_estimate.hpp"

#include <vector>

namespace flexarm::measured {

/// Poles and zeros of one sensor as the paper reads them off (Tables 2 and 3).
struct SensorFeatures {
  arm::Sensor sensor;
  std::vector<SpectralFeature> autopower;  ///< of the sensor's autopower spectrum
  std::vector<SpectralFeature> response;   ///< of the frequency response
};

/// Peaks and valleys of every sensor's autopower spectrum and response, each against its own
/// spread; `settings.noise` is set here. An autopower spectrum has the torque's peaks and valleys
/// too. Spread that is not known (one period) counts as none.
std::vector<SensorFeatures> spectral_features(const FrequencyResponseEstimate& estimate,
                                              const PeakSettings& settings = {});

}  // namespace flexarm::measured
