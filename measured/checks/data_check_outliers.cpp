#include "measured/checks/data_check_outliers.hpp"

#include "measured/spectra/robust.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace flexarm::measured {

namespace {

constexpr int kOwnReach = 3;     // samples
constexpr int kTorqueReach = 2;  // samples
constexpr int kOtherReach = 1;   // samples
constexpr std::size_t kAround = 12;
constexpr double kAlone = 0.4;
constexpr int kMostPasses = 6;
/// Where more of the samples stand out, the residual is no noise with a few outliers.
constexpr double kMostSpikes = 0.01;
/// Keeps the normal equations solvable where columns are alike; far below any noise.
constexpr double kRidge = 1e-12;

struct Lagged {
  std::size_t signal = 0;
  int lag = 0;
};

struct Outlier {
  std::size_t signal = 0;
  std::size_t sample = 0;
  double size = 0.0;   ///< reading less prediction
  double score = 0.0;  ///< over the residual's robust deviation
};

std::vector<Lagged> regressors_of(std::size_t self, const std::vector<bool>& usable) {
  std::vector<Lagged> regressors;
  for (std::size_t i = 0; i < usable.size(); ++i) {
    if (!usable[i]) continue;
    const int reach = i == self ? kOwnReach : (i == 0 ? kTorqueReach : kOtherReach);
    for (int lag = -reach; lag <= reach; ++lag) {
      if (i != self || lag != 0) regressors.push_back({i, lag});
    }
  }
  return regressors;
}

/// Reading less prediction for samples [kOwnReach, count - kOwnReach), and the share in the
/// prediction of each of the channel's own samples, by its lag + kOwnReach.
struct Prediction {
  std::vector<double> left;
  std::array<double, 2 * kOwnReach + 1> own{};
};

Prediction predict(const std::vector<Eigen::VectorXd>& values, std::size_t self,
                   const std::vector<bool>& usable) {
  const auto regressors = regressors_of(self, usable);
  const Eigen::Index rows = values[0].size() - 2 * kOwnReach;
  const auto columns = static_cast<Eigen::Index>(regressors.size());
  Eigen::MatrixXd matrix(rows, columns);
  for (Eigen::Index j = 0; j < columns; ++j) {
    const auto& [signal, lag] = regressors[static_cast<std::size_t>(j)];
    matrix.col(j) = values[signal].segment(kOwnReach + lag, rows);
  }
  const Eigen::VectorXd target = values[self].segment(kOwnReach, rows);
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(columns, columns);
  normal.selfadjointView<Eigen::Lower>().rankUpdate(matrix.transpose());
  normal.diagonal().array() += kRidge * normal.diagonal().maxCoeff();
  const Eigen::VectorXd solution =
      normal.selfadjointView<Eigen::Lower>().ldlt().solve(matrix.transpose() * target);
  const Eigen::VectorXd left = target - matrix * solution;
  Prediction prediction;
  prediction.left.assign(left.data(), left.data() + left.size());
  for (std::size_t j = 0; j < regressors.size(); ++j) {
    if (regressors[j].signal != self) continue;
    prediction.own[static_cast<std::size_t>(regressors[j].lag + kOwnReach)] =
        solution[static_cast<Eigen::Index>(j)];
  }
  return prediction;
}

/// Whether sample `at` stands alone: with the spike taken out of the predictions that it entered,
/// nothing within kAround samples is kAlone of its size. What follows a jump is not alone.
bool is_alone(const Prediction& prediction, std::size_t at) {
  const double size = prediction.left[at];
  const std::size_t from = at > kAround ? at - kAround : 0;
  const std::size_t to = std::min(prediction.left.size(), at + kAround + 1);
  for (std::size_t k = from; k < to; ++k) {
    if (k == at) continue;
    double left = prediction.left[k];
    const auto lag = static_cast<std::ptrdiff_t>(at) - static_cast<std::ptrdiff_t>(k);
    if (std::abs(lag) <= kOwnReach) {
      left += prediction.own[static_cast<std::size_t>(lag + kOwnReach)] * size;
    }
    if (std::abs(left) > kAlone * std::abs(size)) return false;
  }
  return true;
}

/// Samples that a jump of the torque shakes: it changes by half its standard deviation and by eight
/// times its median change, as in a series of pulses.
std::vector<bool> shaken_samples(const Eigen::VectorXd& torque) {
  constexpr double kJump = 0.5;
  constexpr double kUnusual = 8.0;
  const Eigen::Index samples = torque.size();
  const Eigen::VectorXd change = (torque.tail(samples - 1) - torque.head(samples - 1)).cwiseAbs();
  const double usual = median({change.data(), change.data() + change.size()});
  std::vector<bool> shaken(static_cast<std::size_t>(samples), false);
  const auto shake = [&](Eigen::Index from) {
    const Eigen::Index to = std::min(samples, from + static_cast<Eigen::Index>(kAround));
    for (Eigen::Index k = std::max<Eigen::Index>(0, from - 1); k < to; ++k) {
      shaken[static_cast<std::size_t>(k)] = true;
    }
  };
  for (Eigen::Index k = 0; k < change.size(); ++k) {
    if (change[k] > std::max(kJump, kUnusual * usual)) shake(k + 1);
  }
  shake(0);  // the record may begin with a jump
  return shaken;
}

std::vector<Outlier> outliers_of(const std::vector<Eigen::VectorXd>& values,
                                 const std::vector<bool>& usable, const DataCheckOptions& options) {
  std::vector<Outlier> all;
  // A torque that is not known may jump anywhere.
  const auto shaken = usable[0]
                          ? shaken_samples(values[0])
                          : std::vector<bool>(static_cast<std::size_t>(values[0].size()), true);
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (!usable[i]) continue;
    const Prediction prediction = predict(values, i, usable);
    const double scale = robust_deviation(prediction.left);
    // Values are in standard deviations of their channel.
    const double least = std::max(options.least_spike, options.spike_deviations * scale);
    for (std::size_t k = 0; k < prediction.left.size(); ++k) {
      const double left = prediction.left[k];
      if (std::abs(left) <= least || !is_alone(prediction, k)) continue;
      if (shaken[k + kOwnReach] && std::abs(left) <= options.least_shaken_spike) continue;
      all.push_back({i, k + kOwnReach, left, std::abs(left) / std::max(scale, 1e-12)});
    }
  }
  std::ranges::sort(all, std::ranges::greater(), &Outlier::score);
  return all;
}

