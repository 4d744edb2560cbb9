#include "compare/root_numbering.hpp"

#include "compare/features.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <iterator>
#include <limits>

namespace flexarm::compare {

namespace {

using measured::Feature;
using measured::ModalTable;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct SequenceRoot {
  double frequency_Hz = 0.0;
  Feature feature = Feature::pole;
  std::optional<int> order;  ///< 0: the lowest mode
  std::size_t entry = 0;     ///< index in the table, of measured ones
};
using Sequence = std::vector<SequenceRoot>;

void add_entries(const ModalTable& table, const std::vector<RootOrder>& orders, Feature feature,
                 const std::optional<arm::Sensor>& owner, Sequence& sequence) {
  for (std::size_t i = 0; i < table.size(); ++i) {
    if (table[i].feature != feature || table[i].sensor != owner || !table[i].frequency_Hz) continue;
    sequence.push_back({*table[i].frequency_Hz, feature, orders[i].order, i});
  }
}

const ModelRoots::Zeros* zeros_in(const ModelRoots& model, const arm::Sensor& sensor) {
  const auto at = std::ranges::find(model.zeros, sensor, &ModelRoots::Zeros::sensor);
  return at == model.zeros.end() ? nullptr : &*at;
}

/// Poles, with the zeros of `sensor` as far as they alternate.
Sequence model_sequence(const ModelRoots& model, const ModelRoots::Zeros* zeros) {
  Sequence sequence = {{model.lowest_Hz, Feature::pole, 0}};
  for (const ModelRoot& pole : model.poles) {
    sequence.push_back({pole.frequency_Hz, Feature::pole, pole.order});
  }
  if (zeros == nullptr) return sequence;
  for (const ModelRoot& zero : zeros->roots) {
    sequence.push_back({zero.frequency_Hz, Feature::zero, zero.order});
  }
  std::ranges::stable_sort(sequence, {}, &SequenceRoot::frequency_Hz);
  const auto repeated = std::ranges::adjacent_find(sequence, {}, &SequenceRoot::feature);
  if (repeated != sequence.end()) sequence.erase(std::next(repeated), sequence.end());
  return sequence;
}

/// The roots of the model that measured ones are when the first is the model's `first`: empty where
/// a stated order, or the end of the model's list, is against it. Of two poles side by side the
/// zero between them was missed, and vice versa.
std::vector<std::size_t> counted_from(std::size_t first, const Sequence& measured,
                                      const Sequence& model, bool alternates) {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const bool misses_one = alternates && i > 0 && measured[i].feature == measured[i - 1].feature;
    const std::size_t place = i == 0 ? first : places.back() + (misses_one ? 2 : 1);
    if (place >= model.size() || model[place].feature != measured[i].feature) return {};
    if (measured[i].order && measured[i].order != model[place].order) return {};
    places.push_back(place);
  }
  return places;
}

struct Deviation {
  double mean = 0.0;
  double rms = kInfinity;
  std::size_t count = 0;
};

/// Of ln(measured/model); the rigid-body mode has none.
Deviation deviation_of(const Sequence& measured, const Sequence& model,
                       const std::vector<std::size_t>& places) {
  std::vector<double> logarithms;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double frequency_Hz = model[places[i]].frequency_Hz;
    if (frequency_Hz > 0.0) logarithms.push_back(std::log(measured[i].frequency_Hz / frequency_Hz));
  }
  Deviation made;
  made.count = logarithms.size();
  if (made.count < 2) return made;
  const auto count = static_cast<double>(made.count);
  for (const double d : logarithms) made.mean += d / count;
  double squares = 0.0;
  for (const double d : logarithms) squares += std::pow(d - made.mean, 2);
  made.rms = std::sqrt(squares / (count - 1.0));
  return made;
}

/// Places in the model's sequence of all roots of `measured`; empty where they are not determined.
std::vector<std::size_t> interlaced(const Sequence& measured, const Sequence& model,
                                    bool alternates) {
  std::vector<std::size_t> best_places;
  Deviation best;
  double next_rms = kInfinity;
  for (std::size_t first = 0; first < model.size(); ++first) {
    auto places = counted_from(first, measured, model, alternates);
    const Deviation own = deviation_of(measured, model, places);
    if (own.rms >= best.rms) {
      next_rms = std::min(next_rms, own.rms);
      continue;
    }
    next_rms = best.rms;
    best = own;
    best_places = std::move(places);
  }
  if (best_places.empty() || std::abs(best.mean) > std::log(kMostFactor)) return {};
  if (next_rms < kDistinct * std::max(best.rms, kLeastDeviation)) return {};
  const bool from_the_first =
      alternates && best_places.front() <= 1 &&
      std::ranges::adjacent_find(measured, {}, &SequenceRoot::feature) == measured.end();
  const bool fits =
      (best.count >= 3 && best.rms <= kSameFactor) || (from_the_first && best.rms <= kFromTheFirst);
  return fits ? best_places : std::vector<std::size_t>{};
}

