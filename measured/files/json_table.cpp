#include "measured/files/json_table.hpp"

#include "arm/input_error.hpp"
#include "arm/number.hpp"
#include "measured/files/column_builder.hpp"
#include "measured/files/column_lookup.hpp"
#include "measured/files/column_name.hpp"
#include "measured/files/column_words.hpp"
#include "measured/files/json_reading.hpp"
#include "measured/files/json_signals.hpp"
#include "measured/files/json_times.hpp"
#include "measured/files/keyed_units.hpp"
#include "measured/files/record_constants.hpp"
#include "measured/files/signal_factors.hpp"
#include "measured/files/unit_spelling.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <utility>

namespace flexarm::measured {

namespace {

using arm::InputError;
using Json = nlohmann::ordered_json;
using std::string_view;

/// Objects within objects.
constexpr int kDeepestJson = 16;

bool is_scalar(const Json& value) {
  return value.is_number() || value.is_null() || value.is_string() || value.is_boolean();
}

bool is_list_of(const Json& list, bool (*is_one)(const Json&)) {
  return list.is_array() && !list.empty() && std::ranges::all_of(list, is_one);
}

bool is_object(const Json& value) {
  return value.is_object();
}

bool is_list(const Json& value) {
  return value.is_array();
}

/// Whether the keys are "0", "1", ...: the rows of a table of pandas.
bool is_by_row(const Json& object) {
  if (!object.is_object() || object.size() < 2) return false;
  std::size_t row = 0;
  for (const auto& [key, value] : object.items()) {
    if (key != std::to_string(row++)) return false;
  }
  return true;
}

/// An object of texts, or of such objects: units by list.
bool is_of_units(const Json& value) {
  return value.is_object() && std::ranges::all_of(value, [](const Json& unit) {
           return unit.is_string() || unit.is_null() || is_of_units(unit);
         });
}

/// Columns in the object of a unit without a key: those that hold values where there are several.
std::vector<ForeignColumn*> columns_beside(const KeyedUnit& unit,
                                           std::vector<ForeignColumn>& columns) {
  std::vector<ForeignColumn*> beside;
  std::vector<ForeignColumn*> holders;
  const std::string front = unit.path.empty() ? "" : unit.path + ".";
  for (auto& column : columns) {
    if (!column.name.starts_with(front) || column.name == front || column.is_text()) continue;
    beside.push_back(&column);
    if (is_holder(string_view(column.name).substr(front.size()))) holders.push_back(&column);
  }
  if (beside.size() < 2) return beside;
  if (!holders.empty()) return holders;
  if (!is_canonical_unit(canonical_unit(unit.text))) return {};
  throw InputError(
      fmt::format("{} = {}: stands beside several lists, {} and {}; write the unit of a list in "
                  "its name, \"hub_angle [deg]\", or as \"hub_angle_unit\"",
                  arm::shown(unit.place), arm::shown(unit.text), arm::shown(beside[0]->name),
                  arm::shown(beside[1]->name)));
}

void give_unit(ForeignColumn& column, const KeyedUnit& unit) {
  const std::string text = canonical_unit(unit.text);
  if (text.empty()) return;
  if (!column.unit.empty() && column.unit != text) {
    throw InputError(fmt::format("{} = {}: the unit of {} is {} already; must be the same",
                                 arm::shown(unit.place), arm::shown(unit.text),
                                 arm::shown(column.name), arm::shown(column.unit)));
  }
  column.unit = text;
}

/// Builds columns; a cell that a row does not have is empty.
class JsonTableBuilder {
 public:
  explicit JsonTableBuilder(JsonTable& out) : out_(out) {}

  void add(const Json& value, const std::string& path, int depth) {
    if (depth > kDeepestJson) throw InputError("objects within objects without end");
    if (is_list_of(value, is_object)) {
      add_rows(value, path);
    } else if (is_list_of(value, is_list)) {
      add_lists(value, path);
    } else if (is_list_of(value, is_scalar)) {
      add_column(path.empty() ? "column 1" : path, value);
    } else if (value.is_object()) {
      add_object(value, path, depth);
    } else {
      out_.left_out.push_back(fmt::format("{}: no list of numbers", path.empty() ? "file" : path));
    }
  }

