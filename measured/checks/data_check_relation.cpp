#include "measured/checks/data_check_relation.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numeric>

namespace flexarm::measured {

namespace {

constexpr double kLinesInBlock = 8.0;
constexpr double kHighestShare = 0.3;  // of the sampling frequency
/// Delays that are looked for [periods]; beyond, a sine's phase repeats.
constexpr double kMostDelay = 12.0;
constexpr double kDelayStep = 0.25;  // a third of a turn of the highest frequency, at most

struct Block {
  double omega_rad_per_s = 0.0;
  double xx = 0.0;
  double yy = 0.0;
  std::complex<double> xy;

  double coherence() const { return xx > 0.0 && yy > 0.0 ? std::norm(xy) / (xx * yy) : 0.0; }
};

/// Blocks of two series of values, x(bin) and y(bin).
std::vector<Block> blocks_of(const Transforms& transforms, const LineValues& x, const LineValues& y,
                             double highest_share) {
  const auto width = static_cast<std::size_t>(std::ceil(kLinesInBlock * transforms.bins_per_line));
  const std::size_t end =
      std::min(transforms.bins(), transforms.bin_at(highest_share / transforms.period_s) + 1);
  std::vector<Block> blocks;
  for (std::size_t from = 1; from + width <= end; from += width) {
    Block block;
    block.omega_rad_per_s = transforms.omega_rad_per_s(from) +
                            0.5 * static_cast<double>(width - 1) * transforms.spacing_rad_per_s;
    double power = 0.0;
    double moment = 0.0;
    for (std::size_t bin = from; bin < from + width; ++bin) {
      const auto a = x(bin);
      const auto b = y(bin);
      block.xx += std::norm(a);
      block.yy += std::norm(b);
      const std::complex<double> cross = a * std::conj(b);
      block.xy += cross;
      const double size = std::sqrt(std::norm(cross));  // std::abs guards against overflow, slowly
      power += size;
      moment += size * transforms.omega_rad_per_s(bin);
    }
    if (power > 0.0) block.omega_rad_per_s = moment / power;
    blocks.push_back(block);
  }
  return blocks;
}

LineValues values_of(const Transforms& transforms, Quantity quantity) {
  return [&transforms, quantity](std::size_t bin) {
    return transforms.derivative(quantity.signal, quantity.order, bin);
  };
}

struct Weighted {
  double value = 0.0;
  double weight = 0.0;
};

double weighted_median(std::vector<Weighted> values) {
  std::ranges::sort(values, {}, &Weighted::value);
  double total = 0.0;
  for (const auto& entry : values) total += entry.weight;
  double sum = 0.0;
  for (const auto& entry : values) {
    sum += entry.weight;
    if (2.0 * sum >= total) return entry.value;
  }
  return 0.0;
}

/// 1/variance of a block's phase: 2 n g/(1 - g) for coherence squared g of n lines (Bendat and
/// Piersol). Coherence above 0.999 is not told from it.
double phase_weight(const Block& block) {
  const double g = std::min(block.coherence(), 0.999);
  return 2.0 * kLinesInBlock * g / (1.0 - g);
}

/// Sum of weights times cos(phase + omega delay).
double alignment(const std::vector<Block>& blocks, double delay_s) {
  double sum = 0.0;
  for (const auto& block : blocks) {
    sum += phase_weight(block) * std::cos(std::arg(block.xy) + block.omega_rad_per_s * delay_s);
  }
  return sum;
}

void fit_delay(const std::vector<Block>& blocks, double period_s, GainFit& fit) {
  double total = 0.0;
  double curvature = 0.0;
  for (const auto& block : blocks) {
    total += phase_weight(block);
    curvature += phase_weight(block) * block.omega_rad_per_s * block.omega_rad_per_s;
  }
  // Where the band is narrow many delays align the phases, with either sign: the smallest counts.
  constexpr double kPreference = 0.01;  // of the alignment, a period
  double best = -1.0;
  for (double delay = -kMostDelay; delay <= kMostDelay; delay += kDelayStep) {
    const double aligned = alignment(blocks, delay * period_s);
    const double score = std::abs(aligned) / total - kPreference * std::abs(delay);
    if (score <= best) continue;
    best = score;
    fit.delay_s = delay * period_s;
    fit.sign = aligned < 0.0 ? -1 : 1;
  }
  // Newton's steps on the alignment.
  for (int i = 0; i < 5; ++i) {
    double slope = 0.0;
    for (const auto& block : blocks) {
      const double phase =
          std::arg(block.xy * static_cast<double>(fit.sign)) + block.omega_rad_per_s * fit.delay_s;
      slope += phase_weight(block) * block.omega_rad_per_s * std::sin(phase);
    }
    fit.delay_s -= slope / curvature;
  }
  fit.agreement = fit.sign * alignment(blocks, fit.delay_s) / total;
  // Phases scatter by more than their noise where the arm is not quite as described.
  double scatter = 0.0;
  for (const auto& block : blocks) {
    const double phase = std::arg(block.xy * static_cast<double>(fit.sign) *
                                  std::polar(1.0, block.omega_rad_per_s * fit.delay_s));
    scatter += phase_weight(block) * phase * phase;
  }
  const double freedom = std::max(1.0, static_cast<double>(blocks.size()) - 1.0);
  fit.delay_error_s = std::sqrt(std::max(1.0, scatter / freedom) / curvature);
}

}  // namespace

GainFit fit_gain(const Transforms& transforms, Quantity x, Quantity y) {
  return fit_gain(transforms, values_of(transforms, x), values_of(transforms, y));
}

GainFit fit_gain(const Transforms& transforms, const LineValues& x, const LineValues& y) {
  std::vector<Block> blocks = blocks_of(transforms, x, y, kHighestShare);
  std::erase_if(blocks, [](const Block& block) { return block.coherence() < kLeastCoherence; });
  GainFit fit;
  fit.blocks = blocks.size();
  if (blocks.empty()) return fit;
  std::vector<Weighted> gains;
  std::vector<Weighted> h1;
  std::vector<Weighted> h2;
  for (const auto& block : blocks) {
    const double weight = phase_weight(block);
    gains.push_back({0.5 * std::log10(block.xx / block.yy), weight});
    h1.push_back({std::log10(std::abs(block.xy) / block.yy), weight});
    h2.push_back({std::log10(block.xx / std::abs(block.xy)), weight});
  }
  fit.log10_h1 = weighted_median(std::move(h1));
  fit.log10_h2 = weighted_median(std::move(h2));
  fit.log10_gain = weighted_median(gains);
  for (auto& gain : gains) gain.value = std::abs(gain.value - fit.log10_gain);
  fit.spread = weighted_median(gains);
  for (auto& gain : gains) gain.weight = 1.0;
  fit.plain_spread = weighted_median(std::move(gains));
  fit_delay(blocks, transforms.period_s, fit);
  return fit;
}

double distance(const Transforms& transforms, const LineValues& x, const LineValues& y,
                const std::vector<bool>& counted) {
  const auto blocks = blocks_of(transforms, x, y, kHighestShare);
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    if (!counted.empty() && !counted[i]) continue;
    const double power = blocks[i].xx + blocks[i].yy;
    sum += power > 0.0 ? 1.0 - 2.0 * blocks[i].xy.real() / power : 1.0;
    count += 1.0;
  }
  return count > 0.0 ? sum / count : 1.0;
}