/// The factor of the poles that have an order; 1 without any.
double common_factor(const ModalTable& table, const ModelRoots& model,
                     const std::vector<RootOrder>& orders) {
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < table.size(); ++i) {
    if (table[i].feature != Feature::pole || !table[i].frequency_Hz || !orders[i].order) continue;
    const auto pole = std::ranges::find(model.poles, *orders[i].order, &ModelRoot::order);
    if (pole == model.poles.end()) continue;
    sum += std::log(*table[i].frequency_Hz / pole->frequency_Hz);
    count += 1.0;
  }
  return count > 0.0 ? std::exp(sum / count) : 1.0;
}

/// Numbers those of `measured` without an order by distance from `factor` times the model's,
/// nearest first, so that orders rise with frequency. A root with no order left between its
/// neighbours' has none.
void number_by_distance(Sequence measured, const std::vector<ModelRoot>& model, double factor,
                        std::vector<RootOrder>& orders) {
  std::vector<std::complex<double>> expected_Hz;
  for (const ModelRoot& root : model) expected_Hz.emplace_back(factor * root.frequency_Hz);
  std::vector<std::complex<double>> found_Hz;
  for (const SequenceRoot& root : measured) found_Hz.emplace_back(root.frequency_Hz);
  pair_nearest(expected_Hz, found_Hz, [&](std::size_t i, std::size_t j) {
    SequenceRoot& root = measured[j];
    const int order = model[i].order;
    const bool rises = std::ranges::all_of(measured, [&](const SequenceRoot& other) {
      if (!other.order) return true;
      return other.frequency_Hz < root.frequency_Hz ? *other.order < order : *other.order > order;
    });
    if (root.order || !rises) return false;
    root.order = order;
    orders[root.entry] = {order, OrderBasis::distance};
    return true;
  });
}

/// Whose poles and zeros a table has: collocated sensors first, since their zeros number poles.
std::vector<std::optional<arm::Sensor>> owners_of(const ModalTable& table) {
  std::vector<std::optional<arm::Sensor>> owners;
  for (const auto& entry : table) {
    if (std::ranges::find(owners, entry.sensor) == owners.end()) owners.push_back(entry.sensor);
  }
  std::ranges::stable_partition(owners, [](const std::optional<arm::Sensor>& owner) {
    return owner && arm::is_collocated(*owner);
  });
  return owners;
}

}  // namespace

std::vector<RootOrder> number_roots(const measured::ModalTable& table, const ModelRoots& model) {
  std::vector<RootOrder> orders;
  for (const auto& entry : table) {
    orders.push_back({entry.order, entry.order ? OrderBasis::stated : OrderBasis::none});
  }
  const auto owners = owners_of(table);
  std::vector<bool> is_lowest(table.size(), false);
  bool is_scaled = false;  // an interlaced sequence gave the poles' factor
  for (const auto& owner : owners) {
    const bool is_collocated = owner && arm::is_collocated(*owner);
    if (is_scaled && !is_collocated) continue;
    const ModelRoots::Zeros* zeros = is_collocated ? zeros_in(model, *owner) : nullptr;
    Sequence measured;
    add_entries(table, orders, Feature::pole, owner, measured);
    if (is_collocated && measured.empty()) {
      add_entries(table, orders, Feature::pole, std::nullopt, measured);
    }
    if (zeros != nullptr) add_entries(table, orders, Feature::zero, owner, measured);
    std::ranges::stable_sort(measured, {}, &SequenceRoot::frequency_Hz);
    const Sequence sequence = model_sequence(model, zeros);
    const auto places = interlaced(measured, sequence, zeros != nullptr);
    for (std::size_t i = 0; i < places.size(); ++i) {
      const int order = *sequence[places[i]].order;
      if (order == 0) is_lowest[measured[i].entry] = true;
      if (order == 0 || measured[i].order) continue;
      orders[measured[i].entry] = {order, OrderBasis::interlacing};
    }
    is_scaled = is_scaled || !places.empty();
  }
  const double factor = common_factor(table, model, orders);
  for (const auto& owner : owners) {
    Sequence poles, antiresonances;
    add_entries(table, orders, Feature::pole, owner, poles);
    std::erase_if(poles, [&](const SequenceRoot& root) { return is_lowest[root.entry]; });
    number_by_distance(poles, model.poles, factor, orders);
    const ModelRoots::Zeros* zeros = owner ? zeros_in(model, *owner) : nullptr;
    if (zeros == nullptr) continue;
    add_entries(table, orders, Feature::zero, owner, antiresonances);
    number_by_distance(antiresonances, zeros->roots, factor, orders);
  }
  return orders;
}

}  // namespace flexarm::compare
