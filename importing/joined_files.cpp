#include "importing/joined_files.hpp"

#include "arm/input_error.hpp"
#include "arm/read_word.hpp"
#include "importing/unit_contradictions.hpp"
#include "measured/files/column_lookup.hpp"
#include "measured/files/common_clock.hpp"
#include "measured/files/missing_signs.hpp"
#include "measured/files/time_record.hpp"
#include "measured/files/wrapped_angle.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <set>
#include <utility>

namespace flexarm::importing {

namespace {

using arm::InputError;
using measured::ColumnLabel;
using measured::ForeignColumn;
using measured::JoinGrid;
using measured::TimedSignals;

bool is_of_time(const std::string& typed) {
  return typed.starts_with("time=") || typed.starts_with("time ");
}

/// The column that holds the time of a file, and its unit.
measured::ColumnMapping time_of(const std::vector<ColumnLabel>& labels, const FileChoice& choice,
                                std::vector<std::string>& notes) {
  ColumnChoice of_time;
  for (const auto& typed : choice.columns.typed) {
    if (is_of_time(typed)) of_time.typed.push_back(typed);
  }
  of_time.time_unit = choice.columns.time_unit;
  auto guess = measured::guess_columns(labels, of_time.mappings(labels, notes));
  of_time.set_time_unit(guess.mappings);
  const auto time = guess.mappings.find("time");
  if (time != guess.mappings.end()) {
    std::ranges::move(unit_contradictions({*time}, labels), std::back_inserter(notes));
    return time->second;
  }
  throw InputError(
      fmt::format("time: column not recognised; columns: {}; each file that is joined needs one: "
                  "assign it with "
                  "--column time=NAME:UNIT",
                  measured::shown_names(measured::column_names(labels))));
}

void require_increasing(const std::vector<double>& times_s) {
  for (std::size_t k = 0; k < times_s.size(); ++k) {
    const bool is_fine = std::isfinite(times_s[k]) && (k == 0 || times_s[k] > times_s[k - 1]);
    if (is_fine) continue;
    throw InputError(
        fmt::format("time = {} s in row {}: --join needs times that increase from row "
                    "to row",
                    times_s[k], k + 1));
  }
  if (times_s.size() < 2) throw InputError("--join needs two samples or more");
}

/// Leaves out the rows of a file that have no time.
void leave_out_untimed(std::vector<ForeignColumn>& columns, std::size_t time_place,
                       const std::string& file, std::vector<std::string>& assumptions) {
  const std::vector<double> times = columns[time_place].values;
  const auto untimed = std::ranges::count_if(times, [](double time) { return std::isnan(time); });
  if (untimed == 0) return;
  assumptions.push_back(fmt::format("{}: {} of {} rows left out: column {} has no number", file,
                                    untimed, times.size(), arm::shown(columns[time_place].name)));
  for (auto& column : columns) {
    if (column.values.size() != times.size()) continue;
    std::vector<double> timed;
    for (std::size_t row = 0; row < times.size(); ++row) {
      if (!std::isnan(times[row])) timed.push_back(column.values[row]);
    }
    column.values = std::move(timed);
  }
}

/// A file as signals over its time in s.
TimedSignals timed_signals(ReadFile read, const FileChoice& choice,
                           std::vector<std::string>& assumptions) {
  auto& columns = read.contents.table.columns;
  const std::string name = arm::shown(read.file);
  try {
    if (choice.period_s && !columns.empty()) {
      const auto own = std::ranges::find_if(columns, measured::is_time_column);
      if (own != columns.end()) {
        throw InputError(fmt::format("--period: not for a file that is joined by its own times, {}",
                                     arm::shown(own->name)));
      }
      add_times(read.contents.table, *choice.period_s);
    }
    if (!read.contents.responses.empty() || columns.size() < 2) {
      throw InputError(
          "--join needs a time and a signal or more in each file; state the sampling period of "
          "files without times with --period");
    }
    const auto labels = measured::labels_of(read.contents.table);
    const auto mapping = time_of(labels, choice, assumptions);
    const std::size_t place = measured::column_place(labels, mapping.name).value();
    for (auto& column : columns) {
      const std::string note = measured::take_out_over_range(column, name);
      if (!note.empty()) assumptions.push_back(note);
    }
    leave_out_untimed(columns, place, name, assumptions);
    TimedSignals signals{
        name, std::move(columns[place].values), {}, columns[place].start, columns[place].is_stamp};
    const auto unit = measured::unit_of("time", mapping.unit).value_or(measured::Unit{});
    for (auto& time : signals.times_s) time = unit.to_si(time * mapping.scale);
    require_increasing(signals.times_s);
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (i == place || columns[i].is_text()) continue;
      if (columns[i].values.size() != signals.times_s.size()) {
        assumptions.push_back(fmt::format("{}: {} left out: not as long as the time", name,
                                          arm::shown(columns[i].name)));
        continue;
      }
      const std::string note = measured::unwrap(columns[i], columns[i].unit);
      if (!note.empty()) assumptions.push_back(fmt::format("{}: {}", name, note));
      signals.columns.push_back(std::move(columns[i]));
    }
    for (const auto& sentence : read.contents.table.assumptions) {
      assumptions.push_back(fmt::format("{}: {}", name, sentence));
    }
    assumptions.push_back(
        fmt::format("{}: time is column {} in {}", name, arm::shown(mapping.name), mapping.unit));
    return signals;
  } catch (const InputError& error) {
    if (std::string_view(error.what()).starts_with(name + ":")) throw;
    throw arm::located(error, name, 0);
  }
}

/// The columns that make the torque, which is held between samples.
std::set<std::string> torque_columns(const std::vector<TimedSignals>& files,
                                     const ColumnChoice& choice) {
  std::vector<ColumnLabel> labels = {{"time [s]", "s"}};
  for (const auto& file : files) {
    for (const auto& column : file.columns) labels.push_back({column.name, column.unit});
  }
  std::vector<std::string> notes;  // those of the joined table are the same
  const auto guess = measured::guess_columns(labels, choice.mappings(labels, notes));
  const auto torque = guess.mappings.find("torque");
  std::set<std::string> held;
  if (torque == guess.mappings.end()) return held;
  const std::vector<std::string> names = measured::column_names(labels);
  for (const auto place : measured::places_used({*torque}, names)) held.insert(names[place]);
  return held;
}

/// Whether a column of the torque is not 0 in front of the time that all files share.
bool torque_acts_before(const std::vector<TimedSignals>& files,
                        const std::set<std::string>& torque) {
  double from_s = -HUGE_VAL;
  for (const auto& file : files) from_s = std::max(from_s, file.times_s.front());
  for (const auto& file : files) {
    const double step_s = file.times_s[1] - file.times_s[0];
    const auto common =
        std::ranges::lower_bound(file.times_s, from_s - measured::kMostJitter_periods * step_s);
    for (const auto& column : file.columns) {
      if (!torque.contains(column.name)) continue;
      const auto& values = column.values;
      const bool acts =
          std::any_of(values.begin(), values.begin() + (common - file.times_s.begin()),
                      [](double value) { return !std::isnan(value) && value != 0.0; });
      if (acts) return true;
    }
  }
  return false;
}

}  // namespace

