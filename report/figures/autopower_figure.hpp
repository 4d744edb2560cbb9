#pragma once

#include "measured/spectra/response_estimate.hpp"
#include "measured/spectra/spectral_features.hpp"
#include "report/figures/figure.hpp"

#include <span>
#include <string>
#include <vector>

namespace flexarm::report {

struct AutopowerPlot {
  std::string title = {};
  Scale frequency_scale = Scale::linear;
  /// Drawn as faint lines in the panels of the sensors, those within the frequencies.
  std::vector<double> analytical_poles_Hz = {};
};

/// Autopower spectra over frequency, a panel for the torque and one for each sensor, as densities
/// on a logarithmic axis. Peaks and valleys of `features` are marked with their frequencies, in the
/// panel of their sensor. Line 0 is left out, and so are sensors without a positive value.
///
/// Throws std::invalid_argument for an estimate in which nothing can be drawn, or with vectors of
/// unlike length.
Figure autopower_figure(const measured::FrequencyResponseEstimate& estimate,
                        std::span<const measured::SensorFeatures> features,
                        const AutopowerPlot& plot = {});

}  // namespace flexarm::report
