#pragma once

#include "arm/sensor.hpp"
#include "response/any_formulation.hpp"

#include <complex>
#include <string>
#include <vector>

namespace flexarm::compare {

/// Torque to one sensor over frequency, from every formulation.
struct ResponseComparison {
  arm::Sensor sensor;
  std::vector<double> frequency_Hz;
  /// [formulation][frequency], response per unit of torque.
  std::vector<std::vector<std::complex<double>>> values;
  /// [formulation][frequency], |G - G_0|/|G_0| against the first formulation.
  std::vector<std::vector<double>> relative_error;
  /// [frequency], 1 - |sum G|^2/(n sum |G|^2): 0 where all formulations agree.
  std::vector<double> one_minus_coherence;
  /// [formulation], the largest relative error off resonance, and where it is.
  std::vector<double> largest_error;
  std::vector<double> largest_error_frequency_Hz;
};

/// Frequencies nearer than this to an undamped pole or imaginary zero, relative, do not count for
/// `largest_error`: there the response's relative error is that of the root divided by the
/// distance.
inline constexpr double kOffResonance = 0.02;

/// Log-spaced frequencies [Hz] from a tenth of the lowest pole to just below the highest one, where
/// it is off resonance: the range that the poles compared speak for. Further ones on both sides of
/// each of `features_Hz`, closer the nearer, so that peaks and notches are resolved.
std::vector<double> response_grid_Hz(const std::vector<double>& pole_frequency_Hz, int points,
                                     const std::vector<double>& features_Hz = {});

/// `features_Hz`: the undamped poles and imaginary zeros of this sensor, for `kOffResonance`.
ResponseComparison compare_responses(const std::vector<response::AnyFormulation>& formulations,
                                     const arm::Sensor& sensor,
                                     const std::vector<double>& frequency_Hz,
                                     const std::vector<double>& features_Hz);

}  // namespace flexarm::compare
