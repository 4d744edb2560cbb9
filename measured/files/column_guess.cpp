#include "measured/files/column_guess.hpp"

#include "arm/ascii.hpp"
#include "arm/input_error.hpp"
#include "arm/number.hpp"
#include "measured/files/column_lookup.hpp"
#include "measured/files/column_name.hpp"
#include "measured/files/column_words.hpp"
#include "measured/files/name_change.hpp"
#include "measured/files/unit_spelling.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>

namespace flexarm::measured {

namespace {

using std::string_view;

/// A column that may be a quantity.
struct ColumnCandidate {
  std::string quantity;
  std::size_t column = 0;
  bool is_standard = false;  ///< by its standard name
  bool is_by_unit = false;   ///< by a word that needs its unit
  bool is_unnamed = false;   ///< by its unit alone
};

/// "strain@0.05" of "strain@50mm", "strain@0.05m" and "strain@0,05"; any other name as it is.
std::string with_place_in_metres(string_view base) {
  constexpr string_view kGauge = "strain@";
  if (!base.starts_with(kGauge)) return std::string(base);
  std::string place(base.substr(kGauge.size()));
  std::ranges::replace(place, ',', '.');
  const std::size_t end = std::min(place.find_first_not_of("0123456789."), place.size());
  const auto number = arm::parse_number<double>(string_view(place).substr(0, end));
  const auto metres = conversion_of("tip_displacement", string_view(place).substr(end));
  if (!number || !metres) return std::string(base);
  return fmt::format("{}{:.12g}", kGauge, *number * *metres);
}

std::optional<std::string> standard(string_view base) {
  try {
    return standard_name(with_place_in_metres(base));
  } catch (const arm::InputError&) {
    return std::nullopt;
  }
}

/// Whether it is a gauge far from the hub, by a number without a unit.
bool is_place_unclear(string_view base) {
  const auto quantity = standard(base);
  return quantity && is_doubtful_place(*quantity) && arm::is_digit(base.back());
}

/// Returns the change that the name of a column makes of its quantity; none for x2 alone.
std::optional<NameChange> change_of(const ColumnLabel& label) {
  const ColumnName name = split_column_name(label.name);
  auto change = change_in(name.base);
  if (!change) change = change_in(quantity_name(label.name));
  if (!change && !is_canonical_unit(name.unit)) change = change_in(label.name);  // abs(theta)
  if (change && change->rest.empty()) change.reset();
  return change;
}

/// Whether a name is a standard one or a word for a quantity.
bool names_quantity(string_view name) {
  const std::string base = quantity_name(name);
  const std::string letters = plain_letters(base);
  return standard(base).has_value() ||
         std::ranges::any_of(quantity_words(), [&](const QuantityWords& entry) {
           return std::ranges::count(entry.words, string_view(letters)) > 0;
         });
}

/// Whether the column is the first derivative of the angle, by its name and its unit.
bool is_velocity(const NameChange& change, const ColumnLabel& label) {
  if (change.kind != ChangeKind::derivative || label.unit.empty()) return false;
  const std::string base = quantity_name(change.rest);
  const auto& angle = *std::ranges::find(quantity_words(), "hub_angle", &QuantityWords::quantity);
  const bool is_of_angle = standard(base) == "hub_angle" ||
                           std::ranges::count(angle.words, string_view(plain_letters(base))) > 0;
  return is_of_angle && is_unit_of("hub_velocity", label.unit);
}

std::vector<ColumnCandidate> candidates_for(const ColumnLabel& label, std::size_t column) {
  if (const auto change = change_of(label)) {
    if (is_velocity(*change, label)) return {{"hub_velocity", column}};
    return {};
  }
  const std::string base = quantity_name(label.name);
  if (const auto quantity = standard(base)) {
    const bool is_read = is_unit_of(*quantity, label.unit) && !is_place_unclear(base);
    if (is_read) return {{*quantity, column, true}};
    return {};
  }
  std::vector<ColumnCandidate> found;
  const std::string letters = plain_letters(base);
  for (const auto& [quantity, words, needs_unit] : quantity_words()) {
    if (std::ranges::count(words, letters) == 0) continue;
    if (is_unit_of(quantity, label.unit) && !(needs_unit && label.unit.empty())) {
      found.push_back({std::string(quantity), column, false, needs_unit});
    }
  }
  return found;
}

/// The number of a second column or a later one, "2" of "angle 2"; empty for any other name.
std::string later_number(const ColumnLabel& label) {
  const std::string base = quantity_name(label.name);
  const auto last = base.find_last_of("0123456789");
  if (last == std::string::npos || base.starts_with("strain@")) return "";
  const auto first = base.find_last_not_of("0123456789", last) + 1;  // 0 where all are digits
  const std::string number = base.substr(first, last + 1 - first);
  return arm::parse_number<int>(number).value_or(2) < 2 ? "" : number;
}

/// Returns the question about a column whose name changes a quantity.
ColumnQuestion question_of_change(const ColumnLabel& label, const NameChange& change,
                                  string_view quantity) {
  const std::string name = arm::shown(split_column_name(label.name).base);
  const std::string mark = arm::shown(change.mark);
  const std::string unit = label.unit.empty() ? "UNIT" : arm::shown(label.unit);
  std::string sentence =
      fmt::format("{} may be {}, but its name has {}; ", arm::shown(label.name), quantity, mark);
  switch (change.kind) {
    case ChangeKind::factor:
      sentence += fmt::format(
          "state its numbers with --column '{0}={1}:UNIT:SCALE', SCALE 1/100 where they are 100 "
          "times {0}",
          quantity, name);
      break;
    case ChangeKind::sign:
      sentence += fmt::format(
          "state it with --column '{0}={1}:{2}:-1', without -1 where its numbers are {0} itself",
          quantity, name, unit);
      break;
    case ChangeKind::reference:
      sentence += fmt::format(
          "it may be a reference; state it with --reference '{1}', or with --column '{0}={1}:{2}' "
          "where it was measured",
          quantity, name, unit);
      break;
    case ChangeKind::derivative:
    case ChangeKind::number:
    case ChangeKind::function:
      sentence += fmt::format(
          "state it with --column 'QUANTITY={1}:UNIT', or compute it with --compute "
          "'{0}=EXPRESSION'",
          quantity, name);
      break;
  }
  return {label.name, std::move(sentence), quantity == "torque"};
}

/// What is to be asked about a column whose name tells something, but not enough; nothing where
/// it tells nothing.
std::optional<ColumnQuestion> question_about(const ColumnLabel& label) {
  const auto change = change_of(label);
  const std::string base = quantity_name(change ? change->rest : label.name);
  const std::string letters = plain_letters(base);
  const std::string name = arm::shown(split_column_name(label.name).base);
  const std::string column = arm::shown(label.name);
  if (const auto quantity = standard(base); change && quantity) {
    return question_of_change(label, *change, *quantity);
  }
  if (is_place_unclear(base)) {
    return ColumnQuestion{
        label.name,
        fmt::format("{} may be a strain at a place in mm; state it with --column 'strain@X={}', X "
                    "in m from the hub",
                    column, name)};
  }
  for (const auto& open : open_words()) {
    const bool is_of_unit =
        label.unit.empty() || std::ranges::count(open.units, string_view(label.unit)) > 0;
    if (std::ranges::count(open.words, letters) == 0 || !is_of_unit) continue;
    return ColumnQuestion{label.name,
                          fmt::format("{} may be {}; state it with {}", column, open.meaning,
                                      fmt::format(fmt::runtime(open.option), name)),
                          open.may_be_torque};
  }
  for (const auto& [quantity, words, needs_unit] : quantity_words()) {
    if (std::ranges::count(words, letters) == 0) continue;
    if (change) return question_of_change(label, *change, quantity);
    if (is_unit_of(quantity, label.unit)) continue;
    return ColumnQuestion{
        label.name,
        fmt::format("{} may be {}, but {} is no unit of it; state it with --column "
                    "'{}={}:UNIT:SCALE'",
                    column, quantity, arm::shown(label.unit), quantity, name),
        quantity == "torque"};
  }
  return std::nullopt;
}

/// The word or the mark by which a column in a unit of torque is not that of the motor; empty
/// without one. A number behind a name that tells nothing is one of a part or a date.
std::string not_motor_torque(const ColumnLabel& label) {
  if (const auto change = change_of(label)) {
    if (change->kind != ChangeKind::number || names_quantity(change->rest)) return change->mark;
  }
  return other_torque_word(label.name);
}

/// Returns the question about a column in a unit of torque that is another one by its name.
std::optional<ColumnQuestion> question_about_torque(const ColumnLabel& label) {
  if (label.unit.empty() || !is_unit_of("torque", label.unit)) return std::nullopt;
  const std::string word = not_motor_torque(label);
  if (word.empty()) return std::nullopt;
  return ColumnQuestion{
      label.name,
      fmt::format("{} may be torque, but its name has {}; if it is the torque on the hub, state it "
                  "with --column 'torque={}:{}'",
                  arm::shown(label.name), arm::shown(word),
                  arm::shown(split_column_name(label.name).base), arm::shown(label.unit)),
      true};
}

/// The columns in a unit that nothing else has: a time, or a torque.
std::vector<ColumnCandidate> by_unit(std::span<const ColumnLabel> columns,
                                     const std::string& quantity) {
  std::vector<ColumnCandidate> found;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i].is_text || columns[i].unit.empty()) continue;
    if (!is_unit_of(quantity, columns[i].unit)) continue;
    const bool is_other = quantity == "torque" ? !not_motor_torque(columns[i]).empty()
                                               : change_of(columns[i]).has_value();
    if (!is_other) found.push_back({.quantity = quantity, .column = i, .is_unnamed = true});
  }
  return found;
}

}  // namespace

