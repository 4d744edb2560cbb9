#include "diagnose/ranked/likelihood.hpp"

#include "diagnose/parallel.hpp"
#include "measured/spectra/fourier.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <span>
#include <utility>

namespace flexarm::diagnose {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// Lines of the lowest band, at least.
constexpr Index kFewestLines = 8;

/// Replaces `values` by their orthonormal DCT-II, with one Fourier transform of the even samples
/// followed by the odd ones in reverse [Makhoul1980].
void cosine_transform(Eigen::Ref<VectorXd> values) {
  const auto n = static_cast<std::size_t>(values.size());
  std::vector<double> ordered(n);
  for (std::size_t k = 0; k < n; ++k) {
    ordered[k % 2 == 0 ? k / 2 : n - 1 - k / 2] = values[static_cast<Index>(k)];
  }
  measured::RealTransform transform(n);
  std::vector<std::complex<double>> spectrum(transform.lines());
  transform(ordered, spectrum);
  const double scale = std::sqrt(2.0 / static_cast<double>(n));
  for (std::size_t k = 0; k < n; ++k) {
    const auto line = k < spectrum.size() ? spectrum[k] : std::conj(spectrum[n - k]);
    const double angle =
        std::numbers::pi * static_cast<double>(k) / (2.0 * static_cast<double>(n));
    values[static_cast<Index>(k)] = scale * (line * std::polar(1.0, -angle)).real();
  }
  values[0] *= std::numbers::sqrt2 / 2.0;
}

/// Puts the straight line between their neighbours in the place of readings that are left out.
void bridge(const std::vector<std::size_t>& left_out, Eigen::Ref<VectorXd> values) {
  const Index n = values.size();
  for (std::size_t i = 0; i < left_out.size();) {
    std::size_t next = i + 1;
    while (next < left_out.size() && left_out[next] == left_out[next - 1] + 1) ++next;
    const auto first = static_cast<Index>(left_out[i]);
    const auto last = static_cast<Index>(left_out[next - 1]);
    const double before = first > 0 ? values[first - 1] : (last + 1 < n ? values[last + 1] : 0.0);
    const double behind = last + 1 < n ? values[last + 1] : before;
    for (Index k = first; k <= last; ++k) {
      const double part = static_cast<double>(k - first + 1) / static_cast<double>(last - first + 2);
      values[k] = before + part * (behind - before);
    }
    i = next;
  }
}

/// The first line of each octave, from the highest one down.
std::vector<Index> octaves(Index lines) {
  std::vector<Index> firsts;
  Index end = lines;
  while (end / 2 >= kFewestLines) {
    end /= 2;
    firsts.push_back(end);
  }
  firsts.push_back(0);
  return firsts;
}

}  // namespace

Likelihood::Likelihood(const Problem& problem, std::vector<bool> runs)
    : problem_(problem), runs_(std::move(runs)) {
  const Observations& observations = problem.observations();
  for (const ObservedChannel& channel : observations.channels) {
    if (!runs_[channel.run]) continue;
    const auto n = static_cast<double>(channel.count);
    if (problem.experiment().runs[channel.run].run.kind != measured::RunKind::time) {
      bands_.push_back({channel.first, channel.count, kStatedWeight, n + kStatedWeight});
      continue;
    }
    VectorXd signal = observations.values.segment(channel.first, channel.count)
                          .cwiseQuotient(observations.deviations.segment(channel.first,
                                                                         channel.count));
    bridge(channel.left_out, signal);
    signal.array() -= signal.mean();
    cosine_transform(signal);
    const double truncation = std::pow(channel.numerical_error / channel.floor(), 2);
    Index end = channel.count;
    for (const Index first : octaves(channel.count)) {
      const Index count = end - first;
      const double followed =
          kDiscrepancy * kDiscrepancy * signal.segment(first, count).squaredNorm();
      const auto size = static_cast<double>(count);
      bands_.push_back({channel.first + first, count, size * truncation + followed, size});
      end = first;
    }
  }
}

VectorXd Likelihood::lines(const VectorXd& residuals) const {
  VectorXd made = residuals;
  const auto& channels = problem_.observations().channels;
  in_parallel(channels.size(), [&](std::size_t c) {
    const ObservedChannel& channel = channels[c];
    const auto kind = problem_.experiment().runs[channel.run].run.kind;
    if (!runs_[channel.run] || kind != measured::RunKind::time) return;
    auto part = made.segment(channel.first, channel.count);
    bridge(channel.left_out, part);
    cosine_transform(part);
  });
  return made;
}

double Likelihood::cost_of_squares(const VectorXd& squares) const {
  double cost = squares.tail(squares.size() - problem_.observations().values.size()).sum();
  for (const Band& band : bands_) {
    const double sum = band.added + squares.segment(band.first, band.count).sum();
    cost += band.weight * std::log(sum / band.weight);
  }
  return cost;
}

VectorXd Likelihood::weights(const VectorXd& lines) const {
  VectorXd made = VectorXd::Zero(lines.size());
  made.tail(lines.size() - problem_.observations().values.size()).setOnes();
  for (const Band& band : bands_) {
    const double sum = band.added + lines.segment(band.first, band.count).squaredNorm();
    made.segment(band.first, band.count).setConstant(band.weight / sum);
  }
  return made;
}

}  // namespace flexarm::diagnose
