#include "measured/checks/data_check_sampling_jitter.hpp"

#include "measured/checks/data_check_prediction.hpp"
#include "measured/checks/data_check_shaking.hpp"
#include "measured/checks/data_check_values.hpp"
#include "measured/spectra/robust.hpp"

#include <Eigen/LU>
#include <Eigen/QR>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

namespace flexarm::measured {

namespace {

using Eigen::Index;

constexpr int kJitterReach = 4;  // samples of its own that predict one of a channel
constexpr int kOthersReach = 2;  // samples of the torque and the other channels
constexpr std::size_t kFewestRows = 200;
constexpr Index kShakenFor = 24;                  // samples after a jump of the torque
constexpr std::size_t kShakenByFrictionFor = 12;  // on either side of a stop of the hub
constexpr double kMostResidual = 4.0;             // robust deviations; as this in their covariance
constexpr double kMostSquare = 12.0;  // u over its expected value; larger ones are taken for this
constexpr double kSingular = 1e-3;    // of the mean variance, on the diagonal of the covariance
constexpr int kJitterReweightings = 8;
constexpr Index kTimeBlocks = 12;
constexpr double kLeastEvidenceInBlocks = 2.0;  // standard errors
constexpr double kLeastEvidenceInBlocksOfPulses = 1.5;
constexpr double kLeastShareInBlocks = 0.5;  // of the rms of the whole
constexpr double kLeastShareInBlocksAlone = 0.7;
constexpr double kLeastEvidence = 4.5;  // standard errors
constexpr double kAcross = 1.5;         // by which what grows across the derivatives counts
constexpr double kAcrossIfAlike = 1.0;
constexpr double kLeastRms_periods = 0.05;
constexpr double kLeastRmsBesidePulses_periods = 0.14;
constexpr double kLeastRmsAlone_periods = 0.12;  // of one channel
constexpr Index kGroups = 12;
/// Least typical rms over that by least squares: of one channel, of two, of more. The more
/// channels, the less else can look like jitter.
constexpr std::array<double, 3> kLeastTypical = {0.67, 0.6, 0.45};
/// More is no jitter: the largest residuals are those of small derivatives.
constexpr double kMostTypical = 1.2;
/// Beside pulses this rms is far above the least one: less evidence is enough.
constexpr double kLargeRmsBesidePulses_periods = 0.17;
constexpr double kLeastEvidenceOfLarge = 3.0;
/// Where groups of like g show the rms alike, residuals grow as those of jitter: less evidence is
/// enough, the motion's change over the record explains nothing, and of one channel a smaller rms
/// is believed.
constexpr double kLeastAlike = 0.83;
constexpr double kMostAlike = 1.1;
constexpr double kStrongEvidence = 8.0;
constexpr double kStrongEvidenceAlone = 6.5;
constexpr double kLeastRmsAloneIfAlike_periods = 0.09;
constexpr double kMedianOfChiSquare = 0.455;  // one degree of freedom

/// Samples that no jump of the torque shakes, nor one of friction, over
/// [kJitterReach, samples - kJitterReach).
std::vector<Index> calm_rows(std::span<const CheckedSignal> signals,
                             const std::vector<bool>& usable, const Eigen::VectorXd& torque) {
  const Index samples = torque.size();
  std::vector<bool> is_shaken =
      none_if_many(samples_near_stops(signals, usable, kShakenByFrictionFor));
  const auto shake = [&](Index from, Index to) {
    for (Index k = std::max<Index>(0, from); k < std::min(samples, to); ++k) {
      is_shaken[static_cast<std::size_t>(k)] = true;
    }
  };
  shake(0, kShakenFor);  // the record may begin with a jump
  if (usable[0]) {
    for (const Index k : torque_jumps(torque)) shake(k - kJitterReach + 1, k + 1 + kShakenFor);
  }
  std::vector<Index> rows;
  for (Index k = kJitterReach; k < samples - kJitterReach; ++k) {
    if (!is_shaken[static_cast<std::size_t>(k)]) rows.push_back(k - kJitterReach);
  }
  return rows;
}

Eigen::VectorXd residual_of(const std::vector<Eigen::VectorXd>& values, std::size_t self,
                            const std::vector<bool>& usable) {
  const auto regressors =
      regressors_around(self, usable, {kJitterReach, kOthersReach, kOthersReach, false});
  return regress(values, self, regressors, kJitterReach, values[0].size() - 2 * kJitterReach).left;
}

/// Of the sixth order, per sample.
Eigen::VectorXd derivative_of(const Eigen::VectorXd& x) {
  const Index rows = x.size() - 2 * kJitterReach;
  const auto apart = [&](Index lag) {
    return x.segment(kJitterReach + lag, rows) - x.segment(kJitterReach - lag, rows);
  };
  return 0.75 * apart(1) - 0.15 * apart(2) + apart(3) / 60.0;
}

/// Values less their weighted mean in each of some blocks of time.
Eigen::ArrayXd less_block_means(const Eigen::ArrayXd& values, const Eigen::ArrayXd& weight,
                                Index blocks) {
  Eigen::ArrayXd left = values;
  for (Index block = 0; block < blocks; ++block) {
    const Index from = block * values.size() / blocks;
    const Index count = (block + 1) * values.size() / blocks - from;
    const auto part = weight.segment(from, count);
    left.segment(from, count) -= (part * values.segment(from, count)).sum() / part.sum();
  }
  return left;
}

/// u = level + slope g with a level for each block of time, by least squares with weights
/// 1/(1 + slope g)^2. A u above kMostSquare times 1 + slope g is taken for this.
struct Growth {
  double slope = 0.0;
  double error = 0.0;

