#pragma once

#include "measured/files/modal_table.hpp"

#include <optional>
#include <span>
#include <vector>

namespace flexarm::measured {

/// Where between its lines a peak is said to be.
enum class PeakPlace {
  on_line,       ///< the highest line, as the paper has it
  log_parabola,  ///< top of the parabola through the logarithms of three lines
  resonance,  ///< that of the parabola of measured/modal/resonance_parabola.hpp: a mode's own shape
  hann_line,  ///< of a sine through a Hann window, from the larger neighbour. For peaks
              ///< narrower than a line
};

/// How noise enters a spectrum of power.
enum class PowerNoise {
  multiplicative,  ///< autopower spectra: gamma-distributed about the true power
  additive,        ///< |H|^2: normal noise on |H|, at a valley as large as beside it
};

struct PeakSettings {
  double from_Hz = 0.0;
  double to_Hz = 1e300;
  PeakPlace place = PeakPlace::resonance;
  PowerNoise noise = PowerNoise::multiplicative;
  /// A smooth spectrum with the noise stated shows a peak or valley that is none with less than
  /// this probability, over all of its lines.
  double false_alarm_rate = 0.01;
  double least_prominence_dB = 1.0;  ///< further, whatever the noise
  /// Of lines that are not independent (`shared_line_variance`), for standard errors.
  double shared_variance = 1.0;
  /// A broader feature is none: a maximum between two zeros, a minimum between two poles.
  double most_damping_ratio = 0.25;
};

/// A maximum or minimum of a spectrum.
struct SpectralFeature {
  Feature feature = Feature::pole;  ///< a maximum is taken for a pole, a minimum for a zero
  double frequency_Hz = 0.0;        ///< as `PeakSettings::place` asks
  /// On the line: half the spacing of lines, the resolution. Else its standard deviation by the
  /// noise of the levels used; what the model of the peak's shape leaves out comes on top.
  double frequency_uncertainty_Hz = 0.0;
  double line_Hz = 0.0;
  double level_dB = 0.0;  ///< of that line
  double prominence_dB =
      0.0;  ///< above the higher of the saddles to both sides; of a valley, below
  /// Half of the width between the half-power points (of a valley, of double power) over the
  /// frequency, by measured/modal/resonance_parabola.hpp; empty where there is none. The window
  /// widens it, and random torque makes an autopower spectrum ragged.
  std::optional<double> damping_ratio;
  std::optional<double> damping_ratio_std;
};

/// Peaks and valleys of a positive spectrum of power (an autopower spectrum, or |H|^2), ascending
/// in frequency; frequencies ascend. `relative_std` is each power's
/// standard deviation relative to itself, 0 for exact ones. Values that are not finite or 0 are
/// passed over.
///
/// A feature is kept if its prominence exceeds what noise makes of a smooth spectrum, at the two
/// lines that it compares, with p the false-alarm rate over the number of lines: for multiplicative
/// noise the ratio of the quantiles at 1 - p/2 and p/2 of gamma distributions of shape
/// 1/relative_std^2, for additive noise the difference of |H| is above the normal quantile at 1 -
/// p/2 times the sum of both standard deviations.
std::vector<SpectralFeature> peaks_and_valleys(std::span<const double> frequency_Hz,
                                               std::span<const double> power,
                                               std::span<const double> relative_std,
                                               const PeakSettings& settings = {});

/// The undamped natural frequency of a mode whose own response of a sensor peaks at `peak_Hz`:
/// peak/sqrt(1 - 2 zeta^2) of displacement (0 derivatives), peak of velocity (1),
/// peak sqrt(1 - 2 zeta^2) of acceleration (2). What else is in the response shifts the peak
/// further, by zeta^2 d log |rest|/d log f of its frequency. Throws std::invalid_argument unless 0
/// <= zeta < 1/sqrt(2).
double natural_frequency_Hz(double peak_Hz, double damping_ratio, int derivative_order);

/// The features of one sensor's spectrum as rows of a modal table, poles and zeros each numbered
/// from 1. Of a pole with a damping ratio the frequency is corrected for it, of others not, nor
/// where it is on the line. A
/// resolution counts as a uniform distribution: its standard deviation is half of it over sqrt(3).
ModalTable modal_table(const arm::Sensor& sensor, std::span<const SpectralFeature> features,
                       PeakPlace place);

}  // namespace flexarm::measured
