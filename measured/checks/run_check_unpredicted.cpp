#include "measured/checks/run_check_unpredicted.hpp"

#include "measured/checks/data_check_prediction.hpp"
#include "measured/spectra/robust.hpp"
#include "measured/spectra/spectra.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

namespace flexarm::measured {

namespace {

/// Samples on either side: of the channel, and of the torque and the other channels.
struct Around {
  int own;
  int others;
};
constexpr Around kPredictors[] = {{3, 2}, {6, 4}, {12, 7}};
/// Samples a regressor, or too much is fitted.
constexpr Eigen::Index kSamplesARegressor = 8;

constexpr std::size_t kSegment = 128;
/// Lines 1 to 63 of a segment's spectrum, seven a band.
constexpr std::size_t kBands = 9;
constexpr std::size_t kBandLines = 7;
/// The strongest band of white noise over the weakest, as deviations, in a record of n samples:
/// kMostUnevenBands exp(kScatter/sqrt(n)). In a long record it is not 1, since the noise of the
/// other channels comes in with the prediction.
constexpr double kMostUnevenBands = 1.2;
constexpr double kScatter = 7.5;
/// Of white noise, what a prediction from more samples leaves of the residual.
constexpr double kLeastLeft = 0.9;
/// Root mean square of normal noise over its robust deviation in a record of n samples:
/// kMostBursts + kBurstScatter/sqrt(n). Friction that reverses has bursts.
constexpr double kMostBursts = 1.03;
constexpr double kBurstScatter = 1.5;

struct Residual {
  double deviation = 0.0;  ///< as the noise of one sample
  double bursts = 0.0;     ///< root mean square over robust deviation
  double lowest = 0.0;     ///< the same of the bands of its spectrum
  double highest = 0.0;
};

/// The share that a sample `lag` later has in the prediction of its own channel.
struct OwnShare {
  int lag = 0;
  double share = 0.0;
};

/// Standard deviations of the white noise that leaves this much of the spectrum in each band:
/// residual over |1 - S(omega)|.
std::array<double, kBands> band_deviations(std::span<const double> left,
                                           const std::vector<OwnShare>& own) {
  SegmentPlan plan{kSegment, kSegment / 2};
  plan.detrend = Detrend::none;
  const auto spectrum = cross_spectra({left}, {}, 1.0, plan).input;  // of variance 1: 2 a line
  std::array<double, kBands> deviations{};
  for (std::size_t band = 0; band < kBands; ++band) {
    double power = 0.0;
    double passed = 0.0;
    for (std::size_t k = 1 + band * kBandLines; k < 1 + (band + 1) * kBandLines; ++k) {
      const double angle = 2.0 * std::numbers::pi * static_cast<double>(k) / kSegment;
      std::complex<double> filter = 1.0;
      for (const auto& [lag, share] : own) filter -= share * std::polar(1.0, angle * lag);
      power += spectrum[k] / 2.0;
      passed += std::norm(filter);
    }
    deviations[band] = std::sqrt(power / passed);
  }
  return deviations;
}

/// Empty: the record is too short for so many regressors.
std::optional<Residual> residual_of(const std::vector<Eigen::VectorXd>& values, std::size_t self,
                                    const std::vector<bool>& usable, const Around& around) {
  const auto regressors =
      regressors_around(self, usable, {around.own, around.others, around.others});
  const Eigen::Index rows = values[self].size() - 2 * around.own;
  const auto columns = static_cast<Eigen::Index>(regressors.size());
  if (rows < kSamplesARegressor * columns) return std::nullopt;
  const Regression made = regress(values, self, regressors, around.own, rows);
  // The noise of the channel's own neighbours is in the residual with their shares.
  std::vector<OwnShare> own;
  double power = 1.0;
  for (std::size_t j = 0; j < regressors.size(); ++j) {
    if (regressors[j].signal != self) continue;
    const double share = made.shares[static_cast<Eigen::Index>(j)];
    own.push_back({regressors[j].lag, share});
    power += share * share;
  }
  // A fit takes its part of the noise.
  const double kept = std::sqrt(1.0 - static_cast<double>(columns) / static_cast<double>(rows));
  const std::span<const double> left(made.left.data(), static_cast<std::size_t>(rows));
  const auto bands = band_deviations(left, own);
  const auto [lowest, highest] = std::ranges::minmax(bands);
  const double deviation = robust_deviation(left);
  const double rms = std::sqrt(made.left.squaredNorm() / static_cast<double>(rows));
  return Residual{deviation / (kept * std::sqrt(power)), rms / deviation, lowest / kept,
                  highest / kept};
}

}  // namespace

UnpredictedNoise unpredicted_noise(const std::vector<Eigen::VectorXd>& values, std::size_t self,
                                   const std::vector<bool>& usable) {
  UnpredictedNoise noise{std::numeric_limits<double>::infinity(), 0.0};
  const double root = std::sqrt(static_cast<double>(values[self].size()));
  const double even = kMostUnevenBands * std::exp(kScatter / root);
  const double bursts = kMostBursts + kBurstScatter / root;
  double before = 0.0;
  for (const Around& around : kPredictors) {
    const auto made = residual_of(values, self, usable, around);
    if (!made) break;
    noise.most = std::min(noise.most, made->deviation);
    // Of the prediction from most samples.
    const bool is_noise = made->highest < even * made->lowest && made->bursts < bursts &&
                          made->deviation > kLeastLeft * before;
    noise.certain = is_noise ? std::min(made->deviation, made->lowest) : 0.0;
    before = made->deviation;
  }
  return noise;
}

}  // namespace flexarm::measured