  double rms() const { return std::sqrt(std::max(0.0, slope)); }
};

/// The slope that the largest quarter of g asks for, if u/(1 + slope g) is chi square of one degree
/// of freedom: where the least squares begin.
double first_slope(const Eigen::ArrayXd& u, const Eigen::ArrayXd& g) {
  const double large = quantile({g.begin(), g.end()}, 0.75);
  std::vector<double> ratios;
  for (Index k = 0; k < g.size(); ++k) {
    if (g[k] > large) ratios.push_back(u[k] / g[k]);
  }
  return ratios.empty() ? 0.0 : median(std::move(ratios)) / kMedianOfChiSquare;
}

/// The rms that medians of u show over groups of like g: what a few samples do, as those where
/// friction holds the hub, has no influence.
double typical_rms(const Eigen::ArrayXd& u, const Eigen::ArrayXd& g) {
  std::vector<Index> order(static_cast<std::size_t>(g.size()));
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, [&](Index k) { return g[k]; });
  Eigen::Matrix<double, kGroups, 2> levels;
  for (Index i = 0; i < kGroups; ++i) {
    std::vector<double> here;
    std::vector<double> at;
    for (Index k = i * g.size() / kGroups; k < (i + 1) * g.size() / kGroups; ++k) {
      here.push_back(u[order[static_cast<std::size_t>(k)]]);
      at.push_back(g[order[static_cast<std::size_t>(k)]]);
    }
    // Errors of a median are in proportion to it.
    const double level = std::max(1e-300, median(std::move(here)) / kMedianOfChiSquare);
    levels.row(i) << 1.0 / level, median(std::move(at)) / level;
  }
  const Eigen::Vector2d fit =
      levels.colPivHouseholderQr().solve(Eigen::Vector<double, kGroups>::Ones());
  return std::sqrt(std::max(0.0, fit[1]));
}

Growth growth_of(const Eigen::ArrayXd& u, const Eigen::ArrayXd& g, Index blocks) {
  Growth growth;
  growth.slope = first_slope(u, g);
  for (int i = 0; i < kJitterReweightings; ++i) {
    const Eigen::ArrayXd expected = 1.0 + std::max(0.0, growth.slope) * g;
    const Eigen::ArrayXd weight = expected.square().inverse();
    const Eigen::ArrayXd across = less_block_means(g, weight, blocks);
    const Eigen::ArrayXd up = less_block_means(u.min(kMostSquare * expected), weight, blocks);
    const double power = (weight * across.square()).sum();
    growth.slope = (weight * across * up).sum() / power;
    growth.error = (weight * across * (up - growth.slope * across)).matrix().norm() / power;
  }
  return growth;
}

/// What the residuals of all channels say at each calm sample.
struct Scores {
  Eigen::ArrayXd u;     ///< squared residual along the derivatives, noise has a mean of 1
  Eigen::ArrayXd g;     ///< u grows by this times the mean square of the jitter [1/period^2]
  Eigen::ArrayXd rest;  ///< squared residual across the derivatives, a channel
  Index channels = 0;
};

/// Empty where there are too few samples or a channel leaves no residual.
std::optional<Scores> scores_of(std::span<const CheckedSignal> signals,
                                const std::vector<bool>& usable) {
  const auto values = standardised(signals);
  if (values[0].size() <= 2 * kJitterReach) return std::nullopt;
  const auto rows = calm_rows(signals, usable, values[0]);
  if (rows.size() < kFewestRows) return std::nullopt;
  Scores scores;
  scores.channels = std::count(usable.begin() + 1, usable.end(), true);
  if (scores.channels == 0) return std::nullopt;
  const auto channels = static_cast<double>(scores.channels);
  Eigen::MatrixXd residuals(scores.channels, std::ssize(rows));
  Eigen::MatrixXd derivatives(scores.channels, std::ssize(rows));
  Index row = 0;
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (!usable[i]) continue;
    const Eigen::VectorXd left = residual_of(values, i, usable)(rows);
    const double scale = robust_deviation({left.data(), static_cast<std::size_t>(left.size())});
    if (scale <= 0.0) return std::nullopt;
    residuals.row(row) = left / scale;
    derivatives.row(row) = derivative_of(values[i])(rows) / scale;
    ++row;
  }
  const Eigen::MatrixXd usual = residuals.cwiseMin(kMostResidual).cwiseMax(-kMostResidual);
  Eigen::MatrixXd covariance = usual * usual.transpose() / static_cast<double>(rows.size());
  covariance.diagonal().array() += kSingular * covariance.trace() / channels;
  const Eigen::MatrixXd inverse = covariance.inverse();
  const Eigen::MatrixXd seen = inverse * derivatives;
  scores.g = seen.cwiseProduct(derivatives).colwise().sum().transpose();
  const Eigen::ArrayXd along = seen.cwiseProduct(residuals).colwise().sum().transpose();
  scores.u = along.square() / scores.g.max(1e-300);
  if (scores.channels > 1) {
    const Eigen::MatrixXd whitened = inverse * residuals;
    const Eigen::ArrayXd all = whitened.cwiseProduct(residuals).colwise().sum().transpose();
    scores.rest = (all - scores.u) / (channels - 1.0);
  }
  return scores;
}

