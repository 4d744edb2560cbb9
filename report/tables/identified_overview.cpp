#include "report/tables/identified_overview.hpp"

#include "report/tables/identification_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace flexarm::report {
namespace {

using compare::IdentifiedRoot;
using measured::Feature;
using measured::Method;

/// Best first.
constexpr std::array kMethods = {Method::rational_fit, Method::table, Method::nyquist_circle,
                                 Method::response, Method::autopower};
constexpr std::size_t kMostUnmatched = 5;
constexpr int kAfterOrders = std::numeric_limits<int>::max();

/// A root as one method reads it from one sensor.
struct ReadRoot {
  const IdentifiedRoot* root = nullptr;
  Method method = Method::table;
  std::string sensor;
  bool hub_held = false;

  /// Roots with the same key are the same root.
  std::tuple<Feature, bool, std::string, int, double> key() const {
    return {root->measured.feature, hub_held, is_of_all() ? "" : sensor,
            root->order.value_or(kAfterOrders), root->alias_of_Hz.value_or(0.0)};
  }

  /// A given table may have its poles sensor by sensor.
  bool is_of_all() const { return is_pole() && method != Method::table; }

  /// With the hub held, the zeros of the hub angle are poles.
  bool is_pole() const { return root->measured.feature == Feature::pole || hub_held; }

  /// Smaller is better.
  std::tuple<std::ptrdiff_t, double> rank() const {
    return {std::ranges::find(kMethods, method) - kMethods.begin(),
            root->measured.frequency_std_Hz.value_or(std::numeric_limits<double>::infinity())};
  }

  std::string alias_name() const {
    const std::string mode =
        root->alias_of_order ? fmt::format("pole {}", *root->alias_of_order) : "a pole";
    return fmt::format("alias of {} at {:.5g} Hz", mode, *root->alias_of_Hz);
  }

  std::string name() const {
    const std::string number = root->order         ? fmt::format("{}", *root->order)
                               : root->alias_of_Hz ? alias_name()
                                                   : "unmatched";
    const bool names_sensor = is_pole() && !is_of_all() && sensor != "all";
    return number + (hub_held ? ", hub held" : "") + (names_sensor ? ", " + sensor : "");
  }
};

std::vector<ReadRoot> roots_of(const IdentifiedData& data) {
  std::vector<ReadRoot> roots;
  for (std::size_t i = 0; i < data.condition.roots.size(); ++i) {
    const auto& reading = data.identification.readings[data.condition.readings[i]];
    if (joined(reading.runs) != data.runs) continue;
    for (const auto& root : data.condition.roots[i]) {
      if (!root.measured.frequency_Hz) continue;
      const auto& sensor = root.measured.sensor ? root.measured.sensor : reading.sensor;
      roots.push_back(
          {&root, reading.method, sensor ? arm::to_string(*sensor) : "all", reading.hub_held});
    }
  }
  return roots;
}

/// Of each numbered root and each alias its best reading; poles first, then the zeros sensor by
/// sensor.
std::vector<ReadRoot> best_of(std::vector<ReadRoot> roots) {
  std::erase_if(roots,
                [](const ReadRoot& one) { return !one.root->order && !one.root->alias_of_Hz; });
  std::ranges::stable_sort(roots, {},
                           [](const ReadRoot& one) { return std::tuple(one.key(), one.rank()); });
  const auto repeated = std::ranges::unique(roots, {}, &ReadRoot::key);
  roots.erase(repeated.begin(), repeated.end());
  return roots;
}

/// The unnumbered roots of the methods that the best readings come from.
std::vector<ReadRoot> unmatched_of(const std::vector<ReadRoot>& roots,
                                   const std::vector<ReadRoot>& best) {
  std::vector<ReadRoot> found;
  for (const auto& one : roots) {
    const bool is_used =
        best.empty() || std::ranges::count(best, one.method, &ReadRoot::method) > 0;
    if (one.root->order || one.root->alias_of_Hz || !is_used) continue;
    if (found.size() < kMostUnmatched) found.push_back(one);
  }
  return found;
}

Cell optional_cell(const std::optional<double>& value) {
  return value ? Cell(*value) : Cell();
}

/// Poles, or zeros: the best readings, then the unnumbered ones.
std::vector<ReadRoot> shown_roots(const IdentifiedData& data, bool poles) {
  auto roots = roots_of(data);
  std::erase_if(roots, [poles](const ReadRoot& one) { return one.is_pole() != poles; });
  auto shown = best_of(roots);
  const auto unmatched = unmatched_of(roots, shown);
  shown.insert(shown.end(), unmatched.begin(), unmatched.end());
  return shown;
}

}  // namespace

Table identified_poles_overview(const IdentifiedData& data) {
  Table table{fmt::format("{}: poles, natural frequency |s|/(2 pi) and damping ratio", data.runs),
              {{"pole"},
               {"method"},
               {"measured", "Hz", 6},
               qualifying("+-", "Hz", 2),
               {"exact_tf", "Hz", 6},
               qualifying("error", "%", 2),
               {"damping ratio", "", 4},
               qualifying("+-", "", 2),
               {"exact_tf", "", 4}}};
  for (const auto& one : shown_roots(data, true)) {
    const auto& measured = one.root->measured;
    table.add_row({one.name(), std::string(to_string(one.method)),
                   optional_cell(measured.frequency_Hz), optional_cell(measured.frequency_std_Hz),
                   optional_cell(one.root->analytical_Hz), one.root->error_percent(),
                   optional_cell(measured.damping_ratio), optional_cell(measured.damping_ratio_std),
                   optional_cell(one.root->analytical_damping_ratio)});
  }
  return without_predictions(std::move(table), data.condition);
}

Table identified_zeros_overview(const IdentifiedData& data) {
  Table table{fmt::format("{}: zeros, natural frequency |s|/(2 pi)", data.runs),
              {{"sensor"},
               {"zero"},
               {"method"},
               {"measured", "Hz", 6},
               qualifying("+-", "Hz", 2),
               {"exact_tf", "Hz", 6},
               qualifying("error", "%", 2)}};
  for (const auto& one : shown_roots(data, false)) {
    const auto& measured = one.root->measured;
    table.add_row({one.sensor, one.name(), std::string(to_string(one.method)),
                   optional_cell(measured.frequency_Hz), optional_cell(measured.frequency_std_Hz),
                   optional_cell(one.root->analytical_Hz), one.root->error_percent()});
  }
  return without_predictions(std::move(table), data.condition);
}

}  // namespace flexarm::report
