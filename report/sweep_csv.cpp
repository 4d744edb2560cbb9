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
  }
  if (!result.modes.damping_ratio.empty()) {
    for (const char* name : {"damped_1_re", "damped_1_im", "damped_2_re", "damped_2_im"}) {
      table.columns.push_back({name, "rad/s"});
    }
    table.columns.push_back({"damping_ratio"});
  }
  return table;
}

/// What belongs to a pole; empty cells beside a zero.
void add_modes(const SweepResult& result, const SweepCurve& curve, std::size_t model,
               std::size_t point, std::size_t columns, std::vector<Cell>& row) {
  const auto& modes = result.modes;
  if (curve.zeros_of || modes.hub_slope.empty()) {
    row.resize(columns);
    return;
  }
  const auto order = static_cast<std::size_t>(curve.number) - 1;
  row.emplace_back(modes.hub_slope[model][order][point]);
  row.emplace_back(modes.tip_value_m[model][order][point]);
  if (modes.damped_poles.empty()) return;
  const auto& pair = modes.damped_poles[model][order][point];
  if (pair) {
    for (const auto s : {pair->first_rad_per_s, pair->second_rad_per_s}) {
      row.emplace_back(s.real());
      row.emplace_back(s.imag());
    }
    row.emplace_back(modes.damping_ratio[model][order][point]);
  }
  row.resize(columns);
}

void add_point(const SweepResult& result, std::size_t point, Table& table) {
  for (std::size_t m = 0; m < result.task.models.size(); ++m) {
    for (const SweepCurve& curve : result.curves) {
      const auto& s = curve.s_rad_per_s[m][point];
      if (!s) continue;
      std::vector<Cell> row;
      for (std::size_t k = 0; k < result.task.axes.size(); ++k) {
        row.emplace_back(result.task.value(k, point));
      }
      row.emplace_back(result.task.models[m].name);
      row.emplace_back(std::string(curve.zeros_of ? "zero" : "pole"));
      row.emplace_back();
      if (curve.zeros_of) row.back() = arm::to_string(*curve.zeros_of);
      row.emplace_back(std::int64_t{curve.number});
      row.emplace_back(s->real());
      row.emplace_back(s->imag());
      row.emplace_back(s->imag() > 0.0 ? std::abs(*s) / (2.0 * std::numbers::pi) : NAN);
      add_modes(result, curve, m, point, table.columns.size(), row);
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
