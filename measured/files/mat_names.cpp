#include "measured/files/mat_names.hpp"

#include "arm/input_error.hpp"
#include "arm/number.hpp"
#include "measured/files/column_name.hpp"
#include "measured/files/delimited_line.hpp"
#include "measured/files/mat_levels.hpp"
#include "measured/files/unit_spelling.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace flexarm::measured {

namespace {

using std::string_view;

constexpr std::array<string_view, 4> kLabelFields = {"label", "name", "signalname", "title"};
constexpr std::array<string_view, 2> kUnitFields = {"unit", "units"};
constexpr std::array<string_view, 2> kFrequencyUnitFields = {"frequencyunit", "frequencyunits"};
/// Fields of Simulink's and MATLAB's structures that are numbers and no signals.
constexpr std::array<string_view, 3> kDescriptions = {"dimensions", "valuedimensions", "plotstyle"};
constexpr std::array<string_view, 5> kHertzNames = {"f", "freq", "freqs", "frequency", "hz"};
constexpr std::array<string_view, 5> kRadianNames = {"w", "wout", "omega", "freq_rad", "w_rad"};
constexpr std::array<string_view, 4> kTimeFields = {"time", "t", "tout", "timestamps"};
/// Segments of the path of a block that say nothing of the signal.
constexpr std::array<string_view, 5> kPorts = {"out", "in", "value", "output", "signal"};

/// "units", "channelUnits", "Einheiten".
bool names_units(string_view path) {
  const std::string field = mat_field(path);
  return field.ends_with("unit") || field.ends_with("units") || field.ends_with("einheiten") ||
         field.ends_with("unites");
}

/// The number of signals in a matrix, 1 of any other variable.
std::size_t signals_in(const MatVariable& variable) {
  const auto count = [](const auto& value) -> std::size_t {
    if constexpr (requires { value.columns; }) return std::min(value.rows, value.columns);
    return 1;
  };
  return std::visit(count, variable.value);
}

/// Whether a text is by its field a label or the unit of frequencies.
bool tells_other(string_view path) {
  const std::string field = mat_field(path);
  return std::ranges::count(kLabelFields, field) > 0 ||
         std::ranges::count(kFrequencyUnitFields, field) > 0;
}

bool is_time_field(string_view path) {
  return std::ranges::count(kTimeFields, string_view(mat_field(path))) > 0;
}

/// "c" and "2" of "c{2}".
std::optional<std::pair<string_view, string_view>> split_cell(string_view path) {
  const auto brace = path.rfind('{');
  if (!path.ends_with('}') || brace == string_view::npos) return std::nullopt;
  return std::pair{path.substr(0, brace), path.substr(brace + 1, path.size() - brace - 2)};
}

/// "torque" of "\"torque\"" and "<torque>".
string_view without_quotes(string_view text) {
  text = trimmed(text);
  const auto is_within = [&](char open, char close) {
    return text.size() >= 2 && text.front() == open && text.back() == close &&
           text.substr(1, text.size() - 2).find(close) == string_view::npos;
  };
  if (is_within('"', '"') || is_within('\'', '\'') || is_within('<', '>')) {
    return trimmed(text.substr(1, text.size() - 2));
  }
  return text;
}

bool is_port(string_view segment) {
  const std::string letters = in_lower_case(segment);
  const auto end = letters.find_last_not_of("0123456789");
  const string_view word = string_view(letters).substr(0, end == std::string::npos ? 0 : end + 1);
  return word.empty() || std::ranges::count(kPorts, word) > 0;
}

/// "torque" of "Model Root/torque/Out1"; "torque [N m]" as it is.
std::string label_text(string_view text) {
  text = without_quotes(text);
  // "Platform()://Model Root/torque/Out1", of dSPACE.
  if (const auto platform = text.find("://"); platform != string_view::npos) {
    text.remove_prefix(platform + 3);
  }
  const auto bracket = std::min(text.find_first_of("[({"), text.size());
  const string_view head = text.substr(0, bracket);
  if (head.find('/') == string_view::npos || !split_column_name(text).unit.empty()) {
    return std::string(text);
  }
  string_view found;
  for (string_view rest = head; !rest.empty();) {
    const auto slash = std::min(rest.find('/'), rest.size());
    const string_view segment = without_quotes(rest.substr(0, slash));
    if (!is_port(segment)) found = segment;
    rest.remove_prefix(std::min(slash + 1, rest.size()));
  }
  return std::string(found);
}

/// As many labels as there are signals, between commas; none otherwise.
std::vector<std::string> split_labels(const std::string& text, std::size_t count) {
  std::vector<std::string> labels;
  for (string_view rest = text;;) {
    const auto comma = std::min(rest.find(','), rest.size());
    labels.push_back(label_text(rest.substr(0, comma)));
    if (comma == rest.size()) break;
    rest.remove_prefix(comma + 1);
  }
  if (labels.size() != count) labels.clear();
  return labels;
}

}  // namespace

