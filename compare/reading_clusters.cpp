#include "compare/reading_clusters.hpp"

#include "measured/spectra/robust.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <tuple>
#include <utility>

namespace flexarm::compare {

namespace {

using measured::Feature;
using measured::Method;
using measured::ModalEntry;

constexpr double kInfinite = std::numeric_limits<double>::infinity();
/// Poles below one whose spacing can be judged without a model.
constexpr std::size_t kPolesBelow = 3;
/// Methods, most accurate first.
constexpr std::array kBestFirst = {Method::rational_fit, Method::nyquist_circle, Method::response,
                                   Method::autopower};

/// One estimate, with where it is in the readings.
struct PlacedEstimate {
  std::size_t reading = 0;
  std::size_t entry = 0;
  Method method = Method::table;
  double frequency_Hz = 0.0;
  double std_Hz = kInfinite;
  double sampling_period_s = 0.0;

  auto rank() const {
    return std::tuple(std::ranges::find(kBestFirst, method) - kBestFirst.begin(), std_Hz);
  }
};

/// Estimates of one root, the most accurate first.
struct RootCluster {
  Feature feature = Feature::pole;
  std::optional<arm::Sensor> sensor;  ///< of a zero
  std::vector<PlacedEstimate> estimates;
  RootPlace place;
  bool is_sure = true;  ///< not a peak by chance: it would move all orders above it

