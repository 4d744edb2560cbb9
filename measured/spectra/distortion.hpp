#pragma once

#include "measured/spectra/periodic_spectra.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace flexarm::measured {

/// What a line of a periodic output shows.
enum class LineKind {
  driven,  ///< the input has it: the linear response, and odd distortion that cannot be told off it
  odd,     ///< not driven, an odd multiple of 1/period: odd nonlinearity
  even,    ///< not driven, an even one: even nonlinearity
};

/// One line of one output.
struct DistortionLine {
  double frequency_Hz = 0.0;
  LineKind kind = LineKind::driven;
  double amplitude = 0.0;    ///< of its sine, in the sensor's unit
  double noise_std = 0.0;    ///< of that amplitude, from what varies between periods
  double probability = 1.0;  ///< of this amplitude or more from noise alone; lines not driven
};

/// All lines of one parity together.
struct DistortionTest {
  std::size_t lines = 0;
  /// That noise alone looks so unlike noise: twice the lesser of two, Fisher's sum of the lines'
  /// log probabilities and the smallest of them. 1 where there is no line.
  double probability = 1.0;
  bool found = false;  ///< below the level of the test
  /// Root mean square of these lines, noise taken off, over that of the driven lines between
  /// which they lie, in dB; -infinity where noise explains them.
  double level_dB = 0.0;
  double noise_dB = 0.0;  ///< the noise on them, likewise
};

/// One output.
struct ChannelDistortion {
  std::vector<DistortionLine> lines;
  DistortionTest odd;
  DistortionTest even;
};

struct DistortionSettings {
  /// That anything at all is claimed of a record that is linear, with normal noise that is white
  /// over the lines around each: two tests a channel share it evenly.
  double false_alarm_rate = 1e-3;
};

struct Distortion {
  bool testable = false;
  std::string reason;                       ///< what was tested, or why nothing could be
  std::vector<ChannelDistortion> channels;  ///< one an output; empty unless testable
};

/// Odd and even nonlinear distortion from lines that an odd multisine does not drive
/// [PintelonSchoukens2012]. Tested are the lines up to the highest driven one;
/// where fewer than four odd ones there are free, those up to three times as high, below half the
/// sampling frequency by a tenth.
///
/// Not testable: one period only, for noise and distortion cannot be told apart then; an input with
/// even lines, whose sums fall on lines of either parity; no input.
Distortion distortion(const PeriodicSpectra& spectra, const DistortionSettings& settings = {});

}  // namespace flexarm::measured