string_view owner_of(string_view path) {
  const auto point = path.rfind('.');
  return point == string_view::npos ? string_view() : path.substr(0, point);
}

std::string mat_field(string_view path) {
  string_view field = path.substr(path.rfind('.') + 1);
  return in_lower_case(field.substr(0, field.find_first_of("({")));
}

std::optional<std::string> unit_of_frequency_name(string_view path) {
  const std::string field = mat_field(path);
  const ColumnName name = split_column_name(field);
  if (std::ranges::count(kRadianNames, field) > 0) return "rad/s";
  if (std::ranges::count(kHertzNames, name.base) == 0) return std::nullopt;
  return field == "hz" ? "Hz" : name.unit;
}

bool is_description(string_view path) {
  return !owner_of(path).empty() && std::ranges::count(kDescriptions, mat_field(path)) > 0;
}

MatNames::MatNames(const std::vector<MatVariable>& variables,
                   const std::vector<std::string>& left_out) {
  std::vector<std::string> numbers;
  std::map<std::string, std::set<std::size_t>, std::less<>> sizes;  // of sets of signals, by owner
  for (const string_view phrase : left_out) {
    const auto end = phrase.find(": ");
    const string_view path = phrase.substr(0, end);
    numbers.emplace_back(path);
    const bool is_unit =
        !owner_of(path).empty() && (std::ranges::count(kUnitFields, mat_field(path)) > 0 ||
                                    std::ranges::count(kFrequencyUnitFields, mat_field(path)) > 0);
    if (!is_unit || !phrase.ends_with(kUnreadText)) continue;
    throw arm::InputError(fmt::format("{}; the unit of a signal must be a text of one row, as deg",
                                      arm::shown(std::string(phrase))));
  }
  for (const auto& variable : variables) {
    const string_view path = variable.name;
    const std::string owner(owner_of(path));
    const auto* list = std::get_if<MatStrings>(&variable.value);
    const auto* text = list != nullptr && list->size() == 1
                           ? &list->front()
                           : std::get_if<std::string>(&variable.value);
    if (list != nullptr) (names_units(path) ? unit_lists_ : lists_)[owner].push_back(list);
    if (text != nullptr) {
      texts_[owner.empty() ? std::string(path) : owner + "." + mat_field(path)] = *text;
      if (split_cell(path)) texts_[std::string(path)] = *text;
      if (!tells_other(path)) keyed_units_.add(keyed_unit(path, *text));
    } else if (list == nullptr) {
      numbers.push_back(variable.name);
      const auto* matrix = std::get_if<MatMatrix>(&variable.value);
      if (matrix != nullptr && matrix->values.size() < 2) continue;
      if (is_description(path)) continue;
      sizes[owner].insert(signals_in(variable));
      if (unit_of_frequency_name(path)) frequencies_in_.insert(owner);
      if (const auto cell = split_cell(path)) ++cells_in_[std::string(cell->first)];
      if (is_time_field(path)) {
        times_in_.insert(owner);
        continue;
      }
      for (string_view at = owner_of(path); !at.empty(); at = owner_of(at)) {
        ++signals_in_[std::string(at)];
      }
    }
  }
  keyed_units_.place(numbers, "signal");
  for (const auto& [array, count] : cells_in_) sizes[std::string(owner_of(array))].insert(count);
  for (const auto& [owner, units] : unit_lists_) {
    const auto names = lists_.find(owner);
    const bool is_one_each = names != lists_.end() && names->second.size() == 1;
    if (!is_one_each || units.size() > 1 || units[0]->size() < 2) continue;
    if (names->second[0]->size() == units[0]->size()) continue;
    throw arm::InputError(
        fmt::format("a list of {} units beside one of {} names, {}; must be one for each",
                    units[0]->size(), names->second[0]->size(),
                    arm::shown(fmt::format("{}", fmt::join(*names->second[0], ", ")))));
  }
  for (const auto& variable : variables) {
    const auto* list = std::get_if<MatStrings>(&variable.value);
    const auto beside = sizes.find(owner_of(variable.name));
    if (list == nullptr || list->size() < 2 || beside == sizes.end()) continue;
    const bool is_of_units = std::ranges::count(kUnitFields, mat_field(variable.name)) > 0 &&
                             std::ranges::any_of(*list, [](const std::string& unit) {
                               return is_canonical_unit(canonical_unit(unit));
                             });
    if (!is_of_units || beside->second.contains(list->size())) continue;
    throw arm::InputError(fmt::format(
        "{}: {} units; must be as many as a matrix beside it has signals, or a text for each "
        "signal, tau_unit",
        arm::shown(variable.name), list->size()));
  }
}

