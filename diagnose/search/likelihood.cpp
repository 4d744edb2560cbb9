#include "diagnose/search/likelihood.hpp"

#include "diagnose/parallel.hpp"
#include "measured/spectra/fourier.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <map>
#include <numbers>
#include <utility>
#include <variant>

namespace flexarm::diagnose {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// The square, in standard deviations of the noise, below which a line is as good as none.
constexpr double kLeastSquare = 1e-12;

/// Lines of the lowest band, at least.
constexpr Index kFewestLines = 8;

/// Flexible modes beyond those that are needed, by which the truncation of a simulation is judged.
constexpr int kFurtherModes = 4;

/// The orthonormal DCT-II of one length, by one Fourier transform of the even samples followed by
/// the odd ones in reverse [Makhoul1980].
class CosineTransform {
 public:
  explicit CosineTransform(std::size_t samples)
      : transform_(samples), ordered_(samples), spectrum_(transform_.lines()) {
    const auto n = static_cast<double>(samples);
    for (std::size_t k = 0; k < samples; ++k) {
      const double angle = std::numbers::pi * static_cast<double>(k) / (2.0 * n);
      turns_.push_back(std::polar(std::sqrt((k == 0 ? 1.0 : 2.0) / n), -angle));
    }
  }

  void operator()(Eigen::Ref<VectorXd> values) {
    const std::size_t n = ordered_.size();
    for (std::size_t k = 0; k < n; ++k) {
      ordered_[k % 2 == 0 ? k / 2 : n - 1 - k / 2] = values[static_cast<Index>(k)];
    }
    transform_(ordered_, spectrum_);
    for (std::size_t k = 0; k < n; ++k) {
      const auto line = k < spectrum_.size() ? spectrum_[k] : std::conj(spectrum_[n - k]);
      values[static_cast<Index>(k)] = (line * turns_[k]).real();
    }
  }

 private:
  measured::RealTransform transform_;
  std::vector<double> ordered_;
  std::vector<std::complex<double>> spectrum_;
  std::vector<std::complex<double>> turns_;
};

/// Replaces `values` by their DCT-II. A transform has buffers, so that each thread has its own; it
/// keeps those of the lengths that it has met.
void cosine_transform(Eigen::Ref<VectorXd> values) {
  thread_local std::map<std::size_t, CosineTransform> transforms;
  const auto n = static_cast<std::size_t>(values.size());
  transforms.try_emplace(n, n).first->second(values);
}

/// Samples of a channel that are transformed: the first ones, as many as are quick to transform.
Index transformed(const ObservedChannel& channel) {
  return static_cast<Index>(measured::fast_length_within(static_cast<std::size_t>(channel.count)));
}

/// Puts the straight line between their neighbours in the place of readings that are left out.
void bridge(const std::vector<std::size_t>& left_out, Eigen::Ref<VectorXd> values) {
  const Index n = values.size();
  for (std::size_t i = 0; i < left_out.size() && static_cast<Index>(left_out[i]) < n;) {
    std::size_t next = i + 1;
    while (next < left_out.size() && left_out[next] == left_out[next - 1] + 1) ++next;
    const auto first = static_cast<Index>(left_out[i]);
    const Index last = std::min(static_cast<Index>(left_out[next - 1]), n - 1);
    const double before = first > 0 ? values[first - 1] : (last + 1 < n ? values[last + 1] : 0.0);
    const double behind = last + 1 < n ? values[last + 1] : before;
    for (Index k = first; k <= last; ++k) {
      const double part =
          static_cast<double>(k - first + 1) / static_cast<double>(last - first + 2);
      values[k] = before + part * (behind - before);
    }
    i = next;
  }
}

/// Returns the first line of each octave, from the highest one down.
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

/// Returns the first number of each octave of a channel of a response, from the highest one down.
/// A line has two numbers, real and imaginary part.
std::vector<Index> octaves(const std::vector<double>& frequencies_Hz) {
  std::vector<Index> firsts;
  auto end = std::ssize(frequencies_Hz);
  while (end > kFewestLines) {
    const double top_Hz = frequencies_Hz[static_cast<std::size_t>(end - 1)];
    Index first = end;
    while (first > 0 && (frequencies_Hz[static_cast<std::size_t>(first - 1)] > 0.5 * top_Hz ||
                         end - first < kFewestLines)) {
      --first;
    }
    if (first < kFewestLines) break;
    firsts.push_back(2 * first);
    end = first;
  }
  firsts.push_back(0);
  return firsts;
}

/// Returns the change of the residuals of the arm as filed by a simulation with `modes` flexible
/// modes, of the `time` runs among `runs`; 0 where there is no such arm, and by a Kalman filter,
/// whose noise model stands for it.
VectorXd truncation_of(const Problem& problem, std::vector<bool> runs, int modes) {
  if (problem.predictor().noise()) return VectorXd::Zero(problem.residual_count());
  for (std::size_t r = 0; r < runs.size(); ++r) {
    if (problem.experiment().runs[r].run.kind != measured::RunKind::time) runs[r] = false;
  }
  const Candidate filed = problem.as_filed();
  const auto with_own = problem.residuals(filed, runs);
  const auto with_more = problem.with_modes(modes).residuals(filed, runs);
  if (!with_own || !with_more) return VectorXd::Zero(problem.residual_count());
  return *with_own - *with_more;
}

/// Returns the change of the residuals by the error of the measured motion, of an arm that is
/// driven by it or whose torque is balanced with it; else 0. One draw of that error is computed,
/// and multiplied by Policy::motion_draws, d. Noise of the motion excites the simulated resonances,
/// from which damping takes it, and is the torque of an inertia, which a lower inertia takes. The
/// gain in one octave is 8 ln(1 + 1/d^2) at most, in the same direction in some 100 octaves: it is
/// to be less than the price of an effect.
VectorXd motion_error_of(const Problem& problem) {
  if (!is_driven_by_motion(problem.experiment())) return VectorXd::Zero(problem.residual_count());
  const Observations& observations = problem.observations();
  VectorXd made = VectorXd::Zero(problem.residual_count());
  made.head(observations.values.size()) =
      problem.policy().motion_draws * change_by_motion_error(problem.experiment(), observations,
                                                             problem.predictor().flexible_modes(),
                                                             problem.predictor().deadline())
                                          .cwiseQuotient(observations.deviations);
  return made;
}

}  // namespace