  void finish() {
    if (columns_.size() > kMostRecordColumns) {
      throw InputError(
          fmt::format("{} columns; at most {} are read", columns_.size(), kMostRecordColumns));
    }
    auto& columns = out_.table.columns;
    for (auto& [name, cells] : columns_) {
      columns.push_back({name, split_column_name(name).unit, std::move(cells.values)});
    }
    read_texts();
    take_unit_columns();
    set_units();
    add_json_times(out_.table, numbers_, units_, out_.left_out);
  }

 private:
  struct Cells {
    std::vector<double> values;
    std::vector<std::string> texts;  ///< of those cells that are texts
    bool has_texts = false;          ///< that are no numbers
  };

  static std::string joined(const std::string& path, const std::string& key) {
    return path.empty() ? key : path + "." + key;
  }

  Cells& cells_of(const std::string& name) {
    const auto [place, is_new] = places_.emplace(name, columns_.size());
    if (is_new) columns_.emplace_back(name, Cells{});
    return columns_[place->second].second;
  }

  /// Puts a value into a row; texts that are numbers are numbers.
  static void put(Cells& cells, std::size_t row, const Json& value) {
    cells.values.resize(row, kUnknown);
    cells.texts.resize(row);
    double number = kUnknown;
    std::string text;
    if (value.is_number()) {
      number = value.get<double>();
    } else if (value.is_boolean()) {
      number = value.get<bool>() ? 1.0 : 0.0;
    } else if (value.is_string()) {
      text = value.get<std::string>();
      const auto read = arm::parse_number<double>(text);
      if (read) number = *read;
      cells.has_texts = cells.has_texts || (!read && !text.empty());
    }
    cells.values.push_back(number);
    cells.texts.push_back(std::move(text));
  }

  void put_fields(const Json& object, const std::string& path, std::size_t row, int depth) {
    if (depth > kDeepestJson) throw InputError("objects within objects without end");
    for (const auto& [key, value] : object.items()) {
      const std::string name = joined(path, key);
      if (is_scalar(value)) {
        put(cells_of(name), row, value);
      } else if (value.is_object()) {
        put_fields(value, name, row, depth + 1);
      } else {
        std::size_t i = 0;
        for (const auto& one : value) {
          if (is_scalar(one)) put(cells_of(fmt::format("{}({})", name, ++i)), row, one);
        }
      }
    }
  }

  /// A list of objects, one a row.
  void add_rows(const Json& list, const std::string& path) {
    const std::size_t before = columns_.size();
    std::size_t row = 0;
    for (const auto& object : list) put_fields(object, path, row++, 0);
    fill(before, row);
  }

  void fill(std::size_t first_column, std::size_t rows) {
    for (std::size_t i = first_column; i < columns_.size(); ++i) {
      columns_[i].second.values.resize(rows, kUnknown);
      columns_[i].second.texts.resize(rows);
    }
  }

  void add_column(const std::string& name, const Json& list) {
    Cells& cells = cells_of(name);
    cells = Cells{};
    std::size_t row = 0;
    for (const auto& value : list) put(cells, row++, value);
  }

  /// A list of rows, of which the first may hold the names.
  void add_lists(const Json& rows, const std::string& path) {
    const bool has_names = is_list_of(rows.front(), [](const Json& value) {
      return value.is_string() && !arm::parse_number<double>(value.get<std::string>());
    });
    std::vector<std::string> names;
    if (has_names) names = rows.front().get<std::vector<std::string>>();
    add_table(names, rows, has_names ? 1 : 0, path);
  }

  void add_table(const std::vector<std::string>& names, const Json& rows, std::size_t first,
                 const std::string& path) {
    const std::size_t before = columns_.size();
    for (std::size_t row = first; row < rows.size(); ++row) {
      std::size_t i = 0;
      for (const auto& value : rows[row]) {
        const std::string name = i < names.size() ? names[i] : fmt::format("column {}", i + 1);
        ++i;
        if (is_scalar(value)) put(cells_of(joined(path, name)), row - first, value);
      }
    }
    fill(before, rows.size() - first);
  }

