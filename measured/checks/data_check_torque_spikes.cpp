#include "measured/checks/data_check_torque_spikes.hpp"

#include "measured/checks/data_check_prediction.hpp"
#include "measured/spectra/robust.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace flexarm::measured {

namespace {

using Eigen::Index;
using Values = std::vector<Eigen::VectorXd>;

constexpr int kTorqueSide = 8;      // samples of the torque that predict one of it
constexpr int kChannelSide = 2;     // samples of a channel
constexpr Index kNear = 12;         // samples in which a spike stands alone
constexpr double kNearShare = 0.4;  // of its size
constexpr double kReturn = 0.5;     // of its size, by which the torque goes and comes back
constexpr int kRounds = 6;
constexpr std::size_t kFewestTorqueSamples = 128;
constexpr double kMostPower = 0.9;  // of the torque, in its spikes
/// Squares of the channels' residuals, in variances, by which a torque that was given beats one
/// that was not. Shares of a smooth torque are uncertain and fit a spike by up to half of it.
constexpr double kAnswer = 60.0;
constexpr Index kAnswerSide = 3;

/// Residuals of the torque, zero for the first and last kTorqueSide samples, and the share of its
/// own samples in them by lag.
struct TorqueResidual {
  Eigen::VectorXd left;
  std::map<Index, double> share;

  /// With a spike taken out of the predictions that it entered.
  void take(Index at, double size) {
    left[at] -= size;
    for (const auto& [lag, part] : share) {
      const Index k = at - lag;
      if (k >= 0 && k < left.size()) left[k] += part * size;
    }
  }
};

TorqueResidual torque_residual(const Values& values, const std::vector<bool>& usable) {
  const auto regressors = regressors_around(0, usable, {kTorqueSide, 0, kChannelSide});
  const Index samples = values[0].size();
  const Regression made = regress(values, 0, regressors, kTorqueSide, samples - 2 * kTorqueSide);
  TorqueResidual residual{Eigen::VectorXd::Zero(samples), {}};
  residual.left.segment(kTorqueSide, made.left.size()) = made.left;
  for (std::size_t j = 0; j < regressors.size(); ++j) {
    if (regressors[j].signal == 0) {
      residual.share[regressors[j].lag] = made.shares[static_cast<Index>(j)];
    }
  }
  return residual;
}

bool comes_back(const Eigen::VectorXd& torque, Index at, double size) {
  const double least = kReturn * std::abs(size);
  const double sign = size > 0.0 ? 1.0 : -1.0;
  return sign * (torque[at] - torque[at - 1]) >= least &&
         sign * (torque[at] - torque[at + 1]) >= least;
}

/// Sizes of the spikes by sample. One after the other is taken out, the largest first; those stand
/// that then are alone.
std::map<Index, double> spikes_in(const Values& values, const std::vector<bool>& usable,
                                  const DataCheckOptions& options) {
  TorqueResidual residual = torque_residual(values, usable);
  const Index samples = residual.left.size();
  const double least =
      std::max(options.least_spike,
               options.spike_deviations *
                   robust_deviation({residual.left.data(), static_cast<std::size_t>(samples)}));
  const auto most = static_cast<std::size_t>(kMostLeftOut * static_cast<double>(samples));
  std::map<Index, double> sizes;
  while (sizes.size() <= most) {
    Index at = 0;
    if (residual.left.cwiseAbs().maxCoeff(&at) <= least || sizes.contains(at)) break;
    const double size = residual.left[at];
    sizes[at] = size;
    residual.take(at, size);
  }
  std::map<Index, double> alone;
  for (const auto& [at, size] : sizes) {
    const Index from = std::max<Index>(0, at - kNear);
    const Index to = std::min(samples, at + kNear + 1);
    const bool stands =
        residual.left.segment(from, to - from).cwiseAbs().maxCoeff() <= kNearShare * std::abs(size);
    if (stands && comes_back(values[0], at, size)) alone[at] = size;
  }
  return alone;
}

/// How much better, in variances, the channels around a sample are explained by the torque as it
/// was recorded than without the spike.
double answer_to(const Values& values, const std::vector<bool>& usable, Index at, double size) {
  double better = 0.0;
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (!usable[i]) continue;
    std::vector<Lagged> regressors;
    for (int lag = -kTorqueSide; lag <= kTorqueSide; ++lag) {
      if (lag != 0) regressors.push_back({i, lag});
    }
    const std::size_t own = regressors.size();
    for (int lag = -kChannelSide; lag <= kChannelSide; ++lag) regressors.push_back({0, lag});
    const Index rows = values[i].size() - 2 * kTorqueSide;
    const Regression made = regress(values, i, regressors, kTorqueSide, rows);
    const double noise =
        robust_deviation({made.left.data(), static_cast<std::size_t>(made.left.size())});
    if (noise <= 0.0) continue;
    for (Index k = at - kAnswerSide; k <= at + kAnswerSide; ++k) {
      const Index row = k - kTorqueSide;
      if (row < 0 || row >= rows) continue;
      const double with = made.left[row];
      double without = with;
      const Index lag = at - k;
      if (std::abs(lag) <= kChannelSide) {
        without += made.shares[static_cast<Index>(own) + lag + kChannelSide] * size;
      }
      better += (without * without - with * with) / (noise * noise);
    }
  }
  return better;
}

}  // namespace

std::vector<DataFinding> check_torque_spikes(std::span<const CheckedSignal> signals,
                                             const std::vector<bool>& usable,
                                             const DataCheckOptions& options) {
  const CheckedSignal& torque = signals[0];
  if (!usable[0] || torque.values.size() < kFewestTorqueSamples) return {};
  Values values = standardised(signals);
  const Eigen::VectorXd recorded = values[0];
  std::map<Index, double> found;
  for (int round = 0; round < kRounds; ++round) {
    const auto more = spikes_in(values, usable, options);
    if (more.empty()) break;
    for (const auto& [at, size] : more) {
      values[0][at] -= size;
      found[at] += size;
    }
  }
  if (found.empty()) return {};
  // The power of a torque that rests between its pulses is all in them.
  const double power_left = (values[0].array() - values[0].mean()).square().mean();
  if (power_left < 1.0 - kMostPower) return {};
  Values as_recorded = values;
  as_recorded[0] = recorded;
  std::erase_if(found, [&](const auto& spike) {
    return answer_to(as_recorded, usable, spike.first, spike.second) > kAnswer;
  });
  if (found.empty()) return {};

  DataFinding finding;
  finding.fault = Fault::spikes;
  finding.channel = torque.name;
  for (const auto& [at, size] : found) {
    const auto sample = static_cast<std::size_t>(at);
    const double size_N_m = size * torque.deviation;
    finding.predicted.push_back({sample, torque.values[sample] - size_N_m});
    if (std::abs(size_N_m) > std::abs(finding.value)) finding.value = size_N_m;
  }
  finding.first_sample = finding.predicted.front().sample;
  finding.text = fmt::format(
      "torque has a spike of {:.4g} N m at sample {}{}, without an answer of "
      "the arm",
      torque.values[finding.first_sample] - finding.predicted.front().value,
      finding.first_sample + 1, more_places(found.size()));
  return {finding};
}

}  // namespace flexarm::measured
