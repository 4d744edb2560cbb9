#include "report/tables/sweep_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>

namespace flexarm::report {

namespace {

using compare::SweepCurve;
using compare::SweepEvent;
using compare::SweepResult;

constexpr int kSweepDigits = 7;
constexpr int kPlaceDigits = 5;

std::string unit_of(const compare::SweepAxis& axis) {
  return axis.parameter.unit == "1" ? "" : axis.parameter.unit;
}

/// "at", or of two parameters "at mass".
std::string place_column(const SweepResult& result, std::size_t axis) {
  const std::string& name = result.task.axes[axis].parameter.name;
  return result.task.axes.size() == 1 ? "at" : "at " + name.substr(name.find_last_of('.') + 1);
}

/// The count, or nothing.
Cell count_if(bool given, int count) {
  Cell cell;
  if (given) cell = std::int64_t{count};
  return cell;
}

/// The grid points at which one row of numbers is smallest and largest; NaN is no number.
struct Extremes {
  std::optional<std::size_t> lowest;
  std::optional<std::size_t> highest;

  explicit Extremes(const std::vector<double>& values) {
    for (std::size_t p = 0; p < values.size(); ++p) {
      if (std::isnan(values[p])) continue;
      if (!lowest || values[p] < values[*lowest]) lowest = p;
      if (!highest || values[p] > values[*highest]) highest = p;
    }
  }
};

/// Columns and rows of "first, last, lowest at, highest at".
class RangeTable {
 public:
  RangeTable(const SweepResult& result, std::string caption, const char* row_name,
             const std::string& unit, bool has_remarks = false)
      : result_(result) {
    table_.caption = std::move(caption);
    table_.columns = {{row_name}};
    if (has_remarks) table_.columns.push_back({"axis"});
    table_.columns.push_back({"first", unit, kSweepDigits});
    table_.columns.push_back({"last", unit, kSweepDigits});
    for (const char* extreme : {"lowest", "highest"}) {
      table_.columns.push_back({extreme, unit, kSweepDigits});
      for (std::size_t k = 0; k < result.task.axes.size(); ++k) {
        table_.columns.push_back(
            {place_column(result, k), unit_of(result.task.axes[k]), kPlaceDigits});
      }
    }
  }

  void add(int number, const std::vector<double>& values, const std::string& remark = "") {
    std::vector<Cell> row;
    row.reserve(table_.columns.size());
    row.emplace_back(std::int64_t{number});
    if (!remark.empty()) row.emplace_back(remark);
    row.emplace_back(values.front());
    row.emplace_back(values.back());
    const Extremes extremes(values);
    for (const auto& point : {extremes.lowest, extremes.highest}) {
      row.emplace_back(point ? values[*point] : NAN);
      for (std::size_t k = 0; k < result_.task.axes.size(); ++k) {
        row.emplace_back(point ? result_.task.value(k, *point) : NAN);
      }
    }
    table_.add_row(std::move(row));
  }

  const Table& table() const { return table_; }

