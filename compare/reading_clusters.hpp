#pragma once

#include "compare/root_numbering.hpp"
#include "measured/run_identification.hpp"

#include <optional>
#include <span>
#include <vector>

namespace flexarm::compare {

/// Where one estimate of a pole or zero belongs.
struct RootPlace {
  std::optional<int> order;  ///< from 1; empty: none of the model's
  /// Of a pole that is the alias of a mode above the Nyquist frequency: that mode's frequency.
  std::optional<double> alias_of_Hz;
  std::optional<int> alias_of_order;  ///< where the model has that mode
};

/// Estimates by one method from one run or fit.
struct SampledReading {
  const measured::ModalReading* reading = nullptr;
  double sampling_period_s = 0.0;  ///< 0: not sampled in time, so that nothing is an alias
};

/// The places of all entries, reading by reading.
///
/// Estimates of one pole by all methods and sensors make one cluster, as do those of one zero of a
/// sensor; each has one order. Clusters are numbered by their most accurate estimate
/// (`number_roots`), or, without a model, counted from 1 up. Given tables are numbered by
/// themselves, each with the zeros of its own runs, and keep the orders that they state.
///
/// Where a fit gives poles, a pole that it lacks has an order if two readings show it.
///
/// A pole at f is taken for the alias of a mode m above the Nyquist frequency F if its part in the
/// sum over the poles
///
///     sum (ln(measured/model) - mean)^2 + kUnmatched^2 (poles without a mode)
///
/// is at least kDistinct^2 ([(f - folded)/f_m]^2 + kAliasPrice^2), and the aliases of the modes up
/// to m, k of them, would lie so near by chance with a probability of at most kMostChance:
///
///     2 k max(|f - folded|, standard error)/F;
///
/// f_m is that of the model times exp(mean), up to kMostTurns of the sampling frequency. Without a
/// model it is one if its distance from the pole below, in the root of the frequency, is below
/// kTooNear of the distance between the two poles below that, and a frequency that it may be the
/// alias of continues their distances to within kContinued: those of a beam grow evenly with the
/// order.
std::vector<std::vector<RootPlace>> place_readings(std::span<const SampledReading> readings,
                                                   const std::optional<ModelRoots>& model);

/// Estimates of one pole differ by less, in part of their frequency: peaks shift by coupling and
/// by the window. Those of a zero, whose valley noise and leakage fill, by more. Poles and zeros of
/// one sensor of a beam lie farther apart.
inline constexpr double kSamePole = 0.07;
inline constexpr double kSameZero = 0.08;
inline constexpr double kUnmatched = 0.25;
inline constexpr double kAliasPrice = 0.03;
inline constexpr double kMostChance = 0.05;
inline constexpr int kMostTurns = 8;
inline constexpr double kTooNear = 0.6;
inline constexpr double kContinued = 0.2;

}  // namespace flexarm::compare
