#pragma once

#include "measured/files/frequency_record.hpp"
#include "measured/files/time_record.hpp"
#include "measured/spectra/frequency_response.hpp"
#include "measured/spectra/periodic_spectra.hpp"
#include "measured/spectra/spectrum_settings.hpp"

#include <complex>
#include <optional>
#include <vector>

namespace flexarm::measured {

/// Spectra and responses of one sensor, a value a line; NaN where unknown.
struct ChannelEstimate {
  arm::Sensor sensor;
  std::vector<double> autopower;               ///< S_yy, one-sided [unit^2/Hz]
  std::vector<double> autopower_relative_std;  ///< relative to S_yy
  /// Per commanded torque, the hold taken off where settings ask for it. Of a periodic torque they
  /// are formed of the power of a period, noise of one period included.
  FrequencyResponseEstimators estimators;
  /// The one to use: H1 of random torque, for a commanded torque has no noise; of periodic torque
  /// the ratio of mean amplitudes, without bias whether the torque is noisy or not.
  std::vector<std::complex<double>> response;
  std::vector<double> response_std;  ///< sqrt(E|d response|^2)
  /// Of |response| relative to itself, and of its phase in rad: response_std/(sqrt(2) |response|).
  std::vector<double> relative_std;
};

struct FrequencyResponseEstimate {
  std::vector<double> frequency_Hz;  ///< 0 to half the sampling frequency; periodic: driven lines
  std::vector<double> torque_autopower;   ///< S_xx [(N m)^2/Hz]
  std::vector<ChannelEstimate> channels;  ///< in the order of the record
  /// Effective averages nd; of a periodic torque 1 + degrees of freedom of each noise variance.
  double averages = 0.0;
  double spacing_Hz = 0.0;          ///< of lines, driven or not
  double noise_bandwidth_Hz = 0.0;  ///< of the window
  ChosenSettings settings;
  std::optional<PeriodicSpectra> periodic;  ///< all lines of a periodic torque
};

/// Spectra, frequency responses and coherence of a record, (43)-(46) of the paper, each with its
/// standard deviation. Settings that are not given are chosen from the data
/// (measured/spectra/spectrum_settings.hpp), and reported with the reason. One pass over the record
/// in memory of a few segments for random torque; of a periodic one, memory of a channel.
///
/// Throws InputError for a record without channels, and as `choose_settings` does.
FrequencyResponseEstimate estimate_frequency_response(const TimeRecord& record,
                                                      const SpectrumSettings& settings = {});

/// The responses to use with their coherence; lines without a value, line 0 among them, are left
/// out, as are sensors that have none.
FrequencyRecord to_frequency_record(const FrequencyResponseEstimate& estimate);

}  // namespace flexarm::measured
