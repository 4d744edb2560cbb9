#include "report/tables/identified_overview.hpp"

#include "report/tables/best_roots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace flexarm::report {
namespace {

constexpr std::size_t kMostUnmatched = 5;

Cell optional_cell(const std::optional<double>& value) {
  return value ? Cell(*value) : Cell();
}

/// Poles, or zeros, of the runs: the best readings, then the unnumbered ones.
std::vector<ReadRoot> shown_roots(const IdentifiedData& data, bool poles) {
  auto roots = read_roots(data.identification, data.condition);
  std::erase_if(
      roots, [&](const ReadRoot& one) { return one.runs != data.runs || one.is_pole() != poles; });
  const auto best = best_roots(roots);
  auto shown = best;
  for (const ReadRoot& one : roots) {
    if (one.root->order || one.root->alias_of_Hz || !is_by_best(one, best)) continue;
    if (shown.size() < best.size() + kMostUnmatched) shown.push_back(one);
  }
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