std::vector<bool> coherent_among_blocks(const Transforms& transforms, const LineValues& x,
                                        const LineValues& y) {
  std::vector<bool> coherent;
  for (const Block& block : blocks_of(transforms, x, y, kHighestShare)) {
    coherent.push_back(block.coherence() >= kLeastCoherence);
  }
  return coherent;
}

LowFrequencyFit fit_low_frequencies(const Transforms& transforms, Quantity x, Quantity y,
                                    double to_Hz) {
  // The window tells half a line from the mean.
  const auto first = static_cast<std::size_t>(std::ceil(0.5 * transforms.bins_per_line));
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  double variance = 0.0;
  for (std::size_t bin = first; bin <= transforms.bin_at(to_Hz); ++bin) {
    const auto a = transforms.derivative(x.signal, x.order, bin);
    const auto b = transforms.derivative(y.signal, y.order, bin);
    const double noise_a = transforms.noise_power(x.signal, x.order, bin);
    const double noise_b = transforms.noise_power(y.signal, y.order, bin);
    xx += std::norm(a);
    yy += std::norm(b);
    xy += (a * std::conj(b)).real();
    variance += 0.5 * (std::norm(a) * noise_b + std::norm(b) * noise_a + noise_a * noise_b);
  }
  // Padded bins are not independent.
  variance *= transforms.bins_per_line;
  LowFrequencyFit fit;
  if (variance > 0.0) fit.score = xy / std::sqrt(variance);
  if (xx > 0.0 && yy > 0.0) fit.correlation = xy / std::sqrt(xx * yy);
  if (yy > 0.0) fit.gain = xy / yy;
  return fit;
}

double mean_coherence(const Transforms& transforms, Quantity x, Quantity y) {
  double sum = 0.0;
  double power = 0.0;
  const auto related =
      blocks_of(transforms, values_of(transforms, x), values_of(transforms, y), 0.5);
  const auto plain = values_of(transforms, {x.signal, 0});
  const auto own = blocks_of(transforms, plain, plain, 0.5);
  for (std::size_t i = 0; i < related.size(); ++i) {
    sum += related[i].coherence() * own[i].xx;
    power += own[i].xx;
  }
  return power > 0.0 ? sum / power : 0.0;
}

std::size_t coherent_blocks(const Transforms& transforms, Quantity x, Quantity y) {
  const auto blocks =
      blocks_of(transforms, values_of(transforms, x), values_of(transforms, y), 0.5);
  return static_cast<std::size_t>(std::ranges::count_if(
      blocks, [](const Block& block) { return block.coherence() >= kLeastCoherence; }));
}

}  // namespace flexarm::measured