/// Rms of the jitter in periods; empty: there is none.
std::optional<double> jitter_rms(const Scores& scores, bool has_pulses) {
  const auto& [u, g, rest, channels] = scores;
  const Growth growth = growth_of(u, g, 1);
  const double rms = growth.rms();
  const double typical = typical_rms(u, g) / rms;
  const bool are_alike = typical > kLeastAlike && typical < kMostAlike;
  // Of jitter nothing grows across the derivatives, of an arm that the regression misses all does.
  const double beside = channels > 1 ? std::max(0.0, growth_of(rest, g, 1).slope) : 0.0;
  const double across = are_alike ? kAcrossIfAlike : kAcross;
  // Where g is constant the slope is not a number.
  const double evidence = (growth.slope - across * beside) / growth.error;
  const bool is_large = has_pulses && rms > kLargeRmsBesidePulses_periods;
  if (!(evidence > (is_large ? kLeastEvidenceOfLarge : kLeastEvidence))) return std::nullopt;
  double least_rms = has_pulses ? kLeastRmsBesidePulses_periods : kLeastRms_periods;
  if (channels == 1) {
    const bool is_sure = are_alike && evidence > kStrongEvidenceAlone;
    least_rms =
        std::max(least_rms, is_sure ? kLeastRmsAloneIfAlike_periods : kLeastRmsAlone_periods);
  }
  const double least_typical =
      kLeastTypical[static_cast<std::size_t>(std::min<Index>(channels, 3) - 1)];
  if (rms <= least_rms || typical < least_typical || typical > kMostTypical) return std::nullopt;
  if (channels > 1 && are_alike && evidence >= kStrongEvidence) return rms;
  // Noise may change with the motion over the record, as under a chirp.
  const Growth within = growth_of(u, g, kTimeBlocks);
  const double least_evidence =
      has_pulses ? kLeastEvidenceInBlocksOfPulses : kLeastEvidenceInBlocks;
  const double least_share = channels == 1 ? kLeastShareInBlocksAlone : kLeastShareInBlocks;
  const bool stays =
      within.slope > least_evidence * within.error && within.rms() >= least_share * rms;
  return stays ? std::optional(rms) : std::nullopt;
}

}  // namespace

std::vector<DataFinding> check_sampling_jitter(std::span<const CheckedSignal> signals,
                                               const std::vector<bool>& usable, double period_s) {
  const auto scores = scores_of(signals, usable);
  if (!scores) return {};
  const auto rms = jitter_rms(*scores, has_few_levels(signals[0].values));
  if (!rms) return {};
  return {
      {Fault::sampling_jitter, "time", 0, 0.0, *rms * period_s,
       fmt::format("sampling instants jitter by about {:.2g} of the period (rms {:.2g} s) while "
                   "the times are even: errors grow with the rate of change of all channels",
                   *rms, *rms * period_s)}};
}

}  // namespace flexarm::measured