ImportedFile import_joined(const std::vector<std::string>& files, const FileChoice& choice,
                           const JoinChoice& join, measured::TorqueHold hold) {
  const auto grid = arm::read_word("--join-grid", join.grid,
                                   std::array{JoinGrid::same, JoinGrid::first, JoinGrid::coarsest});
  if (files.size() < 2) throw InputError("--join: needs two files or more");
  std::vector<TimedSignals> signals;
  std::vector<std::string> assumptions;
  std::vector<std::string> names;
  std::set<std::string> formats;
  for (const auto& file : files) {
    ReadFile read = read_file(file, choice);
    formats.insert(read.format);
    names.push_back(file);
    signals.push_back(timed_signals(std::move(read), choice, assumptions));
  }
  std::ranges::move(measured::put_on_one_clock(signals), std::back_inserter(assumptions));
  measured::name_joined_columns(signals);
  if (choice.period_s) {
    assumptions.push_back(fmt::format(
        "all files are taken to begin at one moment, with a sample every {} s, as --period states",
        *choice.period_s));
  }

  FileChoice of_joined = choice;
  std::erase_if(of_joined.columns.typed, is_of_time);
  of_joined.columns.time_unit.clear();
  of_joined.period_s.reset();
  const auto torque = torque_columns(signals, of_joined.columns);
  const bool is_driven = torque_acts_before(signals, torque);
  ReadFile joined{fmt::format("{}", fmt::join(names, " + ")),
                  fmt::format("{}, joined", fmt::join(formats, ", ")),
                  {}};
  joined.contents.table =
      measured::joined_table(std::move(signals), grid, [&](const std::string& column) {
        return hold == measured::TorqueHold::zero && torque.contains(column);
      });
  auto& said = joined.contents.table.assumptions;
  said.insert(said.begin(), std::make_move_iterator(assumptions.begin()),
              std::make_move_iterator(assumptions.end()));
  ImportedFile imported = import_file(std::move(joined), of_joined);
  imported.is_driven_before |= is_driven;
  return imported;
}

}  // namespace flexarm::importing