std::string MatNames::told_label(string_view path) const {
  for (string_view owner = owner_of(path); !owner.empty(); owner = owner_of(owner)) {
    const auto signals = signals_in_.find(owner);
    if (signals == signals_in_.end() || signals->second > 1) return "";
    for (const string_view field : kLabelFields) {
      const auto text = texts_.find(fmt::format("{}.{}", owner, field));
      if (text != texts_.end() && !trimmed(text->second).empty()) return text->second;
    }
  }
  return "";
}

/// "rad/TimeUnit" is MATLAB's word for rad per `TimeUnit`, seconds if that is not told.
std::string MatNames::told_frequency_unit(string_view path) const {
  const string_view owner = owner_of(path);
  const auto beside = [&](string_view field) {
    // Variables that no structure holds keep their case.
    const auto found = std::ranges::find_if(texts_, [&](const auto& entry) {
      return owner_of(entry.first) == owner && mat_field(entry.first) == field;
    });
    return found == texts_.end() ? std::string() : found->second;
  };
  for (const string_view field : kFrequencyUnitFields) {
    std::string unit = beside(field);
    const std::string time = beside("timeunit");
    constexpr string_view kPerTime = "/TimeUnit";
    if (unit.ends_with(kPerTime)) {
      unit.replace(unit.size() - kPerTime.size() + 1, kPerTime.size(),
                   time.empty() ? "seconds" : time);
    }
    if (!unit.empty()) return canonical_unit(unit);
  }
  return "";
}

std::string MatNames::told_unit(string_view path) const {
  const string_view owner = owner_of(path);
  // A "w" beside times is no frequency.
  const auto of_frequency = times_in_.contains(owner) ? std::nullopt : unit_of_frequency_name(path);
  if (std::string unit = told_frequency_unit(path); of_frequency && !unit.empty()) return unit;
  const char* info = is_time_field(path) ? "TimeInfo" : "DataInfo";
  for (const string_view field : kUnitFields) {
    for (const auto& place :
         {fmt::format("{}.{}", owner, field), fmt::format("{}.{}.{}", owner, info, field)}) {
      const auto text = texts_.find(place);
      // The unit beside a signal is not that of its time.
      const bool is_of_time = place.find(info) != std::string::npos;
      if (text == texts_.end() || (is_time_field(path) && !is_of_time)) continue;
      std::string unit = canonical_unit(text->second);
      const bool is_in_hertz = unit == "Hz" || unit == "kHz";
      const bool is_as_named = of_frequency == "rad/s" && unit == "rad/s";
      if (of_frequency ? !is_in_hertz && !is_as_named
                       : is_in_hertz && frequencies_in_.contains(owner)) {
        continue;
      }
      return unit;
    }
  }
  return "";
}

const MatStrings* MatNames::list_beside(const Lists& lists, string_view path, std::size_t count) {
  const auto beside = lists.find(owner_of(path));
  if (beside == lists.end()) return nullptr;
  const MatStrings* found = nullptr;
  for (const auto* list : beside->second) {
    if (list->size() != count || count < 2) continue;
    // "colheaders" and "textdata" of importdata may be the same texts.
    if (found != nullptr && *found != *list) return nullptr;
    found = list;
  }
  return found;
}

/// The text of a cell in its row or column, at `line`, or in the list beside an array of cells.
std::string MatNames::text_of_cell(const std::string& path, const Lists& lists, int line) const {
  const auto cell = split_cell(path);
  if (!cell) return "";
  const auto [array, index] = *cell;
  if (const auto comma = index.find(','); comma != string_view::npos) {
    for (const auto& place : {fmt::format("{}{{{},{}}}", array, line, index.substr(comma + 1)),
                              fmt::format("{}{{{},{}}}", array, index.substr(0, comma), line)}) {
      const auto text = texts_.find(place);
      if (text == texts_.end()) continue;
      if (&lists == &lists_ || is_canonical_unit(canonical_unit(text->second))) return text->second;
    }
    return "";
  }
  const auto cells = cells_in_.find(array);
  const auto number = arm::parse_number<std::size_t>(index);
  if (cells == cells_in_.end() || !number || *number == 0) return "";
  const auto* list = list_beside(lists, array, cells->second);
  return list != nullptr && *number <= list->size() ? (*list)[*number - 1] : "";
}

