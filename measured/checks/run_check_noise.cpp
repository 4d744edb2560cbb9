#include "measured/checks/run_check_noise.hpp"

#include "measured/checks/data_check_prediction.hpp"
#include "measured/checks/run_check_signals.hpp"
#include "measured/checks/run_check_unpredicted.hpp"
#include "measured/spectra/robust.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace flexarm::measured {

namespace {

constexpr std::size_t kFewestNoiseSamples = 256;
constexpr std::size_t kMostNoiseSamples = 16384;
/// Bands of the upper half of the spectrum. The strongest may have a resonance; of the others the
/// strongest is at most this many times the weakest in power.
constexpr std::size_t kUpperBands = 4;
constexpr double kMostUneven = 2.0;
/// Of white noise the spectrum's level over what the prediction leaves.
constexpr double kLeastWhite = 0.8;
constexpr double kMostWhite = 1.1;
/// What counts as noise: standard deviations of the channel.
constexpr double kLeastNoise = 0.003;
constexpr double kTimes = 2.5;
/// Sampling frequencies of runs whose noise is compared: a slower reading may be a mean.
constexpr double kMostRateRatio = 1.5;

/// Standard deviation of a channel's noise in a run, in the channel's unit.
struct ChannelNoise {
  std::size_t run = 0;
  arm::Sensor sensor;
  double period_s = 0.0;
  double deviation = 0.0;  ///< of the channel
  double most = 0.0;       ///< an upper bound
  double certain = 0.0;    ///< of what is noise for certain; 0: none is
};

/// Standard deviation of what is white in the upper half of the spectrum; empty: it is not white.
std::optional<double> white_upper_half(const Transform& transform, double window_power) {
  const std::size_t half = transform.plain.size() / 2;
  std::array<double, kUpperBands> power{};
  for (std::size_t band = 0; band < kUpperBands; ++band) {
    const std::size_t from = half + band * half / kUpperBands;
    const std::size_t to = half + (band + 1) * half / kUpperBands;
    for (std::size_t k = from; k < to; ++k) power[band] += std::norm(transform.plain[k]);
    power[band] /= static_cast<double>(to - from) * window_power;
  }
  std::ranges::sort(power);
  if (power[kUpperBands - 2] > kMostUneven * power[0]) return std::nullopt;
  double sum = 0.0;
  for (std::size_t band = 0; band + 1 < kUpperBands; ++band) sum += power[band];
  return std::sqrt(sum / static_cast<double>(kUpperBands - 1));
}

using NoiseOfChannels = std::map<std::string, std::vector<ChannelNoise>>;

/// Adds what a run says of its channels.
void add_noise_of(std::size_t index, const CheckedRun& run, NoiseOfChannels& noise) {
  if (run.record->time_s.size() < kFewestNoiseSamples || has_finding(run, "time")) return;
  const auto [signals, usable, transforms] = signals_of(run, kMostNoiseSamples);
  const auto values = standardised(signals);
  for (std::size_t i = 1; i < signals.size(); ++i) {
    if (!usable[i]) continue;
    const double unit = signals[i].deviation;
    const auto unpredicted = unpredicted_noise(values, i, usable);
    const double left = unit * unpredicted.most;
    double certain = unit * unpredicted.certain;
    const double white = white_upper_half(transforms.of[i], transforms.window_power).value_or(0.0);
    if (white > kLeastWhite * left && white < kMostWhite * left) {
      certain = std::max(certain, std::min(left, white));
    }
    if (certain <= kLeastNoise * unit) certain = 0.0;
    noise[signals[i].name].push_back({index, *signals[i].sensor, transforms.period_s, unit,
                                      std::min(left, std::sqrt(transforms.of[i].floor_power)),
                                      certain});
  }
}

bool are_comparable(const ChannelNoise& a, const ChannelNoise& b) {
  return std::max(a.period_s / b.period_s, b.period_s / a.period_s) < kMostRateRatio;
}

/// An upper bound of the noise that half of the other runs lead to expect; 0 without others.
double expected_noise(const ChannelNoise& own, const std::vector<ChannelNoise>& of_runs) {
  std::vector<double> bounds;
  for (const auto& other : of_runs) {
    if (other.run == own.run || !are_comparable(own, other)) continue;
    // A wider range of the instrument has more noise.
    bounds.push_back(std::max(1.0, own.deviation / other.deviation) * other.most);
  }
  if (bounds.empty()) return 0.0;
  std::ranges::sort(bounds);
  return bounds[(bounds.size() - 1) / 2];
}

}  // namespace

std::vector<RunFinding> check_noise_between_runs(const std::vector<CheckedRun>& runs) {
  if (runs.size() < 2) return {};
  NoiseOfChannels noise;
  for (std::size_t i = 0; i < runs.size(); ++i) add_noise_of(i, runs[i], noise);
  std::vector<RunFinding> findings;
  for (const auto& [channel, of_runs] : noise) {
    std::vector<RunFinding> noisy;
    for (const auto& own : of_runs) {
      const double expected = expected_noise(own, of_runs);
      if (expected == 0.0 || own.certain <= kTimes * expected) continue;
      noisy.push_back(
          {own.run,
           {Fault::uneven_noise, channel, 0, runs[own.run].record->time_s.front(), own.certain,
            fmt::format(
                "{} has noise of {:.2g} {} rms, {:.2g} times what the other runs lead to expect",
                channel, own.certain, arm::unit(own.sensor), own.certain / expected)}});
    }
    // Where most are noisy, the quiet run is the odd one.
    if (2 * noisy.size() <= of_runs.size()) std::ranges::move(noisy, std::back_inserter(findings));
  }
  return findings;
}

}  // namespace flexarm::measured
