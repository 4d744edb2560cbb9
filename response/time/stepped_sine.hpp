#pragma once

#include "response/excitation/excitation_keys.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::response {

/// From the first frequency to the last, both included where the step leads to it.
struct SineBand {
  double from_Hz = 0.0;
  double to_Hz = 0.0;

  bool operator==(const SineBand&) const = default;
};

/// The torque offset + amplitude sin(2 pi f t), one frequency after another, as a spectrum analyser
/// drives an arm: each until the transient is gone, then over whole cycles in which readings are
/// correlated with sine and cosine (the paper's section 6: Tables 4 and 5).
struct SteppedSine {
  double amplitude_N_m = 0.05;
  /// A constant torque beside the sine, the paper's bias against friction; the response is to the
  /// sine alone.
  double offset_N_m = 0.0;
  std::vector<SineBand> bands = {{1.0, 50.0}};  ///< ascending, apart
  double step_Hz = 0.1;                         ///< from one frequency to the next
  std::optional<int> points;                    ///< of each band, evenly spaced; in place of a step
  /// How long the arm is driven before it is measured, at each frequency, rounded up to whole
  /// cycles. Empty: it is measured in its steady state (response/time/steady_state.hpp).
  std::optional<double> settle_s;
  int cycles = 4;  ///< measured
};

inline constexpr std::string_view kSteppedSine = "stepped-sine";
inline constexpr int kMostSineFrequencies = 100'000;
inline constexpr int kMostSineCycles = 10'000;
inline constexpr double kMostSettlingPeriods = 1e7;  ///< of the highest frequency

/// The frequencies of all bands, ascending; a sum from + k step as the nearest double to its
/// decimal of 9 places where it is one. Throws InputError for a number out of its range, bands that
/// are not ascending and apart, and more than `kMostSineFrequencies`.
std::vector<double> frequencies_Hz(const SteppedSine& sine);

/// Its numbers: amplitude, offset, bands ("2.5:3.5/11:13"), step or points, settle (seconds or
/// "steady"), cycles.
std::vector<ExcitationKey> keys_of(const SteppedSine& sine);

/// Reads keys with their values: those of `keys_of`, and `from` and `to` in place of one band.
/// Throws InputError for an unknown key, with `further` among those allowed, a value that is none,
/// and keys that exclude each other.
SteppedSine stepped_sine_of(const std::vector<std::pair<std::string, std::string>>& keys,
                            const std::vector<std::string>& further = {});

}  // namespace flexarm::response
