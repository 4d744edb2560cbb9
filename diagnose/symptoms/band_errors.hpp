#pragma once

#include "diagnose/symptoms/frequency_bands.hpp"
#include "diagnose/symptoms/symptom.hpp"
#include "diagnose/symptoms/symptoms_input.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace flexarm::diagnose {

/// The error of one sensor in one run and band. Relative numbers are root mean squares over that of
/// the sensor's whole signal in the run, so that squares of the bands add up to that of the channel
/// (`ChannelGain`); of `frf` runs weighted as in the fit.
struct BandError {
  std::size_t run = 0;  ///< index of Experiment::runs
  std::string run_id;
  std::string sensor;
  FrequencyBand band;
  std::optional<double> torque_rms_N_m;  ///< of the whole run; `time` runs
  double payload_kg = 0.0;
  double before = 0.0;
  double after = 0.0;
  double noise = 0.0;
  /// Of the power of the residuals over that of the noise, before, and how many independent numbers
  /// it is the mean of.
  double power_ratio = 0.0;
  double freedom = 0.0;
  double power_ratio_after = 0.0;  ///< the power ratio after
  /// That noise alone has this power, or more (F test; the noise is known to `kNoiseKnown`).
  double probability = 1.0;
};

/// Of each channel of `time` and `frf` runs.
std::vector<BandError> band_errors(const SymptomsInput& input);

/// The probability of a mean of `freedom` squares of noise whose power is known to `kNoiseKnown`
/// that is as large as `power_ratio` or more: F(freedom, 2/kNoiseKnown^2).
double noise_probability(double power_ratio, double freedom);

/// Excess residuals below this part of the signal of simulated runs are not interpreted where no
/// effect was found.
inline constexpr double kNegligibleError = 0.004;

/// A statement a sensor, and one of the sensors whose error is the noise's. What is beyond noise in
/// `time` runs by less than kNegligibleError is said not to be significant unless causes were
/// named.
std::vector<Symptom> error_symptoms(const SymptomsInput& input,
                                    const std::vector<BandError>& errors);

}  // namespace flexarm::diagnose