Likelihood::Likelihood(const Problem& problem, std::vector<bool> runs)
    : Likelihood(problem, std::move(runs), problem.predictor().flexible_modes()) {}

Likelihood::Likelihood(const Problem& problem, std::vector<bool> runs, int flexible_modes)
    : problem_(problem), runs_(std::move(runs)) {
  const Observations& observations = problem.observations();
  const VectorXd known =
      lines(truncation_of(problem, runs_, flexible_modes + kFurtherModes)).cwiseAbs2() +
      lines(motion_error_of(problem)).cwiseAbs2();
  // Innovations of a Kalman filter follow the data, from one sample to the next.
  const double discrepancy = problem.predictor().noise() ? 0.0 : std::pow(policy().discrepancy, 2);
  for (const ObservedChannel& channel : observations.channels) {
    if (!runs_[channel.run]) continue;
    const auto& data = problem.experiment().runs[channel.run].data;
    if (const auto* record = std::get_if<measured::FrequencyRecord>(&data)) {
      Index end = channel.count;
      for (const Index first : octaves(response_of(*record, channel).frequency_Hz)) {
        bands_.push_back({.first = channel.first + first, .count = end - first, .is_stated = true});
        end = first;
      }
      continue;
    }
    if (std::holds_alternative<measured::ModalTable>(data)) {
      bands_.push_back({.first = channel.first, .count = channel.count, .is_stated = true});
      continue;
    }
    const Index samples = transformed(channel);
    const double line_Hz =
        0.5 / (static_cast<double>(samples) *
               measured::sampling_period_s(std::get<measured::TimeRecord>(data)));
    VectorXd signal = observations.values.segment(channel.first, samples)
                          .cwiseQuotient(observations.deviations.segment(channel.first, samples));
    bridge(channel.left_out, signal);
    signal.array() -= signal.mean();
    cosine_transform(signal);
    Index end = samples;
    for (const Index first : octaves(samples)) {
      const Index count = end - first;
      const double followed = discrepancy * signal.segment(first, count).squaredNorm() +
                              kLeastSquare * static_cast<double>(count);
      bands_.push_back({.first = channel.first + first,
                        .count = count,
                        .added = known.segment(channel.first + first, count).sum() + followed,
                        .line_Hz = line_Hz,
                        .lowest_Hz = static_cast<double>(first) * line_Hz});
      end = first;
    }
  }
  take(SampleSize::of_model_error);
}

void Likelihood::take(SampleSize sample_size) {
  for (Band& band : bands_) {
    const auto n = static_cast<double>(band.count);
    const bool is_of_noise = sample_size == SampleSize::of_noise && !band.is_stated;
    const double most = policy().sample_size;
    band.sample_size = is_of_noise ? n : band.is_stated ? most : std::min(n, most);
  }
}

