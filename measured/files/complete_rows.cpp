#include "measured/files/complete_rows.hpp"

#include "arm/input_error.hpp"
#include "measured/files/column_lookup.hpp"
#include "measured/files/missing_signs.hpp"
#include "measured/files/record_constants.hpp"
#include "measured/files/time_grid.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

namespace flexarm::measured {

namespace {

using arm::InputError;

/// A column that is used, and for what.
struct UsedColumn {
  std::size_t place = 0;
  std::string quantity;
};

/// Each used column once, the first quantity that takes it.
std::vector<UsedColumn> used_columns(const ForeignTable& table, const ColumnMappings& mappings,
                                     const ColumnMapping* reference) {
  const std::vector<std::string> names = column_names(table.columns);
  std::vector<UsedColumn> used;
  const auto add = [&](std::size_t place, const std::string& quantity) {
    if (std::ranges::count(used, place, &UsedColumn::place) > 0) return;
    used.push_back({place, quantity});
  };
  for (const auto& entry : mappings) {
    for (const auto place : places_used({entry}, names)) add(place, entry.first);
  }
  if (reference != nullptr) {
    const std::string name(kReferenceColumn);
    for (const auto place : places_used({{name, *reference}}, names)) add(place, name);
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    const ColumnMappings standard = mapping_by_header(table.columns[i], mappings);
    if (!standard.empty()) add(i, standard.begin()->first);
  }
  std::erase_if(used,
                [&](const UsedColumn& column) { return table.columns[column.place].is_text(); });
  return used;
}

class RowKeeper {
 public:
  RowKeeper(ForeignTable& table, const ColumnMappings& mappings, const ColumnMapping* reference,
            const OwnRates& own_rates)
      : table_(table), own_rates_(own_rates), used_(used_columns(table, mappings, reference)) {}

  CompleteRows keep() {
    for (const auto& used : used_) {
      const std::string note = take_out_over_range(table_.columns[used.place], used.quantity);
      if (!note.empty()) kept_.notes.push_back(note);
    }
    for (const auto& column : used_) require_numbers(column);
    for (const auto& used : used_) {
      const ForeignColumn& column = table_.columns[used.place];
      std::ranges::move(doubtful_signs(column.values, column.name, used.quantity),
                        std::back_inserter(kept_.warnings));
    }
    require_known_rates();
    if (used_.empty() || !are_of_one_length()) return {};
    kept_.rows_in_file = values_of(used_.front()).size();
    find_any();
    for (const auto& column : used_) treat_own_rate(column);
    find_complete();
    if (kept_.rows.size() < kept_.rows_in_file) find_period();
    leave_out();
    return std::move(kept_);
  }

 private:
  std::vector<double>& values_of(const UsedColumn& column) {
    return table_.columns[column.place].values;
  }

  void require_numbers(const UsedColumn& used) {
    const ForeignColumn& column = table_.columns[used.place];
    if (!column.values.empty() && !column.holds_nothing()) return;
    throw InputError(fmt::format("{}: column {} has no number in any row; take another one",
                                 used.quantity, arm::shown(column.name)));
  }

  void require_known_rates() {
    for (const auto& [quantity, between] : own_rates_) {
      if (std::ranges::count(used_, quantity, &UsedColumn::quantity) > 0) continue;
      std::vector<std::string> names;
      for (const auto& column : used_) names.push_back(column.quantity);
      throw InputError(
          fmt::format("--own-rate {}: no column of the file is this; those read are {}", quantity,
                      fmt::join(names, ", ")));
    }
  }

  /// A fault that is told where the record is made.
  bool are_of_one_length() {
    const std::size_t rows = values_of(used_.front()).size();
    return std::ranges::all_of(
        used_, [&](const UsedColumn& column) { return values_of(column).size() == rows; });
  }

  /// The rows that have a number beside the time.
  void find_any() {
    for (std::size_t row = 0; row < kept_.rows_in_file; ++row) {
      const bool has_any = std::ranges::any_of(used_, [&](const UsedColumn& column) {
        return column.quantity != kTime && !std::isnan(values_of(column)[row]);
      });
      if (has_any) any_.push_back(row);
    }
  }

  /// The median distance of the column's numbers, in the rows that have any.
  std::size_t median_step(const std::vector<double>& values) const {
    std::vector<std::size_t> steps;
    std::size_t last = any_.size();
    for (std::size_t i = 0; i < any_.size(); ++i) {
      if (std::isnan(values[any_[i]])) continue;
      if (last < any_.size()) steps.push_back(i - last);
      last = i;
    }
    if (steps.empty()) return any_.size();
    const auto middle = steps.begin() + static_cast<std::ptrdiff_t>((steps.size() - 1) / 2);
    std::nth_element(steps.begin(), middle, steps.end());
    return *middle;
  }