 private:
  const SweepResult& result_;
  Table table_;
};

/// Frequencies [Hz] of a curve of the first model, or |s| [rad/s].
std::vector<double> moduli(const SweepCurve& curve, double unit) {
  std::vector<double> values;
  for (const auto& s : curve.s_rad_per_s.front()) values.push_back(s ? std::abs(*s) / unit : NAN);
  return values;
}

/// "real", "imaginary", "complex": where the curve runs, in this order.
std::string places_of(const SweepCurve& curve) {
  std::array<bool, 3> seen = {};
  for (const auto& s : curve.s_rad_per_s.front()) {
    if (s) seen[s->imag() == 0.0 ? 0 : s->real() == 0.0 ? 1 : 2] = true;
  }
  constexpr std::array kNames = {"real", "imaginary", "complex"};
  std::string text;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (seen[i]) text += (text.empty() ? "" : ", ") + std::string(kNames[i]);
  }
  return text;
}

std::string caption_of(const compare::SweepFamily& family) {
  if (!family.zeros_of)
    return family.damped ? "Poles with damping, |s| of each track" : "Poles, undamped";
  return fmt::format(
      "Zeros of torque to {}{}", arm::to_string(*family.zeros_of),
      family.is_ordered() ? "" : ", |s| of each track (real or complex: non-minimum phase)");
}

/// What one of them is called in its table.
const char* row_name(const compare::SweepFamily& family) {
  return family.zeros_of ? "zero" : "pole";
}

Table curves_table(const SweepResult& result, const compare::SweepFamily& family) {
  const bool real_ones = family.zeros_of && !family.is_ordered();
  RangeTable table(result, caption_of(family), row_name(family), real_ones ? "rad/s" : "Hz",
                   !family.is_ordered());
  for (const SweepCurve& curve : result.curves) {
    if (curve.family != family) continue;
    table.add(curve.number, moduli(curve, real_ones ? 1.0 : 2.0 * std::numbers::pi),
              family.is_ordered() ? "" : places_of(curve));
  }
  return table.table();
}

Table damping_table(const SweepResult& result, const compare::SweepFamily& family) {
  RangeTable table(result, "Damping ratio -Re s/|s|", "pole", "");
  for (const SweepCurve& curve : result.curves) {
    if (curve.family != family) continue;
    std::vector<double> values;
    for (const auto& s : curve.s_rad_per_s.front()) {
      values.push_back(s ? compare::damping_ratio(*s) : NAN);
    }
    table.add(curve.number, values);
  }
  return table.table();
}

Table modes_table(const SweepResult& result, const char* caption, const char* unit,
                  const compare::SweepTable& values) {
  RangeTable table(result, caption, "mode", unit);
  for (std::size_t k = 0; k < values.front().size(); ++k) {
    table.add(static_cast<int>(k) + 1, values.front()[k]);
  }
  return table.table();
}

}  // namespace

std::string_view word_for(SweepEvent::Kind kind) {
  switch (kind) {
    case SweepEvent::Kind::appears_beyond:
      return "enters the range";
    case SweepEvent::Kind::leaves_beyond:
      return "leaves the range";
    case SweepEvent::Kind::appears:
      return "appears";
    case SweepEvent::Kind::vanishes:
      return "vanishes";
    case SweepEvent::Kind::meet:
      return "coalesces with";
    case SweepEvent::Kind::part:
      return "separates from";
    case SweepEvent::Kind::ambiguous:
      return "assignment ambiguous";
    case SweepEvent::Kind::seam:
      return "inconsistent with the previous row";
  }
  return "";
}

std::string sweep_axes_lines(const SweepResult& result) {
  std::string lines;
  for (const auto& axis : result.task.axes) {
    const std::string unit = unit_of(axis);
    lines += fmt::format("{} from {} to {}{}{}, {} values{}\n", axis.parameter.name,
                         axis.values.front(), axis.values.back(), unit.empty() ? "" : " ", unit,
                         axis.values.size(), axis.logarithmic ? " (logarithmic)" : "");
  }
  return lines;
}

Table sweep_models_table(const SweepResult& result) {
  Table table{"", {{"model"}, {"settings"}, {"degrees of freedom"}}};
  for (std::size_t m = 0; m < result.task.models.size(); ++m) {
    const int freedoms = result.degrees_of_freedom[m];
    table.add_row({result.task.models[m].name, result.task.models[m].settings,
                   count_if(freedoms > 0, freedoms)});
  }
  return table;
}

std::vector<Table> sweep_range_tables(const SweepResult& result) {
  std::vector<Table> tables;
  std::vector<compare::SweepFamily> seen;
  for (const SweepCurve& curve : result.curves) {
    if (std::ranges::find(seen, curve.family) != seen.end()) continue;
    seen.push_back(curve.family);
    tables.push_back(curves_table(result, curve.family));
    if (curve.family.damped) tables.push_back(damping_table(result, curve.family));
  }
  return tables;
}

