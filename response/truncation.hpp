#pragma once

#include "response/any_formulation.hpp"
#include "response/time/simulation.hpp"

#include <optional>
#include <span>
#include <vector>

namespace flexarm::response {

/// Truncation error of each sensor <= kTruncationTolerance, relative to its signal, where
/// kMostChosenModes modes suffice for that.
inline constexpr double kTruncationTolerance = 1e-4;
/// A simulation of 8000 samples with so many takes a second. The acceleration of an undamped arm
/// after a jump of the torque needs more: its error falls as modes^(-3/2).
inline constexpr int kMostChosenModes = 160;
inline constexpr int kFewestChosenModes = 4;

/// Number of flexible modes of a model, and the estimated error of leaving the others out.
struct Truncation {
  int modes = 0;
  std::vector<double> errors = {};  ///< one a sensor, relative to its signal
  bool chosen = true;               ///< false: the number was given

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
/// The linear arm without its torque path is stepped mode by mode, by exact_tf, with at least twice
/// as many modes as are kept. The damping that couples modes, friction and laws of the hub are left
/// out. Of a long record the first kMostJudgedSamples count. Throws InputError as `modal_model`.
Truncation truncation_in_time(const arm::Arm& arm, std::span<const arm::Sensor> sensors,
                              std::span<const double> torque_N_m, double period_s, TorqueHold hold,
                              const ModeCount& count);
inline constexpr std::size_t kMostJudgedSamples = 1 << 16;

/// Truncation of the frequency responses at `frequency_Hz` of the modes of `formulation`, with the
/// residual mode (response/residual_mode.hpp) where `static_correction` asks for it: root mean
/// square of |G_modes - G|/|G| over the frequencies. G is the formulation's transfer function.
/// Throws InputError as `modal_model`.
Truncation truncation_in_frequency(const AnyFormulation& formulation,
                                   std::span<const arm::Sensor> sensors,
                                   std::span<const double> frequency_Hz, bool static_correction,
                                   const ModeCount& count);

/// Frequencies at which `truncation_in_frequency` judges a band: logarithmic.
std::vector<double> judged_frequencies_Hz(double from_Hz, double to_Hz);

}  // namespace flexarm::response
