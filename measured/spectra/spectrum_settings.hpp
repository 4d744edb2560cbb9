#pragma once

#include "measured/files/measurement.hpp"
#include "measured/spectra/estimator.hpp"
#include "measured/spectra/period.hpp"
#include "measured/spectra/spectra.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace flexarm::measured {

/// How spectra and frequency responses are estimated. What is empty is chosen from the data.
struct SpectrumSettings {
  std::optional<Window> window = {};
  std::optional<std::size_t> segment_samples = {};
  std::optional<double> resolution_Hz =
      {};                              ///< spacing of lines, unless `segment_samples` is given
  std::optional<double> overlap = {};  ///< part of a segment, 0 to below 1
  std::optional<Detrend> detrend = {};
  /// Whether readings that drift with the free arm are differenced (`differences_until_steady`).
  std::optional<bool> difference = {};
  std::optional<bool> periodic = {};               ///< false: segments, even of a periodic torque
  std::optional<std::size_t> period_samples = {};  ///< makes the torque periodic
  std::optional<std::size_t> leave_out_periods = {};  ///< at the start, until the arm has settled
  TorqueHold hold = TorqueHold::zero;
  bool correct_hold = true;  ///< H is divided by `hold_response`, where the torque is the input
  Estimator estimator = {};
};

/// One setting in words.
struct SettingReport {
  std::string name;    ///< "segment"
  std::string value;   ///< "8192 samples, 8.192 s"
  std::string reason;  ///< why, or "given"
};

/// What the settings came to.
struct ChosenSettings {
  bool periodic = false;
  SegmentPlan plan;                  ///< unless periodic
  Period period;                     ///< if periodic: the periods found
  std::size_t left_out_periods = 0;  ///< of those
  std::vector<std::size_t> outputs;  ///< channels that responses are estimated of
  std::vector<int> differences;      ///< one an output
  TorqueHold hold = TorqueHold::zero;
  bool hold_corrected = true;
  Estimator estimator;
  std::vector<SettingReport> reports;
};

/// Chooses what is not given:
/// - as outputs all channels; those but the hub's where its motion is the input;
/// - periodic where the torque, or the instrument, repeats itself (measured/spectra/period.hpp),
/// then no window;
/// - Hann's window, as the paper has it, and the overlap that uses it up (`sufficient_overlap`);
/// - a segment that resolves the sharpest resonance: lines a sixth of its half-power width apart,
///   so that Hann's noise bandwidth is a quarter of it and the top of the peak in power too low by
///   (1/3)(1/4)^2 = 2 % [BendatPiersol2010]; no longer than leaves 10 effective averages,
///   and no shorter than 64 samples. The width is that of the narrowest peak of |H1| in a pilot
///   estimate with long segments over a million samples at most.
///
/// Throws InputError for a record of fewer than 128 samples, an input that is constant or was not
/// recorded, no output, and a given setting that the record has no room for.
ChosenSettings choose_settings(const TimeRecord& record, const SpectrumSettings& settings);

/// The outputs of `chosen` with their differences.
std::vector<Signal> output_signals(const TimeRecord& record, const ChosenSettings& chosen);

}  // namespace flexarm::measured
