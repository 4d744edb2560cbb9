#pragma once

#include "arm/arm.hpp"
#include "compare/mac.hpp"
#include "compare/measured.hpp"
#include "compare/measured_runs.hpp"
#include "measured/files/frequency_record.hpp"

#include <complex>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace flexarm::compare {

/// A measured frequency response of one sensor and those of the models at its frequencies, through
/// the linear effects of actuator and sensor.
struct MeasuredResponse {
  std::string run;  ///< empty: of a file by itself
  /// Lines with a coherence below `kLeastCoherence` are left out, unless all are.
  measured::FrequencyChannel measured;
  std::vector<std::string> models;
  std::vector<std::vector<std::complex<double>>> values;  ///< [model][frequency]
  /// [model], 100 times the root of sum |G_m - G|^2/sum |G_m|^2 over the frequencies at which both
  /// are finite.
  std::vector<double> relative_error_percent;
  std::vector<double> median_error_percent;  ///< [model], median of 100 |G_m - G|/|G_m|
  /// For a curve from the first measured frequency above 0 to the last: evenly spaced on a
  /// logarithmic axis, and the measured ones. Empty where there is no range.
  std::vector<double> curve_frequency_Hz = {};
  std::vector<std::vector<std::complex<double>>> curves = {};  ///< [model][frequency]
  std::optional<arm::Sensor> input = {};                       ///< measured::FrequencyRecord::input
  std::size_t left_out = 0;                                    ///< lines
};

/// Below it most of the power of the sensor at a line is not the torque's: a difference from a
/// model is that of noise.
inline constexpr double kLeastCoherence = 0.5;

/// The measured responses of a run beside exact_tf, fem and assumed_modes. Throws InputError for a
/// sensor that the arm cannot carry.
std::vector<MeasuredResponse> responses_beside_models(const arm::Arm& arm, const std::string& run,
                                                      const measured::FrequencyRecord& record);

/// A model within 5 % of the measured natural frequencies is a usual aim of tests of structures;
/// for signals it is a fit of 95 %.
inline constexpr double kMeasuredTolerance_percent = 5.0;

/// All that was measured of one arm, beside its models.
struct MeasuredComparison {
  std::vector<MeasuredRow> rows;
  std::vector<MeasuredResponse> responses;
  std::vector<ShapeCorrelation> shapes;         ///< one a table that has any
  std::vector<MeasuredTimeRun> runs = {};       ///< of kind `time`
  std::vector<std::string> runs_left_out = {};  ///< ids, of another payload than the arm's
  /// Ids of `time` runs that the deadline left no time to simulate.
  std::vector<std::string> runs_out_of_time = {};
  /// Largest difference of what agrees without a standard deviation (compare/measured_verdict.hpp).
  double tolerance_percent = kMeasuredTolerance_percent;
};

}  // namespace flexarm::compare