/// The worst of each neighbourhood; the others may be its echoes in the predictions around it.
std::vector<Outlier> leaders(const std::vector<Outlier>& all) {
  std::vector<Outlier> chosen;
  std::set<std::size_t> taken;
  for (const auto& outlier : all) {
    const auto near =
        taken.lower_bound(outlier.sample > kOwnReach ? outlier.sample - kOwnReach : 0);
    if (near != taken.end() && *near <= outlier.sample + kOwnReach) continue;
    taken.insert(outlier.sample);
    chosen.push_back(outlier);
  }
  return chosen;
}

DataFinding finding_of(const CheckedSignal& signal, const std::vector<Outlier>& outliers) {
  const auto first = std::ranges::min_element(outliers, {}, &Outlier::sample);
  const auto largest = std::ranges::max_element(
      outliers, {}, [](const Outlier& outlier) { return std::abs(outlier.size); });
  return {Fault::spikes,
          signal.name,
          first->sample,
          0.0,
          largest->size * signal.deviation,
          fmt::format("{} has a spike of {:.4g} {} at sample {}{}", signal.name,
                      first->size * signal.deviation, arm::unit(*signal.sensor), first->sample + 1,
                      more_places(outliers.size()))};
}

}  // namespace

std::vector<DataFinding> check_spikes(std::span<const CheckedSignal> signals,
                                      const std::vector<bool>& usable,
                                      const DataCheckOptions& options) {
  const std::size_t samples = signals[0].values.size();
  std::vector<Eigen::VectorXd> values;
  for (const auto& signal : signals) {
    const auto map =
        Eigen::Map<const Eigen::VectorXd>(signal.values.data(), static_cast<Eigen::Index>(samples));
    const double scale = signal.deviation > 0.0 ? signal.deviation : 1.0;
    values.emplace_back((map.array() - mean(signal.values)) / scale);
  }
  std::vector<std::vector<Outlier>> found(signals.size());
  for (int pass = 0; pass < kMostPasses; ++pass) {
    const auto chosen = leaders(outliers_of(values, usable, options));
    if (chosen.empty()) break;
    for (const auto& outlier : chosen) {
      values[outlier.signal][static_cast<Eigen::Index>(outlier.sample)] -= outlier.size;
      found[outlier.signal].push_back(outlier);
    }
  }
  std::vector<DataFinding> findings;
  for (std::size_t i = 1; i < signals.size(); ++i) {
    const auto most = std::max(10.0, kMostSpikes * static_cast<double>(samples));
    if (found[i].empty() || static_cast<double>(found[i].size()) > most) continue;
    findings.push_back(finding_of(signals[i], found[i]));
  }
  return findings;
}

}  // namespace flexarm::measured
