#pragma once

#include "measured/modal/fitted_transfer.hpp"
#include "measured/modal/peaks.hpp"
#include "measured/spectra/response_estimate.hpp"
#include "report/figures/figure.hpp"

#include <complex>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace flexarm::report {

/// A measured frequency response of one sensor, with what is known of its errors. All vectors are
/// of one length; `relative_std` and `coherence` may be empty.
struct MeasuredResponse {
  arm::Sensor sensor;
  std::vector<double> frequency_Hz;            ///< ascending
  std::vector<std::complex<double>> response;  ///< per unit of the input; NaN where unknown
  /// Standard deviation of |response| relative to itself, and of its phase [rad]; NaN where
  /// unknown.
  std::vector<double> relative_std = {};
  std::vector<double> coherence = {};
  double averages = 0.0;                  ///< nd, effective ones; 0: unknown
  std::optional<arm::Sensor> input = {};  ///< FrequencyRecord::input
};

/// Without values where nothing was measured: where the torque has less than a thousandth of its
/// power, and the coherence around the line is that of unrelated signals.
MeasuredResponse measured_response(const measured::FrequencyResponseEstimate& estimate,
                                   std::size_t channel);

/// The standard deviation is that of the coherence (`relative_response_std`), where both it and the
/// averages are known.
MeasuredResponse measured_response(const measured::FrequencyChannel& channel,
                                   std::optional<double> averages = {},
                                   const std::optional<arm::Sensor>& input = {});

/// The response of a model.
struct AnalyticalResponse {
  std::string name = "analytical";
  std::vector<double> frequency_Hz;
  std::vector<std::complex<double>> response;
  /// Empty: that of the arm file for the first one, of the extended arm for the second.
  std::optional<int> colour = {};
};

struct FrequencyResponsePlot {
  std::string title = {};
  Scale frequency_scale = Scale::logarithmic;
  std::optional<measured::FittedTransfer> fit = {};
  std::vector<AnalyticalResponse> analytical = {};
  /// Of the response, marked with their frequencies.
  std::vector<measured::SpectralFeature> features = {};
  std::vector<double> analytical_poles_Hz = {};  ///< faint lines, those within the frequencies
};

/// Half the width of the 95 % interval of |response| relative to it, and of its phase [rad]:
/// relative_std times Student's quantile with 2 (nd - 1) degrees of freedom, for the spread is
/// estimated from the same averages. Empty where the averages or all spreads are unknown.
std::vector<double> interval_95(const MeasuredResponse& measured);

/// Magnitude with its 95 % interval, phase, and coherence below them on one frequency axis, with
/// the fitted transfer function and models on top, in the bands that were measured. An interval
/// that reaches 0 goes on to the lower edge; the phase is left out where its interval is wider than
/// an eighth turn to both sides, and its panel where it is everywhere. The highest peak that is
/// known has its frequency beside it, whether or not it is a feature. Below the dotted line the
/// coherence of unrelated signals stays with 95 %. Without coherence that panel is left out.
///
/// Throws std::invalid_argument where no value is finite and not 0, and for vectors of unlike
/// length.
Figure frequency_response_figure(const MeasuredResponse& measured,
                                 const FrequencyResponsePlot& plot = {});

}  // namespace flexarm::report