  void add_object(const Json& object, const std::string& path, int depth) {
    const auto names = object.find("columns");
    const auto data = object.find("data");
    const bool is_split = names != object.end() && data != object.end() &&
                          is_list_of(*names, [](const Json& value) { return value.is_string(); }) &&
                          is_list_of(*data, is_list);
    if (is_split) {
      add_table(names->get<std::vector<std::string>>(), *data, 0, path);
      for (const auto& [key, value] : object.items()) {
        if (is_unit_key(key)) add_units(object, value, path, key);
      }
      return;
    }
    if (is_by_row(object)) {
      Json list = Json::array();
      for (const auto& [key, value] : object.items()) list.push_back(value);
      add(list, path, depth + 1);
      return;
    }
    for (const auto& [key, value] : object.items()) {
      if (is_unit_key(key) && add_units(object, value, path, key)) continue;
      if (value.is_array() || value.is_object()) {
        add(value, joined(path, key), depth + 1);
        continue;
      }
      singles_.push_back(joined(path, key));
      const auto list = list_of_unit_key(key);
      if (list && value.is_string()) {
        units_.push_back({path, *list, value.get<std::string>(), false, singles_.back()});
      } else {
        out_.left_out.push_back(fmt::format("{}: a single value", singles_.back()));
        if (value.is_string()) {
          numbers_.push_back({key, value.get<std::string>(), out_.left_out.back()});
        } else if (value.is_number()) {
          numbers_.push_back({key, fmt::format("{}", value.get<double>()), out_.left_out.back()});
          // Settings of named signals stand in an object of their own.
          const bool is_beside =
              path.ends_with(" settings") || std::ranges::any_of(object, is_list);
          const std::string sentence = unapplied_factor(singles_.back(), value.get<double>());
          if (is_beside && !sentence.empty()) out_.table.assumptions.push_back(sentence);
        }
      }
    }
  }

  /// The units under `key`, an object of texts by list or a list of texts, one a list; false for
  /// anything else.
  bool add_units(const Json& object, const Json& units, const std::string& path,
                 const std::string& key) {
    if (is_of_units(units)) {
      add_units_of(units, joined(path, key));
      return true;
    }
    if (!is_list_of(units, [](const Json& unit) { return unit.is_string() || unit.is_null(); })) {
      return false;
    }
    std::vector<std::string> lists;
    if (const auto names = object.find("columns"); names != object.end()) {
      for (const auto& name : *names)
        lists.push_back(name.is_string() ? name.get<std::string>() : "");
    } else {
      for (const auto& [name, value] : object.items()) {
        if (value.is_array() && name != key) lists.push_back(name);
      }
    }
    if (lists.size() != units.size()) {
      throw InputError(fmt::format("{}: {} units; must be one for each of the {} lists",
                                   arm::shown(joined(path, key)), units.size(), lists.size()));
    }
    for (std::size_t i = 0; i < lists.size(); ++i) {
      if (!units[i].is_string()) continue;
      units_.push_back({path, lists[i], units[i].get<std::string>(), true,
                        fmt::format("{}({})", joined(path, key), i + 1)});
    }
    return true;
  }

  void add_units_of(const Json& units, const std::string& place) {
    for (const auto& [key, value] : units.items()) {
      const std::string own_place = joined(place, key);
      if (value.is_string()) units_.push_back(keyed_unit(own_place, value.get<std::string>()));
      if (value.is_object()) add_units_of(value, own_place);
    }
  }

  /// Reads columns with texts as those of a delimited text: signs of a missing number, time stamps.
  void read_texts() {
    std::map<std::size_t, std::vector<std::size_t>> places_by_rows;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (!columns_[i].second.has_texts) continue;
      places_by_rows[columns_[i].second.texts.size()].push_back(i);
    }
    auto& columns = out_.table.columns;
    for (const auto& [rows, places] : places_by_rows) {
      std::vector<ForeignColumn> heads;
      for (const auto place : places)
        heads.push_back({columns[place].name, columns[place].unit, {}});
      ColumnBuilder builder(std::move(heads), '.');
      for (std::size_t row = 0; row < rows; ++row) add_text_row(builder, places, row);
      ForeignTable read = builder.finish();
      for (std::size_t i = 0; i < read.columns.size(); ++i) {
        // Imaginary parts stand behind the others.
        auto& column = i < places.size() ? columns[places[i]] : columns.emplace_back();
        column = std::move(read.columns[i]);
      }
      std::ranges::move(read.assumptions, std::back_inserter(out_.table.assumptions));
    }
  }

