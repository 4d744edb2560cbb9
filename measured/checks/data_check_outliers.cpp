#include "measured/checks/data_check_outliers.hpp"

#include "measured/checks/data_check_prediction.hpp"
#include "measured/checks/data_check_shaking.hpp"
#include "measured/spectra/robust.hpp"

#include <Eigen/Core>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <span>

namespace flexarm::measured {

namespace {

constexpr int kOwnReach = 3;     // samples
constexpr int kTorqueReach = 2;  // samples
constexpr int kOtherReach = 1;   // samples
constexpr std::size_t kAround = 12;
constexpr double kAlone = 0.4;
/// Two spikes account for much of what is around them: less may be left.
constexpr double kTwoNear = 0.2;
constexpr int kMostPasses = 6;
constexpr int kRepairRounds = 3;
/// A channel with so many spikes that stand alone has others that do not.
constexpr std::size_t kMany = 5;
constexpr int kDensePasses = 12;

struct Outlier {
  std::size_t signal = 0;
  std::size_t sample = 0;
  double size = 0.0;   ///< reading less prediction
  double score = 0.0;  ///< over the residual's robust deviation
};

/// Reading less prediction for samples [kOwnReach, count - kOwnReach), and the share in the
/// prediction of each of the channel's own samples, by its lag + kOwnReach.
struct Prediction {
  std::vector<double> left;
  std::array<double, 2 * kOwnReach + 1> own{};
};

Prediction predict(const std::vector<Eigen::VectorXd>& values, std::size_t self,
                   const std::vector<bool>& usable) {
  const auto regressors = regressors_around(self, usable, {kOwnReach, kTorqueReach, kOtherReach});
  const Regression made =
      regress(values, self, regressors, kOwnReach, values[0].size() - 2 * kOwnReach);
  Prediction prediction{{made.left.begin(), made.left.end()}};
  for (std::size_t j = 0; j < regressors.size(); ++j) {
    if (regressors[j].signal != self) continue;
    prediction.own[static_cast<std::size_t>(regressors[j].lag + kOwnReach)] =
        made.shares[static_cast<Eigen::Index>(j)];
  }
  return prediction;
}

/// Reading less prediction from what comes after, for all samples but the last 2 kOwnReach.
std::vector<double> left_by_later(const std::vector<Eigen::VectorXd>& values, std::size_t self,
                                  const std::vector<bool>& usable) {
  std::vector<Lagged> regressors;
  for (std::size_t i = 0; i < usable.size(); ++i) {
    if (!usable[i]) continue;
    const int reach = i == self ? 2 * kOwnReach : (i == 0 ? kTorqueReach : kOtherReach);
    for (int lag = i == self ? 1 : 0; lag <= reach; ++lag) regressors.push_back({i, lag});
  }
  const Regression made = regress(values, self, regressors, 0, values[0].size() - 2 * kOwnReach);
  return {made.left.begin(), made.left.end()};
}

/// One or two spikes with their sizes.
struct Spikes {
  std::array<std::size_t, 2> samples{};
  std::array<double, 2> sizes{};
  std::size_t count = 1;
};

/// The share of the sample `lag` later in the prediction of one.
double share(const Prediction& prediction, std::ptrdiff_t lag) {
  return std::abs(lag) > kOwnReach ? 0.0
                                   : prediction.own[static_cast<std::size_t>(lag + kOwnReach)];
}

std::ptrdiff_t lag_between(std::size_t from, std::size_t to) {
  return static_cast<std::ptrdiff_t>(to) - static_cast<std::ptrdiff_t>(from);
}

/// Two spikes enter the predictions of each other: left_a = size_a - share(b - a) size_b. Empty
/// where they cannot be separated.
std::optional<Spikes> two_spikes(const Prediction& prediction, std::size_t a, std::size_t b) {
  constexpr double kSeparable = 0.1;
  const double of_b = share(prediction, lag_between(a, b));
  const double of_a = share(prediction, lag_between(b, a));
  const double determinant = 1.0 - of_a * of_b;
  if (determinant < kSeparable) return std::nullopt;
  return Spikes{{a, b},
                {(prediction.left[a] + of_b * prediction.left[b]) / determinant,
                 (prediction.left[b] + of_a * prediction.left[a]) / determinant},
                2};
}

/// The largest residual within kAround samples of `at` with these spikes taken out of the
/// predictions that they entered, over the size of the smaller spike.
double left_beside(const Prediction& prediction, std::size_t at, const Spikes& spikes) {
  const std::size_t from = at > kAround ? at - kAround : 0;
  const std::size_t to = std::min(prediction.left.size(), at + kAround + 1);
  const auto own = std::span(spikes.samples).first(spikes.count);
  double largest = 0.0;
  for (std::size_t k = from; k < to; ++k) {
    if (std::ranges::find(own, k) != own.end()) continue;
    double left = prediction.left[k];
    for (std::size_t i = 0; i < spikes.count; ++i) {
      left += share(prediction, lag_between(k, spikes.samples[i])) * spikes.sizes[i];
    }
    largest = std::max(largest, std::abs(left));
  }
  double smaller = std::abs(spikes.sizes[0]);
  if (spikes.count == 2) smaller = std::min(smaller, std::abs(spikes.sizes[1]));
  return smaller > 0.0 ? largest / smaller : std::numeric_limits<double>::infinity();
}

/// The size of a spike at `at` if it stands alone, or with one other: nothing else within kAround
/// samples is kAlone of the smaller. What follows a jump is not alone, and may pass for two spikes
/// that are near, in the predictions of each other: these are none if the torque shakes them. Of
/// near ones those are taken that leave least.
std::optional<double> size_of_spike(const Prediction& prediction, std::size_t at, bool is_shaken) {
  const double alone = prediction.left[at];
  if (left_beside(prediction, at, {{at}, {alone}}) <= kAlone) return alone;
  const std::size_t from = at > kAround ? at - kAround : 0;
  const std::size_t to = std::min(prediction.left.size(), at + kAround + 1);
  std::optional<Spikes> best;
  double least = kAlone;
  for (std::size_t a = from; a < to; ++a) {
    for (std::size_t b = a + 1; b < to; ++b) {
      const bool is_here = a == at || b == at;
      const bool is_near = b - a <= kOwnReach && std::abs(lag_between(at, a)) <= kOwnReach &&
                           std::abs(lag_between(at, b)) <= kOwnReach;
      if (!is_here && !is_near) continue;
      if (is_shaken && b - a <= kOwnReach) continue;
      const auto spikes = two_spikes(prediction, a, b);
      if (!spikes) continue;
      const double left = left_beside(prediction, at, *spikes);
      if (left > (b - a <= kOwnReach ? std::min(least, kTwoNear) : least)) continue;
      least = left;
      best = spikes;
    }
  }
  if (!best) return std::nullopt;
  for (std::size_t i = 0; i < 2; ++i) {
    if (best->samples[i] == at) return best->sizes[i];
  }
  return std::nullopt;
}

/// What jumps of the torque, and of friction, do to the residuals.
struct Shaking {
  std::vector<bool> samples;  ///< shaken by the torque
  std::vector<bool> stops;    ///< shaken by friction
  std::vector<double> least;  ///< size of a spike there, by signal
  std::vector<double> least_elsewhere;

