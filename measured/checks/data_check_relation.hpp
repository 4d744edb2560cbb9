#pragma once

#include "measured/checks/data_check_transform.hpp"

#include <complex>
#include <cstddef>
#include <functional>
#include <vector>

namespace flexarm::measured {

/// A signal, or a derivative of it.
struct Quantity {
  std::size_t signal = 0;
  int order = 0;  ///< of the derivative
};

/// How well x = gain y(t - delay) holds over the blocks of frequencies in which x and y are
/// coherent, and with what gain.
struct GainFit {
  std::size_t blocks = 0;     ///< with coherence squared of kLeastCoherence or more
  double log10_gain = 0.0;    ///< weighted median of log10 sqrt(Sxx/Syy)
  double spread = 0.0;        ///< weighted median of the blocks' distances from it
  double plain_spread = 0.0;  ///< their median distance, all of one weight
  double log10_h1 = 0.0;      ///< as log10_gain, of |Sxy|/Syy: all noise is in x
  double log10_h2 = 0.0;      ///< of Sxx/|Sxy|: all noise is in y
  int sign = 1;
  double delay_s = 0.0;        ///< x later than y
  double delay_error_s = 0.0;  ///< standard error
  double agreement = 0.0;      ///< weighted mean cosine of what phase is left, -1 to 1
};
inline constexpr double kLeastCoherence = 0.8;

/// Blocks are eight lines (1/duration) wide, from the lowest up to 0.3 of the sampling frequency.
GainFit fit_gain(const Transforms& transforms, Quantity x, Quantity y);

/// A value a bin, of whatever the transforms give.
using LineValues = std::function<std::complex<double>(std::size_t bin)>;
/// The same of x(bin) = gain y(bin) exp(-i omega delay).
GainFit fit_gain(const Transforms& transforms, const LineValues& x, const LineValues& y);

/// Distance of x(bin) from y(bin): the mean over the blocks of |x - y|^2/(|x|^2 + |y|^2), 0 to 2,
/// 1 for what is unrelated and without blocks. `counted` says of each block whether it counts; all
/// do where it is empty.
double distance(const Transforms& transforms, const LineValues& x, const LineValues& y,
                const std::vector<bool>& counted = {});

/// Blocks with coherence squared of kLeastCoherence or more, of all.
std::vector<bool> coherent_among_blocks(const Transforms& transforms, const LineValues& x,
                                        const LineValues& y);

/// x against y over the lines below a frequency.
struct LowFrequencyFit {
  double score = 0.0;        ///< sum Re(X conj Y) over its standard deviation, were X and Y white
                             ///< noise of their floors, at least one of them
  double correlation = 0.0;  ///< the same over the root of both powers, -1 to 1
  double gain = 0.0;         ///< real, least squares of x = gain y
};

LowFrequencyFit fit_low_frequencies(const Transforms& transforms, Quantity x, Quantity y,
                                    double to_Hz);

/// Mean coherence squared of x and y over the blocks, each weighted with the power of x's signal
/// there, not of its derivative. Unrelated signals show 1/8.
double mean_coherence(const Transforms& transforms, Quantity x, Quantity y);

/// Blocks with coherence squared of kLeastCoherence or more. Of unrelated signals one in 80,000 is:
/// (1 - 0.8)^7.
std::size_t coherent_blocks(const Transforms& transforms, Quantity x, Quantity y);

}  // namespace flexarm::measured