  void add_text_row(ColumnBuilder& builder, const std::vector<std::size_t>& places,
                    std::size_t row) {
    std::vector<std::string> numbers(places.size());
    std::vector<string_view> cells;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const std::string& text = columns_[places[i]].second.texts[row];
      const double value = out_.table.columns[places[i]].values[row];
      if (text.empty() && !std::isnan(value)) numbers[i] = fmt::format("{}", value);
      cells.push_back(text.empty() ? string_view(numbers[i]) : string_view(text));
    }
    try {
      builder.add_row(cells, static_cast<int>(row) + 1);
    } catch (const InputError& error) {
      throw InputError(fmt::format("sample {}: {}", row + 1, error.what()));
    }
  }

  void set_units() {
    auto& columns = out_.table.columns;
    KeyedUnits keyed;
    for (const auto& unit : units_) {
      keyed.add(unit);
      if (!unit.key.empty() || unit.text.empty()) continue;
      for (ForeignColumn* column : columns_beside(unit, columns)) give_unit(*column, unit);
    }
    std::vector<std::string> names = column_names(columns);
    names.insert(names.end(), singles_.begin(), singles_.end());
    keyed.place(names, "list");
    for (auto& column : columns) {
      if (const auto* unit = keyed.find(column.name)) give_unit(column, *unit);
    }
  }

  /// Columns that repeat a unit in each sample, "hub_angle.unit", are units and no columns.
  void take_unit_columns() {
    std::erase_if(out_.table.columns, [&](const ForeignColumn& column) {
      const auto point = column.name.rfind('.');
      const std::string path = point == std::string::npos ? "" : column.name.substr(0, point);
      const auto list = list_of_unit_key(string_view(column.name).substr(point + 1));
      const auto& texts = column.texts;
      const bool is_unit =
          list && column.is_text() &&
          std::ranges::adjacent_find(texts, std::ranges::not_equal_to()) == texts.end();
      if (is_unit) units_.push_back({path, *list, texts.front(), false, column.name});
      return is_unit;
    });
  }

  JsonTable& out_;
  std::vector<std::pair<std::string, Cells>> columns_;
  std::map<std::string, std::size_t> places_;
  std::vector<KeyedUnit> units_;
  std::vector<std::string> singles_;  ///< names of single values
  std::vector<JsonNumber> numbers_;   ///< single ones, and texts
};

}  // namespace

bool is_json(string_view bytes) {
  const auto first = bytes.find_first_not_of(" \t\r\n");
  if (first == string_view::npos || (bytes[first] != '{' && bytes[first] != '[')) return false;
  // "[s] [N m]" begins a line of units, "[[run]]" a table of TOML.
  const auto next = bytes.find_first_not_of("[ \t\r\n", first + (bytes[first] == '{' ? 1 : 0));
  if (next == string_view::npos) return false;
  const string_view rest = bytes.substr(next);
  if (bytes[first] == '{') return rest.front() == '"' || rest.front() == '}';
  constexpr string_view kFirst = "{\"]-0123456789";
  return kFirst.find(rest.front()) != string_view::npos || rest.starts_with("null") ||
         rest.starts_with("NaN");
}

JsonTable parse_json_table(string_view text, const std::string& file_name) {
  JsonTable table;
  try {
    JsonTableBuilder builder(table);
    builder.add(with_lists_of_signals(parsed_json(text)), "", 0);
    builder.finish();
    if (table.table.columns.empty()) {
      throw InputError(
          "JSON without lists of numbers; must be a list of objects, one a sample, or an object of "
          "lists");
    }
  } catch (const InputError& error) {
    throw arm::located(error, file_name, 0);
  }
  return table;
}

}  // namespace flexarm::measured
