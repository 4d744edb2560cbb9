#include "report/csv.hpp"
#include "report/sweep_tables.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>

namespace flexarm::report {

namespace {

using compare::SweepCurve;
using compare::SweepResult;

/// As many points are turned to text at a time.
constexpr std::size_t kPointsInAPart = 1000;

Table header(const SweepResult& result) {
  Table table{"", {}};
  for (const auto& axis : result.task.axes) {
    table.columns.push_back({axis.parameter.name, axis.parameter.unit});
  }
  for (const char* name : {"model", "feature", "sensor", "number"}) {
    table.columns.push_back({name});
  }
  table.columns.push_back({"re", "rad/s"});
  table.columns.push_back({"im", "rad/s"});
  table.columns.push_back({"frequency", "Hz"});
  if (!result.modes.hub_slope.empty()) {
    table.columns.push_back({"hub_slope"});
    table.columns.push_back({"tip_value", "m"});
    table.columns.push_back({"damping_ratio"});
  }
  return table;
}

void add_modes(const SweepResult& result, const SweepCurve& curve, std::size_t model,
               std::size_t point, std::vector<Cell>& row) {
  if (result.modes.hub_slope.empty()) return;
  const auto order = static_cast<std::size_t>(curve.number) - 1;
  for (const auto* table :
       {&result.modes.hub_slope, &result.modes.tip_value_m, &result.modes.damping_ratio}) {
    row.push_back(curve.zeros_of ? Cell() : Cell((*table)[model][order][point]));
  }
}

void add_point(const SweepResult& result, std::size_t point, Table& table) {
  const auto places = result.task.places_of(point);
  for (std::size_t m = 0; m < result.task.models.size(); ++m) {
    for (const SweepCurve& curve : result.curves) {
      const auto& s = curve.s_rad_per_s[m][point];
      if (!s) continue;
      std::vector<Cell> row;
      for (std::size_t k = 0; k < places.size(); ++k) {
        row.emplace_back(result.task.axes[k].at(places[k]));
      }
      row.emplace_back(result.task.models[m].name);
      row.emplace_back(std::string(curve.zeros_of ? "zero" : "pole"));
      row.push_back(curve.zeros_of ? Cell(arm::to_string(*curve.zeros_of)) : Cell());
      row.emplace_back(std::int64_t{curve.number});
      row.emplace_back(s->real());
      row.emplace_back(s->imag());
      row.push_back(s->imag() > 0.0 ? Cell(std::abs(*s) / (2.0 * std::numbers::pi)) : Cell());
      add_modes(result, curve, m, point, row);
      table.add_row(std::move(row));
    }
  }
}

}  // namespace

void write_sweep_csv(const SweepResult& result,
                     const std::function<void(std::string_view)>& write) {
  const Table empty = header(result);
  const std::string names = to_csv(empty);
  write(names);
  for (std::size_t begin = 0; begin < result.task.points(); begin += kPointsInAPart) {
    Table part = empty;
    const std::size_t end = std::min(begin + kPointsInAPart, result.task.points());
    for (std::size_t point = begin; point < end; ++point) add_point(result, point, part);
    write(std::string_view(to_csv(part)).substr(names.size()));
  }
}

}  // namespace flexarm::report