  /// A hub that a jump of the torque starts or stops is shaken by both.
  double least_at(std::size_t signal, std::size_t sample) const {
    constexpr double kBoth = 2.0;
    if (samples[sample] && stops[sample]) return kBoth * least[signal];
    return samples[sample] || stops[sample] ? least[signal] : least_elsewhere[signal];
  }
};

/// Samples that a jump of the torque shakes. One that is not known may jump anywhere.
std::vector<bool> shaken_samples(const Eigen::VectorXd& torque, bool torque_is_known) {
  const auto samples = static_cast<std::size_t>(torque.size());
  std::vector<bool> shaken(samples, !torque_is_known);
  if (!torque_is_known) return shaken;
  const auto shake = [&](std::size_t from) {
    for (std::size_t k = from; k < std::min(samples, from + kAround + 1); ++k) shaken[k] = true;
  };
  for (const Eigen::Index k : torque_jumps(torque)) shake(static_cast<std::size_t>(k));
  shake(0);  // the record may begin with a jump
  return shaken;
}

/// Repairs the spikes among the first kOwnReach samples, which have few neighbours before them, and
/// puts them into `found`. They stand alone if no residual of the kAround samples behind is kAlone
/// of their size. `starts`: so many samples of a signal are the start from rest, which nothing
/// before them predicts.
void repair_begin(std::vector<Eigen::VectorXd>& values, const std::vector<bool>& usable,
                  const std::vector<std::size_t>& starts, const Shaking& shaking,
                  const DataCheckOptions& options, std::vector<std::set<std::size_t>>& found) {
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (!usable[i]) continue;
    for (std::size_t k = kOwnReach; k-- > starts[i];) {
      const std::vector<double> left = left_by_later(values, i, usable);
      const double size = std::abs(left[k]);
      const double least =
          std::max({options.least_spike, options.spike_deviations * robust_deviation(left),
                    shaking.least_at(i, k)});
      const bool is_alone =
          std::ranges::all_of(std::span(left).subspan(k + 1, kAround),
                              [size](double beside) { return std::abs(beside) <= kAlone * size; });
      if (size <= least || !is_alone) continue;
      values[i][static_cast<Eigen::Index>(k)] -= left[k];
      found[i].insert(k);
    }
  }
}

/// As `repair_begin` at both ends; the end is the begin of the reversed record.
void repair_ends(std::vector<Eigen::VectorXd>& values, const std::vector<bool>& usable,
                 const std::vector<std::size_t>& starts, Shaking shaking,
                 const DataCheckOptions& options, std::vector<std::set<std::size_t>>& found) {
  const auto reverse = [&] {
    for (auto& signal : values) signal.reverseInPlace();
    std::reverse(shaking.samples.begin(), shaking.samples.end());
    std::reverse(shaking.stops.begin(), shaking.stops.end());
  };
  repair_begin(values, usable, starts, shaking, options, found);
  reverse();
  std::vector<std::set<std::size_t>> at_end(found.size());
  repair_begin(values, usable, std::vector<std::size_t>(found.size(), 0), shaking, options, at_end);
  reverse();
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (const std::size_t k : at_end[i]) found[i].insert(shaking.samples.size() - 1 - k);
  }
}

