#include "report/tables/best_roots.hpp"

#include "report/tables/identification_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <utility>

namespace flexarm::report {
namespace {

using measured::Feature;
using measured::Method;

/// Best first.
constexpr std::array kMethods = {Method::rational_fit, Method::table, Method::nyquist_circle,
                                 Method::response, Method::autopower};
constexpr int kAfterOrders = std::numeric_limits<int>::max();

/// Smaller is better.
std::pair<std::ptrdiff_t, double> rank(const ReadRoot& one) {
  return {std::ranges::find(kMethods, one.method) - kMethods.begin(),
          one.root->measured.frequency_std_Hz.value_or(std::numeric_limits<double>::infinity())};
}

std::string alias_name(const compare::IdentifiedRoot& root) {
  const std::string mode =
      root.alias_of_order ? fmt::format("pole {}", *root.alias_of_order) : "a pole";
  return fmt::format("alias of {} at {:.5g} Hz", mode, *root.alias_of_Hz);
}

}  // namespace

std::tuple<Feature, bool, std::string, int, double> ReadRoot::key() const {
  return {root->measured.feature, hub_held, is_of_all() ? "" : sensor,
          root->order.value_or(kAfterOrders), root->alias_of_Hz.value_or(0.0)};
}

std::string ReadRoot::name() const {
  const std::string number = root->order         ? fmt::format("{}", *root->order)
                             : root->alias_of_Hz ? alias_name(*root)
                                                 : "unmatched";
  const bool names_sensor = is_pole() && !is_of_all() && sensor != "all";
  return number + (hub_held ? ", hub held" : "") + (names_sensor ? ", " + sensor : "");
}

std::vector<ReadRoot> read_roots(const measured::Identification& identification,
                                 const compare::IdentifiedCondition& condition) {
  std::vector<ReadRoot> roots;
  for (std::size_t i = 0; i < condition.roots.size(); ++i) {
    const auto& reading = identification.readings[condition.readings[i]];
    for (const auto& root : condition.roots[i]) {
      if (!root.measured.frequency_Hz) continue;
      const auto& sensor = root.measured.sensor ? root.measured.sensor : reading.sensor;
      roots.push_back({&root, reading.method, joined(reading.runs),
                       sensor ? arm::to_string(*sensor) : "all", reading.hub_held});
    }
  }
  return roots;
}

std::vector<ReadRoot> best_roots(std::vector<ReadRoot> roots) {
  std::erase_if(roots,
                [](const ReadRoot& one) { return !one.root->order && !one.root->alias_of_Hz; });
  std::ranges::stable_sort(roots, {},
                           [](const ReadRoot& one) { return std::pair(one.key(), rank(one)); });
  const auto repeated = std::ranges::unique(roots, {}, &ReadRoot::key);
  roots.erase(repeated.begin(), repeated.end());
  return roots;
}

bool is_by_best(const ReadRoot& one, const std::vector<ReadRoot>& best) {
  const bool is_numbered = one.root->order || one.root->alias_of_Hz;
  return (best.empty() && !is_numbered) || std::ranges::any_of(best, [&](const ReadRoot& other) {
           return other.method == one.method && (!is_numbered || other.key() == one.key());
         });
}

}  // namespace flexarm::report
