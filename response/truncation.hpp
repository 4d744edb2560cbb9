#pragma once

#include "response/any_formulation.hpp"
#include "response/arm_parts.hpp"
#include "response/time/simulation.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace flexarm::response {

/// Truncation error of each sensor <= kTruncationTolerance, relative to its signal, where
/// kMostChosenModes modes suffice for that.
inline constexpr double kTruncationTolerance = 1e-4;
/// A simulation of 8000 samples with so many takes a second. The acceleration of an undamped arm
/// after a jump of the torque needs more: its error falls as modes^(-3/2).
inline constexpr int kMostChosenModes = 160;
inline constexpr int kFewestChosenModes = 4;
/// Part of a sensor's signal that is seen in a plot of it.
inline constexpr double kVisiblePart = 0.01;

/// Number of flexible modes of a model, and the estimated error of leaving the others out.
struct Truncation {
  int modes = 0;
  std::vector<double> errors = {};  ///< one a sensor, relative to its signal
  bool chosen = true;               ///< false: the number was given
  /// Highest natural frequency of the modes kept without which an error is above kVisiblePart; 0
  /// where there is none, and for frequency responses.
  double visible_Hz = 0.0;

  double largest_error() const;
  bool is_within_tolerance() const { return largest_error() <= kTruncationTolerance; }
};

/// The number of modes is `given`, or the fewest from kFewestChosenModes to `most` whose errors are
/// within tolerance, or `most`.
struct ModeCount {
  std::optional<int> given = {};
  int most = kMostChosenModes;
};

/// `kMostChosenModes`, or fewer where a discrete formulation of that name has no settings for them.
int most_chosen_modes(std::string_view formulation);

/// Truncation of a simulation in time, for torque samples from rest: root mean square of the
/// response of the modes left out over that of all modes, at the samples.
///
/// The linear arm without its torque path is stepped mode by mode, by exact_tf, with four times as
/// many modes as are kept (twice as many where more than 2 kMostChosenModes are given). Where the
/// error falls as modes^(-p), the modes beyond those make the estimate low by a factor of
/// (1 - 16^(-p))^(1/2): 13 % for p = 1/2, 1 % for p = 3/2. The damping that couples modes, friction
/// and laws of the hub are left out. kMostJudgedSamples count, from the first torque on. Throws
/// InputError as `modal_model`.
Truncation truncation_in_time(const arm::Arm& arm, std::span<const arm::Sensor> sensors,
                              std::span<const double> torque_N_m, double period_s, TorqueHold hold,
                              const ModeCount& count);
inline constexpr std::size_t kMostJudgedSamples = 1 << 14;

/// Truncation of the frequency responses at `frequency_Hz` of the modes of `formulation`, with the
/// residual mode (response/residual_mode.hpp) where `static_correction` asks for it: root mean
/// square of |G_modes - G|/|G| over the frequencies. G is the formulation's transfer function.
/// Throws InputError as `modal_model`.
Truncation truncation_in_frequency(const AnyFormulation& formulation,
                                   std::span<const arm::Sensor> sensors,
                                   std::span<const double> frequency_Hz, bool static_correction,
                                   const ModeCount& count);

/// No friction of the hub, and no force that varies with the state: responses add up.
bool is_linear(const ArmParts& parts);

/// The most modes, from `least` to `most`, with which simulations of so many samples in all take
/// some seconds: a sample costs as the square of the states, and with dry friction or forces that
/// vary several times that.
int affordable_modes(const ArmParts& parts, std::size_t samples, int least, int most);

/// Frequencies at which `truncation_in_frequency` judges a band: logarithmic.
std::vector<double> judged_frequencies_Hz(double from_Hz, double to_Hz);

}  // namespace flexarm::response
