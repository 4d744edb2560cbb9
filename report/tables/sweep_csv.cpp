#include "report/tables/csv.hpp"
#include "report/tables/sweep_tables.hpp"

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
    table.columns.push_back({"damping_ratio"});
    table.columns.push_back({"hub_slope"});
    table.columns.push_back({"tip_value", "m"});
  }
  return table;
}

/// Damping ratio of a damped pole, hub slope and end-point value of an undamped one; empty cells
/// beside others.
void add_modes(const SweepResult& result, const SweepCurve& curve, std::size_t model,
               std::size_t point, std::complex<double> s_rad_per_s, std::vector<Cell>& row) {
  if (result.modes.hub_slope.empty()) return;
  row.emplace_back(curve.family.damped ? compare::damping_ratio(s_rad_per_s) : NAN);
  const bool has_mode = !curve.family.zeros_of && !curve.family.damped;
  const auto order = static_cast<std::size_t>(curve.number) - 1;
  for (const auto* table : {&result.modes.hub_slope, &result.modes.tip_value_m}) {
    row.emplace_back(has_mode ? (*table)[model][order][point] : NAN);
  }
}

std::string feature_of(const compare::SweepFamily& family) {
  if (family.zeros_of) return "zero";
  return family.damped ? "damped pole" : "pole";
}

void add_point(const SweepResult& result, std::size_t point, Table& table) {
  for (std::size_t m = 0; m < result.task.models.size(); ++m) {
    for (const SweepCurve& curve : result.curves) {
      const auto& s = curve.s_rad_per_s[m][point];
      if (!s) continue;
      std::vector<Cell> row;
      row.reserve(table.columns.size());
      for (std::size_t k = 0; k < result.task.axes.size(); ++k) {
        row.emplace_back(result.task.value(k, point));
      }
      row.emplace_back(result.task.models[m].name);
      row.emplace_back(feature_of(curve.family));
      row.emplace_back();
      if (curve.family.zeros_of) row.back() = arm::to_string(*curve.family.zeros_of);
      row.emplace_back(std::int64_t{curve.number});
      row.emplace_back(s->real());
      row.emplace_back(s->imag());
      row.emplace_back(s->imag() > 0.0 ? std::abs(*s) / (2.0 * std::numbers::pi) : NAN);
      add_modes(result, curve, m, point, *s, row);
      table.add_row(std::move(row));
    }
  }
}

}  // namespace

std::string sweep_csv(const SweepResult& result) {
  const Table empty = header(result);
  const std::string names = to_csv(empty);
  std::string csv = names;
  // Cells take far more room than their text.
  for (std::size_t begin = 0; begin < result.task.points(); begin += kPointsInAPart) {
    Table part = empty;
    const std::size_t end = std::min(begin + kPointsInAPart, result.task.points());
    for (std::size_t point = begin; point < end; ++point) add_point(result, point, part);
    csv += std::string_view(to_csv(part)).substr(names.size());
  }
  return csv;
}

}  // namespace flexarm::report