  void treat_own_rate(const UsedColumn& column) {
    if (column.quantity == kTime) return;
    std::vector<double>& values = values_of(column);
    const auto stated = own_rates_.find(column.quantity);
    const std::size_t step = median_step(values);
    const std::string name = arm::shown(table_.columns[column.place].name);
    if (stated == own_rates_.end()) {
      if (step < 2) return;
      throw InputError(fmt::format(
          "{0}: column {1} has a number in one of {2} rows alone, written at its own rate; state "
          "what stands between with --own-rate {0}=hold (the number above), {0}=linear, or "
          "{0}=rows (only the rows that have all numbers)",
          column.quantity, name, step));
    }
    if (stated->second == Between::rows) return;
    if (stated->second == Between::hold) {
      hold(values);
    } else {
      interpolate(values);
    }
    kept_.notes.push_back(fmt::format(
        "{}: the empty cells of column {} {}", column.quantity, name,
        stated->second == Between::hold ? "hold the number above" : "are interpolated over time"));
  }

  static void hold(std::vector<double>& values) {
    for (std::size_t row = 1; row < values.size(); ++row) {
      if (std::isnan(values[row])) values[row] = values[row - 1];
    }
  }

  /// Over the column of the times, or the rows where the times are computed.
  void interpolate(std::vector<double>& values) {
    const auto time = std::ranges::find(used_, kTime, &UsedColumn::quantity);
    const std::vector<double>* times = time == used_.end() ? nullptr : &values_of(*time);
    const auto at = [&](std::size_t row) {
      return times == nullptr ? static_cast<double>(row) : (*times)[row];
    };
    std::size_t last = values.size();
    for (std::size_t row = 0; row < values.size(); ++row) {
      if (std::isnan(values[row]) || std::isnan(at(row))) continue;
      for (std::size_t k = last + 1; last < values.size() && k < row; ++k) {
        values[k] = std::lerp(values[last], values[row], (at(k) - at(last)) / (at(row) - at(last)));
      }
      last = row;
    }
  }

  bool is_complete(std::size_t row) {
    return std::ranges::none_of(
        used_, [&](const UsedColumn& column) { return std::isnan(values_of(column)[row]); });
  }

  void find_complete() {
    for (std::size_t row = 0; row < kept_.rows_in_file; ++row) {
      if (is_complete(row)) kept_.rows.push_back(row);
    }
    if (kept_.rows.empty()) {
      throw InputError(
          fmt::format("no row has a number in each of the columns {}", shown_names(used_names())));
    }
    const std::size_t incomplete = kept_.rows_in_file - kept_.rows.size();
    if (incomplete == 0) return;
    std::size_t first = 0;
    while (first < kept_.rows.size() && kept_.rows[first] == first) ++first;
    kept_.notes.push_back(fmt::format(
        "{} of {} rows left out, as missing samples: a cell is empty or no number (first of {} {})",
        incomplete, kept_.rows_in_file, missing_in(first),
        table_.line_of_row.empty() ? fmt::format("in row {}", first + 1)
                                   : fmt::format("in line {}", line_of(table_, first))));
    for (const auto& column : used_) {
      if (column.quantity != kTorque) continue;
      const auto& values = values_of(column);
      for (std::size_t row = 0; row < kept_.rows.front(); ++row) {
        kept_.is_driven_before |= !std::isnan(values[row]) && values[row] != 0.0;
      }
    }
  }

  /// Of rows that are chosen by --own-rate QUANTITY=rows the grid is their own.
  void find_period() {
    const bool are_chosen = std::ranges::any_of(
        own_rates_, [](const auto& entry) { return entry.second == Between::rows; });
    if (are_chosen) return;
    const auto time = std::ranges::find(used_, kTime, &UsedColumn::quantity);
    if (time == used_.end()) return;
    const std::vector<double>& all = values_of(*time);
    std::vector<double> times;
    for (const auto row : any_) times.push_back(all[row]);
    for (const auto& grid : {times, all}) {
      const bool is_even = grid.size() >= 2 &&
                           std::ranges::all_of(grid, [](double t) { return std::isfinite(t); }) &&
                           !grid_fault(grid);
      if (!is_even) continue;
      kept_.period = (grid.back() - grid.front()) / static_cast<double>(grid.size() - 1);
      return;
    }
  }

  std::vector<std::string> used_names() const {
    std::vector<std::string> names;
    for (const auto& column : used_) names.push_back(table_.columns[column.place].name);
    return names;
  }

  std::string missing_in(std::size_t row) {
    for (const auto& column : used_) {
      if (std::isnan(values_of(column)[row])) return arm::shown(table_.columns[column.place].name);
    }
    return "";
  }

  void leave_out() {
    if (kept_.rows.size() == kept_.rows_in_file) return;
    const auto thin = [&](auto& entries) {
      if (entries.size() != kept_.rows_in_file) return;
      for (std::size_t k = 0; k < kept_.rows.size(); ++k) {
        entries[k] = std::move(entries[kept_.rows[k]]);
      }
      entries.resize(kept_.rows.size());
    };
    for (auto& column : table_.columns) {
      thin(column.values);
      thin(column.texts);
    }
    thin(table_.line_of_row);
  }

  ForeignTable& table_;
  const OwnRates& own_rates_;
  std::vector<UsedColumn> used_;
  std::vector<std::size_t> any_;
  CompleteRows kept_;
};

}  // namespace

CompleteRows keep_complete_rows(ForeignTable& table, const ColumnMappings& mappings,
                                const ColumnMapping* reference, const OwnRates& own_rates) {
  return RowKeeper(table, mappings, reference, own_rates).keep();
}

}  // namespace flexarm::measured
