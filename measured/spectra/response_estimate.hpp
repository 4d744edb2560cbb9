#pragma once

#include "measured/files/frequency_record.hpp"
#include "measured/files/time_record.hpp"
#include "measured/spectra/frequency_response.hpp"
#include "measured/spectra/instrument_response.hpp"
#include "measured/spectra/periodic_spectra.hpp"
#include "measured/spectra/spectrum_settings.hpp"

#include <Eigen/Core>

#include <complex>
#include <optional>
#include <vector>

namespace flexarm::measured {

/// Spectra and responses of one sensor, a value a line; NaN where unknown.
struct ChannelEstimate {
  arm::Sensor sensor;
  std::vector<double> autopower;               ///< S_yy, one-sided [unit^2/Hz]
  std::vector<double> autopower_relative_std;  ///< relative to S_yy
  /// Per unit of the input without an instrument, the torque's hold taken off where settings ask
  /// for it. Of a periodic torque they are formed of the power of a period, noise of one period
  /// included.
  FrequencyResponseEstimators estimators;
  /// The one to use, as `Estimator` has it: H1 of random torque, for a commanded torque has no
  /// noise; Hv of a hub motion, which has as much as the sensors. Of a periodic excitation the
  /// ratio of mean amplitudes, without bias whether the input is noisy or not.
  std::vector<std::complex<double>> response;
  std::vector<double> response_std;  ///< sqrt(E|d response|^2)
  /// What `response` is the ratio of, but for the hold; empty for random torque by itself.
  NoisyRatio ratio;
  /// Of |response| relative to itself, and of its phase in rad: response_std/(sqrt(2) |response|).
  std::vector<double> relative_std;
};

struct FrequencyResponseEstimate {
  std::vector<double> frequency_Hz;  ///< 0 to half the sampling frequency; periodic: driven lines
  std::vector<double> input_autopower;  ///< S_xx [(N m)^2/Hz], or [unit^2/Hz] of a hub sensor
  /// Of each line, relative to itself: of S_zx with an instrument, of the amplitude of a periodic
  /// input. Empty for random torque by itself.
  std::vector<double> input_relative_std;
  std::vector<ChannelEstimate> channels;  ///< `settings.outputs`
  /// Effective averages nd; of a periodic torque 1 + degrees of freedom of each noise variance.
  double averages = 0.0;
  std::vector<std::complex<double>> hold;  ///< responses are divided by it; 1 if not corrected
  /// At each line, of the input (index 0) and the outputs (1 + i), for `error_correlation`: spectra
  /// S_ab, or of a periodic input E[conj(d a) d b] of the amplitudes. Empty for random torque by
  /// itself and for one period.
  std::vector<Eigen::MatrixXcd> joint;
  double sampling_period_s = 0.0;
  double spacing_Hz = 0.0;          ///< of lines, driven or not
  double noise_bandwidth_Hz = 0.0;  ///< of the window
  ChosenSettings settings;
  std::optional<PeriodicSpectra> periodic;  ///< all lines of a periodic torque
};

/// Spectra, frequency responses and coherence of a record, (43)-(46) of the paper, each with its
/// standard deviation. Settings that are not given are chosen from the data
/// (measured/spectra/spectrum_settings.hpp), and reported with the reason. One pass over the record
/// in memory of a few segments for random torque; of a periodic one, memory of the record.
///
/// Throws InputError for a record without channels, and as `choose_settings` does.
FrequencyResponseEstimate estimate_frequency_response(const TimeRecord& record,
                                                      const SpectrumSettings& settings = {});

/// Whether the input is excited at a line so that the response, a ratio, is normal and free of
/// bias: its relative deviation is known and at most this, or none is known of it at all.
bool is_excited(const FrequencyResponseEstimate& estimate, std::size_t line);
inline constexpr double kMostInputStd = 0.2;

/// The responses to use with their coherence, with an instrument that of the same variance; lines
/// without a value, line 0 among them, and with an instrument those that are not excited are left
/// out, as are sensors that have none.
FrequencyRecord to_frequency_record(const FrequencyResponseEstimate& estimate);

}  // namespace flexarm::measured