  double frequency_Hz() const { return estimates.front().frequency_Hz; }
  double nyquist_Hz() const {
    const double period_s = estimates.front().sampling_period_s;
    return period_s > 0.0 ? 0.5 / period_s : kInfinite;
  }
  bool is_pole() const { return feature == Feature::pole; }
  bool is_fitted() const { return estimates.front().method == Method::rational_fit; }
};

using RootClusters = std::vector<RootCluster>;

double distance(const RootCluster& cluster, const PlacedEstimate& estimate) {
  return std::abs(std::log(estimate.frequency_Hz / cluster.frequency_Hz()));
}

/// The estimate of the same reading; the end where there is none. A reading has each root once.
auto own_of(RootCluster& cluster, const PlacedEstimate& estimate) {
  return std::ranges::find(cluster.estimates, estimate.reading, &PlacedEstimate::reading);
}

/// Puts the estimate into the nearest cluster that has none of its reading or one farther off,
/// which has to look for another place then; into one of its own where there is none.
void add_to(RootClusters& clusters, Feature feature, const std::optional<arm::Sensor>& sensor,
            const PlacedEstimate& estimate) {
  RootCluster* nearest = nullptr;
  double least = feature == Feature::pole ? kSamePole : kSameZero;
  for (RootCluster& cluster : clusters) {
    if (cluster.feature != feature || cluster.sensor != sensor) continue;
    const double off = distance(cluster, estimate);
    const auto own = own_of(cluster, estimate);
    if (off > least || (own != cluster.estimates.end() && distance(cluster, *own) <= off)) continue;
    least = off;
    nearest = &cluster;
  }
  if (nearest == nullptr) {
    clusters.push_back({feature, sensor, {estimate}, {}, true});
    return;
  }
  const auto own = own_of(*nearest, estimate);
  if (own == nearest->estimates.end()) {
    nearest->estimates.push_back(estimate);
    return;
  }
  const PlacedEstimate farther = std::exchange(*own, estimate);
  add_to(clusters, feature, sensor, farther);
}

/// Ascending in frequency.
RootClusters clusters_of(std::span<const SampledReading> readings) {
  std::vector<PlacedEstimate> all;
  for (std::size_t r = 0; r < readings.size(); ++r) {
    const measured::ModalReading& reading = *readings[r].reading;
    if (reading.method == Method::table) continue;
    for (std::size_t i = 0; i < reading.table.size(); ++i) {
      const ModalEntry& entry = reading.table[i];
      if (!entry.frequency_Hz || !(*entry.frequency_Hz > 0.0)) continue;
      all.push_back({r, i, reading.method, *entry.frequency_Hz,
                     entry.frequency_std_Hz.value_or(kInfinite), readings[r].sampling_period_s});
    }
  }
  std::ranges::stable_sort(all, {}, &PlacedEstimate::rank);
  RootClusters clusters;
  for (const PlacedEstimate& estimate : all) {
    const ModalEntry& entry = readings[estimate.reading].reading->table[estimate.entry];
    const bool is_pole = entry.feature == Feature::pole;
    add_to(clusters, entry.feature, is_pole ? std::nullopt : entry.sensor, estimate);
  }
  std::ranges::stable_sort(clusters, {}, &RootCluster::frequency_Hz);
  const bool has_fit = std::ranges::any_of(clusters, &RootCluster::is_fitted);
  for (RootCluster& cluster : clusters) {
    cluster.is_sure = !has_fit || cluster.is_fitted() || cluster.estimates.size() > 1;
  }
  return clusters;
}

/// The folded frequency, from 0 to the Nyquist frequency.
double folded_Hz(double frequency_Hz, double nyquist_Hz) {
  return std::abs(std::remainder(frequency_Hz, 2.0 * nyquist_Hz));
}

/// Numbers of the clusters with some poles left out.
struct ClusterNumbering {
  std::vector<std::optional<int>> orders;
  double factor = 1.0;  ///< measured over model, geometric mean of the poles
  double misfit = 0.0;
  std::size_t poles = 0;  ///< with an order
};

const ModelRoot* pole_of(const ModelRoots& model, const std::optional<int>& order) {
  if (!order) return nullptr;
  const auto at = std::ranges::find(model.poles, *order, &ModelRoot::order);
  return at == model.poles.end() ? nullptr : &*at;
}

/// Zeros beside a pole that is left out: without it they are none, or cannot be told.
bool is_beside_left_out(const RootClusters& clusters, std::size_t zero) {
  for (const int step : {-1, 1}) {
    for (auto k = static_cast<std::ptrdiff_t>(zero) + step;
         k >= 0 && k < static_cast<std::ptrdiff_t>(clusters.size()); k += step) {
      const RootCluster& other = clusters[static_cast<std::size_t>(k)];
      if (!other.is_pole()) continue;
      if (other.place.alias_of_Hz) return true;
      break;
    }
  }
  return false;
}

ClusterNumbering number(const RootClusters& clusters, const ModelRoots& model) {
  measured::ModalTable table;
  std::vector<std::size_t> at;
  for (std::size_t c = 0; c < clusters.size(); ++c) {
    const RootCluster& cluster = clusters[c];
    if (cluster.place.alias_of_Hz) continue;
    if (cluster.is_pole() ? !cluster.is_sure : is_beside_left_out(clusters, c)) continue;
    table.push_back({.sensor = cluster.sensor,
                     .feature = cluster.feature,
                     .order = {},
                     .frequency_Hz = cluster.frequency_Hz(),
                     .frequency_std_Hz = {},
                     .damping_ratio = {},
                     .damping_ratio_std = {}});
    at.push_back(c);
  }
  const auto orders = number_roots(table, model);
  ClusterNumbering made{std::vector<std::optional<int>>(clusters.size()), 1.0, 0.0, 0};
  std::vector<double> logarithms;
  for (std::size_t i = 0; i < table.size(); ++i) {
    made.orders[at[i]] = orders[i].order;
    if (table[i].feature != Feature::pole) continue;
    if (const ModelRoot* pole = pole_of(model, orders[i].order)) {
      logarithms.push_back(std::log(*table[i].frequency_Hz / pole->frequency_Hz));
    } else {
      made.misfit += kUnmatched * kUnmatched;
    }
  }
  made.poles = logarithms.size();
  if (logarithms.empty()) return made;
  double mean = 0.0;
  for (const double d : logarithms) mean += d / static_cast<double>(logarithms.size());
  for (const double d : logarithms) made.misfit += (d - mean) * (d - mean);
  made.factor = std::exp(mean);
  return made;
}

/// A mode above the Nyquist frequency that a pole may be the alias of.
struct Alias {
  const ModelRoot* mode = nullptr;
  double misfit = kInfinite;  ///< [(f - folded)/f_m]^2
  double chance = kInfinite;  ///< that one of the modes up to this has an alias as near
};

/// Returns the one that is near by chance with the least probability.
Alias least_by_chance(const RootCluster& cluster, const ModelRoots& model, double factor) {
  Alias found;
  const double nyquist_Hz = cluster.nyquist_Hz();
  const double std_Hz = cluster.estimates.front().std_Hz;
  double modes = 0.0;
  for (const auto* poles : {&model.poles, &model.beyond}) {
    for (const ModelRoot& pole : *poles) {
      const double mode_Hz = factor * pole.frequency_Hz;
      if (mode_Hz <= nyquist_Hz || mode_Hz > 2.0 * kMostTurns * nyquist_Hz) continue;
      modes += 1.0;
      const double off_Hz = std::abs(folded_Hz(mode_Hz, nyquist_Hz) - cluster.frequency_Hz());
      const double near_Hz = std::isfinite(std_Hz) ? std::max(off_Hz, std_Hz) : off_Hz;
      const double chance = 2.0 * modes * near_Hz / nyquist_Hz;
      if (chance < found.chance) found = {&pole, std::pow(off_Hz / mode_Hz, 2), chance};
    }
  }
  return found;
}

/// The frequency nearest to `expected_Hz` that sampling folds to the cluster's.
double unfolded_Hz(const RootCluster& cluster, double expected_Hz) {
  double nearest_Hz = kInfinite;
  for (int k = 1; k <= kMostTurns; ++k) {
    for (const int sign : {-1, 1}) {
      const double there_Hz = 2.0 * k * cluster.nyquist_Hz() + sign * cluster.frequency_Hz();
      if (std::abs(there_Hz - expected_Hz) < std::abs(nearest_Hz - expected_Hz)) {
        nearest_Hz = there_Hz;
      }
    }
  }
  return nearest_Hz;
}

/// Marks the pole that is an alias most surely; whether there was one.
bool mark_alias(RootClusters& clusters, const ModelRoots& model) {
  const double before = number(clusters, model).misfit;
  double least_chance = kMostChance;
  RootCluster* alias = nullptr;
  RootPlace place;
  for (RootCluster& cluster : clusters) {
    const bool may_be = cluster.is_pole() && cluster.is_sure && !cluster.place.alias_of_Hz &&
                        std::isfinite(cluster.nyquist_Hz());
    if (!may_be) continue;
    cluster.place.alias_of_Hz = cluster.frequency_Hz();  // left out
    const ClusterNumbering without = number(clusters, model);
    cluster.place = {};
    if (without.poles < 2) continue;
    const Alias found = least_by_chance(cluster, model, without.factor);
    const double as_alias = found.misfit + kAliasPrice * kAliasPrice;
    if (found.chance > least_chance || before - without.misfit < kDistinct * kDistinct * as_alias) {
      continue;
    }
    least_chance = found.chance;
    alias = &cluster;
    place = {std::nullopt, unfolded_Hz(cluster, without.factor * found.mode->frequency_Hz),
             found.mode->order};
  }
  if (alias != nullptr) alias->place = place;
  return alias != nullptr;
}

/// The same by the spacing of a beam's modes, without a model.
void mark_aliases_by_spacing(RootClusters& clusters) {
  std::vector<double> roots;  // of the frequencies of the poles below
  for (RootCluster& cluster : clusters) {
    if (!cluster.is_pole()) continue;
    const double root = std::sqrt(cluster.frequency_Hz());
    if (roots.size() >= kPolesBelow && std::isfinite(cluster.nyquist_Hz())) {
      const double spacing = roots.back() - roots[roots.size() - 2];
      const double next = roots.back() + spacing;
      const double there_Hz = unfolded_Hz(cluster, next * next);
      if (root - roots.back() < kTooNear * spacing &&
          std::abs(std::sqrt(there_Hz) - next) <= kContinued * spacing) {
        cluster.place.alias_of_Hz = there_Hz;
        continue;
      }
    }
    roots.push_back(root);
  }
}

/// Poles, and zeros sensor by sensor, counted from 1 up.
void count_up(RootClusters& clusters) {
  for (std::size_t c = 0; c < clusters.size(); ++c) {
    RootCluster& cluster = clusters[c];
    if (cluster.place.alias_of_Hz || !cluster.is_sure) continue;
    int order = 1;
    for (std::size_t k = 0; k < c; ++k) {
      const RootCluster& below = clusters[k];
      order += below.feature == cluster.feature && below.sensor == cluster.sensor &&
               below.place.order.has_value();
    }
    cluster.place.order = order;
  }
}

/// Takes the order from peaks that are much farther from the model than the poles of the fit.
void withdraw_far_peaks(RootClusters& clusters, const ModelRoots& model) {
  constexpr double kStandardDeviations = 3.0;
  constexpr std::size_t kFewestFitted = 3;
  const auto deviation = [&](const RootCluster& cluster) {
    return std::log(cluster.frequency_Hz() / pole_of(model, cluster.place.order)->frequency_Hz);
  };
  std::vector<double> fitted;
  for (const RootCluster& cluster : clusters) {
    if (cluster.is_pole() && cluster.is_fitted() &&
        pole_of(model, cluster.place.order) != nullptr) {
      fitted.push_back(deviation(cluster));
    }
  }
  if (fitted.size() < kFewestFitted) return;
  const double mean = measured::mean(fitted);
  const double within = kSamePole + kStandardDeviations * measured::standard_deviation(fitted);
  for (RootCluster& cluster : clusters) {
    if (!cluster.is_pole() || cluster.is_fitted() || !pole_of(model, cluster.place.order)) continue;
    if (std::abs(deviation(cluster) - mean) > within) cluster.place.order.reset();
  }
}

void give_orders(RootClusters& clusters, const std::optional<ModelRoots>& model) {
  if (!model) {
    mark_aliases_by_spacing(clusters);
    count_up(clusters);
    return;
  }
  while (mark_alias(clusters, *model)) {
  }
  const ClusterNumbering numbered = number(clusters, *model);
  for (std::size_t c = 0; c < clusters.size(); ++c) clusters[c].place.order = numbered.orders[c];
  withdraw_far_peaks(clusters, *model);
}

/// A given table: the zeros of one sensor number the poles of all.
std::vector<RootPlace> places_in_table(std::span<const SampledReading> readings, std::size_t r,
                                       const std::optional<ModelRoots>& model) {
  const measured::ModalReading& own = *readings[r].reading;
  measured::ModalTable all = own.table;
  for (std::size_t k = 0; k < readings.size(); ++k) {
    const measured::ModalReading& other = *readings[k].reading;
    if (k == r || other.method != own.method || other.runs != own.runs) continue;
    all.insert(all.end(), other.table.begin(), other.table.end());
  }
  const auto orders = number_roots(all, model.value_or(ModelRoots{}));
  std::vector<RootPlace> places(own.table.size());
  for (std::size_t i = 0; i < places.size(); ++i) places[i].order = orders[i].order;
  return places;
}

}  // namespace

std::vector<std::vector<RootPlace>> place_readings(std::span<const SampledReading> readings,
                                                   const std::optional<ModelRoots>& model) {
  std::vector<std::vector<RootPlace>> places;
  for (std::size_t r = 0; r < readings.size(); ++r) {
    const measured::ModalReading& reading = *readings[r].reading;
    places.push_back(reading.method == Method::table
                         ? places_in_table(readings, r, model)
                         : std::vector<RootPlace>(reading.table.size()));
  }
  RootClusters clusters = clusters_of(readings);
  give_orders(clusters, model);
  for (const RootCluster& cluster : clusters) {
    for (const PlacedEstimate& estimate : cluster.estimates) {
      places[estimate.reading][estimate.entry] = cluster.place;
    }
  }
  return places;
}

}  // namespace flexarm::compare