Likelihood Likelihood::with(SampleSize sample_size) const {
  Likelihood made = *this;
  made.take(sample_size);
  return made;
}

VectorXd Likelihood::lines(const VectorXd& residuals) const {
  VectorXd made = residuals;
  const auto& channels = problem_.observations().channels;
  in_parallel(channels.size(), [&](std::size_t c) {
    const ObservedChannel& channel = channels[c];
    const auto kind = problem_.experiment().runs[channel.run].run.kind;
    if (!runs_[channel.run] || kind != measured::RunKind::time) return;
    const Index samples = transformed(channel);
    auto part = made.segment(channel.first, channel.count);
    bridge(channel.left_out, part);
    cosine_transform(part.head(samples));
    part.tail(channel.count - samples).setZero();
  });
  return made;
}

std::optional<VectorXd> Likelihood::lines_of(const Candidate& candidate) const {
  const auto residuals = problem_.residuals(candidate, runs_);
  if (!residuals) return std::nullopt;
  return lines(*residuals);
}

double Likelihood::cost_of(const Candidate& candidate) const {
  const auto lines = lines_of(candidate);
  return lines ? cost(*lines) : std::numeric_limits<double>::infinity();
}

double Likelihood::Band::cost(double sum) const {
  const double m = sample_size;
  const auto n = static_cast<double>(count);
  if (!is_stated) return m * std::log((added + sum) / n);
  return sum <= n ? sum : n + m * std::log1p((sum - n) / m);
}

double Likelihood::Band::slope(double sum) const {
  const double m = sample_size;
  const auto n = static_cast<double>(count);
  if (!is_stated) return m / (added + sum);
  return sum <= n ? 1.0 : m / (m + sum - n);
}

double Likelihood::cost_of_squares(const VectorXd& squares) const {
  double cost = squares.tail(squares.size() - problem_.observations().values.size()).sum();
  for (const Band& band : bands_) cost += band.cost(squares.segment(band.first, band.count).sum());
  return cost;
}

bool Likelihood::is_noise(const VectorXd& lines) const {
  double excess = 0.0;
  double variance = 0.0;
  for (const Band& band : bands_) {
    const auto n = static_cast<double>(band.count);
    const double own = lines.segment(band.first, band.count).squaredNorm() - n -
                       policy().error_factor * band.added;
    if (own > policy().band_deviations * std::sqrt(2.0 * n)) return false;
    excess += own;
    variance += 2.0 * n;
  }
  const Index nuisances = lines.size() - problem_.observations().values.size();
  const auto n = static_cast<double>(nuisances);
  const double own = lines.tail(nuisances).squaredNorm() - n;
  if (own > policy().band_deviations * std::sqrt(2.0 * n)) return false;
  return excess <= policy().total_deviations * std::sqrt(variance);
}

std::vector<double> Likelihood::peaks_Hz(const VectorXd& lines, std::size_t most) const {
  struct Peak {
    double share = 0.0;  // of the squares of its octave
    double frequency_Hz = 0.0;
  };
  std::vector<Peak> peaks;
  double resolution_Hz = std::numeric_limits<double>::infinity();
  for (const Band& band : bands_) {
    if (band.line_Hz == 0.0) continue;
    resolution_Hz = std::min(resolution_Hz, 2.0 * band.line_Hz);
    Index at = 0;
    const VectorXd squares = lines.segment(band.first, band.count).cwiseAbs2();
    const double share = squares.maxCoeff(&at) / squares.sum();
    peaks.push_back({share, band.lowest_Hz + static_cast<double>(at) * band.line_Hz});
  }
  std::ranges::stable_sort(peaks, std::ranges::greater{}, &Peak::share);
  std::vector<double> made;
  for (const Peak& peak : peaks) {
    if (made.size() == most) break;
    const bool is_met = std::ranges::any_of(made, [&](double other_Hz) {
      return std::abs(other_Hz - peak.frequency_Hz) < resolution_Hz;
    });
    if (!is_met && peak.frequency_Hz > 0.0) made.push_back(peak.frequency_Hz);
  }
  return made;
}

VectorXd Likelihood::weights(const VectorXd& lines) const {
  VectorXd made = VectorXd::Zero(lines.size());
  made.tail(lines.size() - problem_.observations().values.size()).setOnes();
  for (const Band& band : bands_) {
    const double sum = lines.segment(band.first, band.count).squaredNorm();
    made.segment(band.first, band.count).setConstant(band.slope(sum));
  }
  return made;
}

}  // namespace flexarm::diagnose