bool MatNames::is_time_beside_signals(string_view path) const {
  const string_view owner = owner_of(path);
  if (mat_field(owner) != "x") return false;
  const string_view around = owner_of(owner);
  const auto signals = signals_in_.lower_bound(fmt::format("{}.Y", around));
  if (signals == signals_in_.end()) return false;
  return string_view(signals->first).starts_with(fmt::format("{}.Y", around)) &&
         mat_field(signals->first) == "y";
}

std::vector<MatSignalName> MatNames::of(const std::string& path,
                                        const std::vector<std::string>& suffixes) const {
  const std::size_t count = suffixes.size();
  std::vector<std::string> labels;
  if (is_time_beside_signals(path)) {
    labels = {"time"};
  } else if (const auto* list = list_beside(lists_, path, count)) {
    for (const auto& text : *list) labels.push_back(label_text(text));
  } else if (!is_time_field(path)) {
    const std::string cell = text_of_cell(path, lists_, 1);
    const std::string told = cell.empty() ? told_label(path) : cell;
    labels = count == 1 ? std::vector{label_text(told)} : split_labels(told, count);
  }
  labels.resize(count);
  const auto* units = list_beside(unit_lists_, path, count);
  std::vector<MatSignalName> names;
  for (std::size_t i = 0; i < count; ++i) {
    MatSignalName name{labels[i], path + suffixes[i], told_unit(path)};
    if (name.name.empty()) name.name = name.path;
    const std::string of_name =
        split_column_name(labels[i].empty() ? mat_field(path) : labels[i]).unit;
    std::string listed =
        canonical_unit(units != nullptr ? (*units)[i] : text_of_cell(path, unit_lists_, 2));
    const bool is_keyed = listed.empty();
    if (const auto* unit = keyed_units_.find(path); is_keyed && unit != nullptr) {
      listed = unit->text;
    }
    if (!listed.empty() && !of_name.empty() && listed != of_name) {
      throw arm::InputError(fmt::format(
          "{}: in {} by its name, in {} by the {}; must be the same", arm::shown(name.name),
          arm::shown(of_name), arm::shown(listed), is_keyed ? "unit beside it" : "list of units"));
    }
    if (name.unit.empty()) name.unit = listed.empty() ? of_name : listed;
    names.push_back(std::move(name));
  }
  return names;
}

std::vector<MatVariable> gathered_records(std::vector<MatVariable> variables) {
  constexpr std::size_t kFewestRecords = 10;
  struct Place {
    std::string field;  ///< "x.f" of "x(3).f"
    std::size_t index = 0;
    double value = 0.0;
  };
  const auto place_of = [](const MatVariable& variable) -> std::optional<Place> {
    const auto* matrix = std::get_if<MatMatrix>(&variable.value);
    const string_view path = variable.name;
    const auto close = path.rfind(").");
    if (matrix == nullptr || matrix->values.size() != 1 || close == string_view::npos) {
      return std::nullopt;
    }
    const auto open = path.rfind('(', close);
    if (open == string_view::npos) return std::nullopt;
    const auto index = arm::parse_number<std::size_t>(path.substr(open + 1, close - open - 1));
    if (!index) return std::nullopt;
    return Place{std::string(path.substr(0, open)) + std::string(path.substr(close + 1)), *index,
                 matrix->values.front()};
  };
  std::map<std::string, std::vector<double>> fields;
  for (const auto& variable : variables) {
    const auto place = place_of(variable);
    if (!place) continue;
    auto& values = fields[place->field];
    if (values.size() + 1 == place->index) values.push_back(place->value);
  }
  std::vector<MatVariable> gathered;
  for (auto& variable : variables) {
    const auto place = place_of(variable);
    if (!place || fields[place->field].size() < kFewestRecords) {
      gathered.push_back(std::move(variable));
    } else if (place->index == 1) {
      const auto& values = fields[place->field];
      gathered.push_back({place->field, MatMatrix{values.size(), 1, values}});
    }
  }
  return gathered;
}

}  // namespace flexarm::measured
