#pragma once

#include <array>
#include <functional>
#include <span>
#include <vector>

namespace flexarm::response {

/// Largest truncation error of a model whose number of modes is chosen, relative to the signal of
/// each sensor: error <= kTruncationTolerance.
inline constexpr double kTruncationTolerance = 1e-4;

/// Numbers of flexible modes that are tried, in ascending order. All but the last two have their
/// double among them, which the error of a time response is estimated from.
inline constexpr std::array kModeLadder = {4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128};
/// The most modes that are chosen: the last that have their double in the ladder. One step of so
/// many takes as long as its matrix exponential of order 256.
inline constexpr int kMostChosenModes = 64;

/// Part of a signal that is seen in a plot of it.
inline constexpr double kVisiblePart = 0.01;

/// A number of modes, and the error that it leaves.
struct ModeChoice {
  int modes = 0;                   ///< flexible ones
  std::vector<double> truncation;  ///< estimate, one a sensor, relative to its signal
  /// Fewest modes that were tried whose truncation error is within kVisiblePart at every sensor:
  /// those above are hardly seen. `modes` where none are.
  int visible_modes = 0;
};

/// Returns the fewest modes of the ladder, at most `most`, whose truncation error is within
/// `tolerance` at every sensor; the most where none are. `truncation_with(n)` returns the estimates
/// of n modes, one for each of `tolerance`.
ModeChoice choose_modes(const std::function<std::vector<double>(int modes)>& truncation_with,
                        std::span<const double> tolerance, int most = kMostChosenModes);

/// Returns an estimate of the truncation error of a signal from `coarse`, of n modes, and `fine`,
/// of 2n: 2 ||coarse - fine||/||fine||. The differences to 4n, 8n, ... modes add up to no more than
/// the first where the error falls at least as 1/n. 0 for signals that are equal.
double truncation_estimate(std::span<const double> coarse, std::span<const double> fine);

}  // namespace flexarm::response
