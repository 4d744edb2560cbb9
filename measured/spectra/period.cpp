#include "measured/spectra/period.hpp"

#include "measured/spectra/fourier.hpp"

#include <unsupported/Eigen/FFT>

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

namespace flexarm::measured {

namespace {

using Complex = std::complex<double>;

constexpr std::size_t kMostPiece = 4096;
/// Correlation below which a signal no longer resembles itself, and above which it does again.
constexpr double kUnlike = 0.5;
constexpr double kAlike = 0.9;
/// The part of periods' differences that a shift may explain; of noise it is 1/samples.
constexpr double kMostShift = 0.5;
/// Squares of rounding in a file of six digits.
constexpr double kFileRounding = 1e-11;

struct Piece {
  std::size_t first = 0;
  std::size_t length = 0;
};

double energy(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return sum;
}

/// The piece of the second half with the most energy.
Piece strongest_piece(std::span<const double> x) {
  const std::size_t length = std::min(kMostPiece, x.size() / 4);
  Piece best{x.size() - length, length};
  double most = -1.0;
  for (std::size_t end = x.size(); end >= x.size() / 2 + length; end -= length) {
    const double found = energy(x.subspan(end - length, length));
    if (found > most) {
      most = found;
      best.first = end - length;
    }
  }
  return best;
}

/// sum_j x[piece.first + j] x[piece.first - lag + j] for lag = 0 to piece.first, over the geometric
/// mean of both energies; by overlapping blocks, each transformed.
std::vector<double> correlations(std::span<const double> x, const Piece& piece) {
  const std::size_t block = fast_length(8 * piece.length);
  const std::size_t valid = block - piece.length + 1;
  const auto length = static_cast<Eigen::Index>(block);
  Eigen::FFT<double> transform;
  transform.SetFlag(Eigen::FFT<double>::HalfSpectrum);
  std::vector<double> values(block);
  std::vector<Complex> pattern(block / 2 + 1);
  std::vector<Complex> spectrum(block / 2 + 1);
  const auto wanted = x.subspan(piece.first, piece.length);
  std::ranges::copy(wanted, values.begin());
  transform.fwd(pattern.data(), values.data(), length);

  std::vector<double> made(piece.first + 1);
  const double own = energy(wanted);
  double other = energy(x.first(piece.length));
  for (std::size_t start = 0; start <= piece.first; start += valid) {
    const std::size_t available = std::min(block, x.size() - start);
    std::copy_n(x.begin() + static_cast<std::ptrdiff_t>(start), available, values.begin());
    std::fill(values.begin() + static_cast<std::ptrdiff_t>(available), values.end(), 0.0);
    transform.fwd(spectrum.data(), values.data(), length);
    for (std::size_t k = 0; k < spectrum.size(); ++k) spectrum[k] *= std::conj(pattern[k]);
    transform.inv(values.data(), spectrum.data(), length);
    for (std::size_t at = start; at < start + valid && at <= piece.first; ++at) {
      const double both = own * other;
      made[piece.first - at] = both > 0.0 ? values[at - start] / std::sqrt(both) : 0.0;
      if (at + piece.length == x.size()) break;
      other += x[at + piece.length] * x[at + piece.length] - x[at] * x[at];
      other = std::max(other, 0.0);
    }
  }
  return made;
}

/// Mean square of the difference of two periods over the sum of their mean squares.
double mismatch(std::span<const double> x, std::size_t first, std::size_t second,
                std::size_t period) {
  double difference = 0.0;
  double power = 0.0;
  for (std::size_t j = 0; j < period; ++j) {
    const double a = x[first + j];
    const double b = x[second + j];
    difference += (a - b) * (a - b);
    power += a * a + b * b;
  }
  return power > 0.0 ? difference / power : 0.0;
}

/// The part of the last two periods' difference that a shift in time explains: its squared
/// correlation with the signal's slope.
double explained_by_shift(std::span<const double> x, std::size_t period) {
  double both = 0.0;
  double slopes = 0.0;
  double differences = 0.0;
  for (std::size_t k = x.size() - period; k + 1 < x.size(); ++k) {
    const double slope = 0.5 * (x[k + 1] - x[k - 1]);
    const double difference = x[k] - x[k - period];
    both += slope * difference;
    slopes += slope * slope;
    differences += difference * difference;
  }
  return slopes * differences > 0.0 ? both * both / (slopes * differences) : 0.0;
}

std::optional<Period> checked(std::span<const double> x, std::size_t samples) {
  const Period found = periods_of(x, samples);
  if (found.periods < 2 || 2 * found.periods * samples < x.size()) return std::nullopt;
  const double apart = mismatch(x, x.size() - found.periods * samples, x.size() - samples, samples);
  if (apart > kMostMismatch) return std::nullopt;
  if (found.mismatch > kFileRounding && explained_by_shift(x, samples) > kMostShift) {
    return std::nullopt;
  }
  return found;
}

}  // namespace

Period periods_of(std::span<const double> values, std::size_t period_samples) {
  Period made{period_samples, 0, 0.0};
  if (period_samples == 0 || period_samples > values.size()) return made;
  made.periods = 1;
  double sum = 0.0;
  for (std::size_t end = values.size(); end >= 2 * period_samples; end -= period_samples) {
    const double found =
        mismatch(values, end - 2 * period_samples, end - period_samples, period_samples);
    if (found > kMostMismatch) break;
    sum += found;
    ++made.periods;
  }
  if (made.periods > 1) made.mismatch = sum / static_cast<double>(made.periods - 1);
  return made;
}

std::optional<Period> find_period(std::span<const double> values) {
  constexpr std::size_t kFewestSamples = 16;
  if (values.size() < kFewestSamples) return std::nullopt;
  std::vector<double> x(values.begin(), values.end());
  double mean = 0.0;
  for (const double value : x) mean += value / static_cast<double>(x.size());
  for (double& value : x) value -= mean;
  const double largest =
      std::abs(*std::ranges::max_element(x, {}, [](double value) { return std::abs(value); }));
  constexpr double kConstant = 1e-12;
  if (!(largest > kConstant * std::abs(mean))) return std::nullopt;

  const Piece piece = strongest_piece(x);
  const auto correlation = correlations(x, piece);
  const std::size_t most_lag = std::min(correlation.size() - 2, values.size() / 2);
  std::size_t lag = 1;
  while (lag <= most_lag && correlation[lag] > kUnlike) ++lag;
  std::vector<std::size_t> candidates;
  double best = kAlike;
  for (; lag <= most_lag; ++lag) {
    if (correlation[lag] < correlation[lag - 1] || correlation[lag] < correlation[lag + 1])
      continue;
    if (correlation[lag] < kAlike) continue;
    candidates.push_back(lag);
    best = std::max(best, correlation[lag]);
  }
  constexpr double kTransformRounding = 1e-9;
  const double enough = 1.0 - 2.0 * (1.0 - best) - kTransformRounding;
  for (const std::size_t candidate : candidates) {
    if (correlation[candidate] < enough) continue;
    if (auto found = checked(x, candidate)) return found;
  }
  return std::nullopt;
}

}  // namespace flexarm::measured