std::string quantity_name(string_view name) {
  std::string base = split_column_name(name).base;
  for (auto point = base.rfind('.'); point != std::string::npos; point = base.rfind('.')) {
    // Neither "Beschl." nor "max. Moment" is a structure.
    if (point + 1 >= base.size() || base[point + 1] == ' ' || standard(base)) return base;
    if (!is_holder(string_view(base).substr(point + 1))) return base.substr(point + 1);
    base.resize(point);
  }
  return base;
}

std::optional<std::size_t> column_place(std::span<const ColumnLabel> columns, string_view typed) {
  const auto by_path = std::ranges::find(columns, typed, &ColumnLabel::path);
  if (by_path != columns.end() && !typed.empty()) {
    return static_cast<std::size_t>(by_path - columns.begin());
  }
  return column_place(column_names(columns), typed);
}

std::vector<ColumnLabel> labels_of(const ForeignTable& table) {
  std::vector<ColumnLabel> labels;
  for (const auto& column : table.columns) {
    const bool is_no_quantity = column.is_text() || column.holds_nothing() || column.is_left_out;
    labels.push_back({column.name, column.unit, is_no_quantity, column.is_stamp, column.path});
  }
  return labels;
}

ColumnGuess guess_columns(std::span<const ColumnLabel> columns, const ColumnMappings& given) {
  ColumnGuess guess;
  guess.mappings = given;
  const std::vector<std::string> names = column_names(columns);
  std::vector<bool> is_given(columns.size(), false);
  for (const auto& [quantity, mapping] : given) {
    if (!mapping.expression.empty()) continue;
    if (const auto place = column_place(names, mapping.name)) is_given[*place] = true;
  }
  std::map<std::string, std::vector<ColumnCandidate>> by_quantity;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (is_given[i] || columns[i].is_text) continue;
    for (auto& candidate : candidates_for(columns[i], i)) {
      by_quantity[candidate.quantity].push_back(std::move(candidate));
    }
  }
  for (const char* quantity : {"time", "torque"}) {
    auto& found = by_quantity[quantity];
    if (found.empty()) found = by_unit(columns, quantity);
    std::erase_if(found, [&](const ColumnCandidate& entry) { return is_given[entry.column]; });
    const auto is_stamp = [&](const ColumnCandidate& entry) {
      return columns[entry.column].is_stamp;
    };
    if (!std::ranges::all_of(found, is_stamp)) std::erase_if(found, is_stamp);
  }
  for (auto& [quantity, found] : by_quantity) {
    if (given.contains(quantity) || found.empty()) continue;
    if (std::ranges::count(found, true, &ColumnCandidate::is_standard) > 0) {
      std::erase_if(found, [](const ColumnCandidate& entry) { return !entry.is_standard; });
    }
    const auto is_sure = [&](const ColumnCandidate& entry) {
      return !entry.is_by_unit && later_number(columns[entry.column]).empty();
    };
    if (std::ranges::any_of(found, is_sure)) {
      std::erase_if(found, &ColumnCandidate::is_by_unit);
    }
    if (found.size() > 1) {
      std::vector<std::string> alike;
      for (const auto& entry : found) alike.push_back(columns[entry.column].name);
      guess.notes.push_back(
          fmt::format("{}: ambiguous ({}); choose with --column {}=NAME", quantity,
                      arm::shown(fmt::format("{}", fmt::join(alike, " or ")), 400), quantity));
      guess.ambiguous[quantity] = alike;
      continue;
    }
    const ColumnLabel& label = columns[found.front().column];
    const std::string si_unit(si_unit_of(quantity));
    if (label.unit.empty()) {
      guess.notes.push_back(
          fmt::format("unit of {} not given; {} assumed", arm::shown(label.name), si_unit));
    }
    if (quantity == "torque" && found.front().is_unnamed) {
      guess.warnings.push_back(fmt::format(
          "{0} is taken as torque by its unit alone; state the torque on the hub with --column "
          "'torque={1}', if this is it, or another column, or --torque EXPRESSION",
          arm::shown(label.name), arm::shown(split_column_name(label.name).base)));
    }
    const bool is_by_word = !found.front().is_standard && !found.front().is_unnamed;
    const std::string number = is_by_word && quantity != "time" ? later_number(label) : "";
    if (!number.empty()) {
      guess.warnings.push_back(
          fmt::format("{0} is taken as {1}, but its name has the number {2}; state {1} with "
                      "--column '{1}={3}', "
                      "if this is it, or another column",
                      arm::shown(label.name), quantity, number,
                      arm::shown(split_column_name(label.name).base)));
    }
    guess.mappings[quantity] = {label.name, label.unit.empty() ? si_unit : label.unit,
                                scale_of_unit(quantity, label.unit)};
  }
  const auto used = places_used(guess.mappings, names);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i].is_text || std::ranges::count(used, i) > 0) continue;
    auto question = question_about(columns[i]);
    if (!question) question = question_about_torque(columns[i]);
    if (question) guess.questions.push_back(std::move(*question));
  }
  return guess;
}

}  // namespace flexarm::measured