std::vector<Table> sweep_mode_tables(const SweepResult& result) {
  const auto& modes = result.modes;
  if (modes.hub_slope.empty()) return {};
  return {modes_table(result, "Hub slope phi'(0) at modal mass I_T", "", modes.hub_slope),
          modes_table(result, "End-point value phi(l) at modal mass I_T", "m", modes.tip_value_m)};
}

Table sweep_events_table(const SweepResult& result, std::size_t most) {
  const auto& last = result.task.axes.back();
  Table table{"Events along the tracks", {{"roots"}, {"number"}, {"event"}, {"other"}}};
  const bool has_rows = result.task.axes.size() > 1;
  if (has_rows) {
    const auto& first = result.task.axes.front();
    table.columns.push_back({first.parameter.name, unit_of(first), kPlaceDigits});
  }
  table.columns.push_back({last.parameter.name + " from", unit_of(last), kPlaceDigits});
  table.columns.push_back({"to", unit_of(last), kPlaceDigits});
  for (const SweepEvent& event : result.events) {
    if (table.rows.size() == most) break;
    std::vector<Cell> row;
    row.reserve(table.columns.size());
    row.emplace_back(compare::label(event.family));
    row.push_back(count_if(event.track != compare::kNoTrack, event.track));
    row.emplace_back(std::string(word_for(event.kind)));
    row.push_back(count_if(event.other != compare::kNoTrack, event.other));
    if (has_rows) row.emplace_back(result.task.axes.front().values[event.row]);
    row.emplace_back(event.from_value);
    row.emplace_back(event.to_value);
    table.add_row(std::move(row));
  }
  return table;
}

Table sweep_agreement_table(const SweepResult& result) {
  Table table{"Largest difference from " + result.task.models.front().name,
              {{"quantity"}, {"model"}, error_column("largest difference")}};
  table.columns.push_back({"number"});
  for (std::size_t k = 0; k < result.task.axes.size(); ++k) {
    table.columns.push_back({place_column(result, k), unit_of(result.task.axes[k]), kPlaceDigits});
  }
  table.columns.push_back({"missing"});
  for (const auto& row : result.agreement) {
    const bool any = row.compared > 0;
    std::vector<Cell> cells;
    cells.reserve(table.columns.size());
    cells.emplace_back(row.quantity);
    cells.emplace_back(row.model);
    cells.emplace_back(any ? row.worst : NAN);
    cells.push_back(count_if(any, row.worst_number));
    for (std::size_t k = 0; k < result.task.axes.size(); ++k) {
      cells.emplace_back(any ? result.task.value(k, row.worst_point) : NAN);
    }
    cells.emplace_back(static_cast<std::int64_t>(row.missing));
    table.add_row(std::move(cells));
  }
  return table;
}

const compare::SweepAgreement* largest_sweep_difference(const SweepResult& result) {
  const compare::SweepAgreement* worst = nullptr;
  const auto severity = [](const compare::SweepAgreement& row) {
    return row.missing > 0 ? INFINITY : row.worst / row.tolerance;
  };
  for (const auto& row : result.agreement) {
    if (worst == nullptr || severity(row) > severity(*worst)) worst = &row;
  }
  return worst;
}

std::string sweep_verdict_line(const SweepResult& result) {
  const compare::SweepAgreement* worst = largest_sweep_difference(result);
  if (worst == nullptr) return "";
  if (worst->missing > 0) {
    return fmt::format("DISAGREE: {} by {}: {} of {} missing, the first at {}\n", worst->quantity,
                       worst->model, worst->missing, worst->missing + worst->compared,
                       result.task.describe(worst->first_missing_point));
  }
  return fmt::format(
      "{0}: largest relative difference {3:.2g} in {1} of {2} (tolerance {4:g}) at {5}\n",
      worst->agrees() ? "Agree" : "DISAGREE", worst->quantity, worst->model, worst->worst,
      worst->tolerance, result.task.describe(worst->worst_point));
}

}  // namespace flexarm::report