std::vector<Outlier> outliers_of(const std::vector<Eigen::VectorXd>& values,
                                 const std::vector<bool>& usable, const Shaking& shaking,
                                 const DataCheckOptions& options) {
  std::vector<Outlier> all;
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (!usable[i]) continue;
    const Prediction prediction = predict(values, i, usable);
    const double scale = robust_deviation(prediction.left);
    // Values are in standard deviations of their channel.
    const double least = std::max(options.least_spike, options.spike_deviations * scale);
    for (std::size_t k = 0; k < prediction.left.size(); ++k) {
      if (std::abs(prediction.left[k]) <= least) continue;
      const auto size = size_of_spike(prediction, k, shaking.samples[k + kOwnReach]);
      if (!size || std::abs(*size) <= least) continue;
      if (std::abs(*size) <= shaking.least_at(i, k + kOwnReach)) continue;
      all.push_back({i, k + kOwnReach, *size, std::abs(*size) / std::max(scale, 1e-12)});
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

/// Of a channel that is known to have many spikes: every sample that deviates most within kOwnReach
/// of it, whatever else is near.
std::vector<Outlier> dense_outliers_of(const std::vector<Eigen::VectorXd>& values,
                                       std::size_t signal, const std::vector<bool>& usable,
                                       const DataCheckOptions& options) {
  const Prediction prediction = predict(values, signal, usable);
  const double scale = robust_deviation(prediction.left);
  const double least = std::max(options.least_spike, options.spike_deviations * scale);
  std::vector<Outlier> all;
  for (std::size_t k = 0; k < prediction.left.size(); ++k) {
    const double size = std::abs(prediction.left[k]);
    if (size <= least) continue;
    all.push_back({signal, k + kOwnReach, prediction.left[k], size});
  }
  std::ranges::sort(all, std::ranges::greater(), &Outlier::score);
  return leaders(all);
}

/// Sets each of these samples to its prediction. The others help to predict it: a few rounds.
void repair(std::vector<Eigen::VectorXd>& values, const std::vector<std::set<std::size_t>>& spikes,
            const std::vector<bool>& usable) {
  for (int round = 0; round < kRepairRounds; ++round) {
    for (std::size_t i = 1; i < values.size(); ++i) {
      if (spikes[i].empty()) continue;
      const Prediction prediction = predict(values, i, usable);
      for (const std::size_t sample : spikes[i]) {
        if (sample < kOwnReach || sample - kOwnReach >= prediction.left.size()) continue;
        values[i][static_cast<Eigen::Index>(sample)] -= prediction.left[sample - kOwnReach];
      }
    }
  }
}

DataFinding finding_of(const CheckedSignal& signal, const std::set<std::size_t>& spikes,
                       const Eigen::VectorXd& repaired) {
  DataFinding finding;
  finding.fault = Fault::spikes;
  finding.channel = signal.name;
  const double offset = mean(signal.values);
  const auto size = [&](const PredictedReading& one) {
    return signal.values[one.sample] - one.value;
  };
  for (const std::size_t sample : spikes) {
    const double value = repaired[static_cast<Eigen::Index>(sample)] * signal.deviation + offset;
    finding.predicted.push_back({sample, value});
    const double size_here = size(finding.predicted.back());
    if (std::abs(size_here) > std::abs(finding.value)) finding.value = size_here;
  }
  const PredictedReading& first = finding.predicted.front();
  finding.first_sample = first.sample;
  finding.text =
      fmt::format("{} has a spike of {:.4g} {} at sample {}{}", signal.name, size(first),
                  arm::unit(*signal.sensor), first.sample + 1, more_places(spikes.size()));
  const double share =
      static_cast<double>(spikes.size()) / static_cast<double>(signal.values.size());
  if (share > kMostLeftOut) {
    finding.text += fmt::format(": {:.2g} % of its samples, too many to leave out", 100.0 * share);
  }
  return finding;
}

/// From rest: what tears the arm loose is predicted by nothing before it.
std::size_t samples_of_start(const CheckedSignal& signal, bool is_shaken_unseen) {
  constexpr double kNextToRest = 0.1;  // standard deviations
  if (is_shaken_unseen) return kOwnReach;
  return std::abs(signal.values[0]) < kNextToRest * signal.deviation ? 1 : 0;
}

}  // namespace

std::vector<DataFinding> check_spikes(std::span<const CheckedSignal> signals,
                                      const std::vector<bool>& usable,
                                      const DataCheckOptions& options, bool ends_are_sound) {
  std::vector<Eigen::VectorXd> values = standardised(signals);
  Shaking shaking{
      shaken_samples(values[0], usable[0]), samples_near_stops(signals, usable, kAround), {}, {}};
  const bool stops_are_known = hub_signal(signals, usable) != nullptr;
  std::vector<std::size_t> starts;
  for (const auto& signal : signals) {
    // An angle and a displacement do not jump.
    const bool is_smooth =
        signal.is(arm::SensorKind::hub_angle) || signal.is(arm::SensorKind::tip_displacement);
    const bool is_shaken_unseen = signal.is(arm::SensorKind::tip_acceleration) && !stops_are_known;
    const bool jumps = signal.is(arm::SensorKind::tip_acceleration) && usable[0];
    shaking.least.push_back(is_smooth ? 0.0 : (jumps ? 2.0 : 1.0) * options.least_shaken_spike);
    shaking.least_elsewhere.push_back(is_shaken_unseen ? options.least_unseen_stop_spike : 0.0);
    starts.push_back(options.starts_at_rest ? samples_of_start(signal, is_shaken_unseen) : 0);
  }
  std::vector<std::set<std::size_t>> found(signals.size());
  // At the ends many stops are not ignored: what is predicted from one side knows less.
  const Shaking at_ends = shaking;
  shaking.stops = none_if_many(shaking.stops);
  if (ends_are_sound) repair_ends(values, usable, starts, at_ends, options, found);
  const auto take = [&](const std::vector<Outlier>& chosen) {
    for (const auto& outlier : chosen) {
      values[outlier.signal][static_cast<Eigen::Index>(outlier.sample)] -= outlier.size;
      found[outlier.signal].insert(outlier.sample);
    }
  };
  for (int pass = 0; pass < kMostPasses; ++pass) {
    const auto chosen = leaders(outliers_of(values, usable, shaking, options));
    if (chosen.empty()) break;
    take(chosen);
  }
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (found[i].size() < kMany) continue;
    for (int pass = 0; pass < kDensePasses; ++pass) {
      const auto chosen = dense_outliers_of(values, i, usable, options);
      if (chosen.empty()) break;
      take(chosen);
    }
  }
  repair(values, found, usable);
  if (ends_are_sound) repair_ends(values, usable, starts, at_ends, options, found);
  std::vector<DataFinding> findings;
  for (std::size_t i = 1; i < signals.size(); ++i) {
    if (found[i].empty()) continue;
    findings.push_back(finding_of(signals[i], found[i], values[i]));
  }
  return findings;
}

}  // namespace flexarm::measured
