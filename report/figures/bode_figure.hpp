#pragma once

#include "report/figures/figure.hpp"

#include <complex>
#include <string>
#include <vector>

namespace flexarm::report {

/// The frequency response that one formulation gives.
struct BodeCurve {
  std::string name;
  std::vector<std::complex<double>> response;  ///< one a frequency; NaN where there is none
  std::vector<double> phase_deg = {};          ///< empty: continuous_phase_deg (phase.hpp)
};

struct BodePlot {
  std::string title;
  std::string unit;  ///< of the response: "rad/(N m)"
  std::vector<double> frequency_Hz;
  std::vector<BodeCurve> curves;  ///< the first is the reference
  /// One a frequency: 1 - |sum G|^2/(n sum |G|^2) of the n curves; its root, an amplitude as they
  /// are, is drawn beside the differences.
  std::vector<double> one_minus_coherence = {};
  /// Marked along the lower edge of the magnitude, those within the frequencies.
  std::vector<double> poles_Hz = {};
  std::vector<double> zeros_Hz = {};
};

/// Magnitude and phase over frequency, and, for two curves and more, the relative difference
/// |G - G_ref|/|G_ref| from the first below them; a difference below half an epsilon is drawn at
/// it. Throws std::invalid_argument when a response has not one value a frequency.
Figure bode_figure(const BodePlot& plot);

}  // namespace flexarm::report
