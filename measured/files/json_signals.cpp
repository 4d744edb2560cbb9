#include "measured/files/json_signals.hpp"

#include "arm/input_error.hpp"
#include "measured/files/column_words.hpp"
#include "measured/files/keyed_units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace flexarm::measured {

namespace {

using arm::InputError;
using Json = nlohmann::ordered_json;
using std::string_view;

constexpr std::array<string_view, 6> kNameKeys = {"name",  "signalname", "channel",
                                                  "label", "title",      "signal"};
constexpr std::array<string_view, 7> kListKeys = {"data",  "values",  "value", "y",
                                                  "ydata", "samples", "signal"};
constexpr std::array<string_view, 6> kTimeKeys = {"time", "times", "t", "x", "xdata", "timestamps"};

/// The value of the first of the keys that the object has, in any case; null without.
const Json* member(const Json& object, std::span<const string_view> keys,
                   bool (*is_one)(const Json&), std::string* found = nullptr) {
  for (const string_view wanted : keys) {
    for (const auto& [key, value] : object.items()) {
      if (plain_letters(key) != wanted || !is_one(value)) continue;
      if (found != nullptr) *found = key;
      return &value;
    }
  }
  return nullptr;
}

bool is_name(const Json& value) {
  return value.is_string() && !value.get_ref<const std::string&>().empty();
}

bool is_list_of_cells(const Json& value) {
  return value.is_array() && !value.empty() &&
         std::ranges::none_of(value, [](const Json& cell) { return cell.is_structured(); });
}

bool is_list_of_named(const Json& list) {
  return list.is_array() && !list.empty() && std::ranges::all_of(list, [](const Json& one) {
           return one.is_object() && member(one, kNameKeys, is_name) != nullptr &&
                  member(one, kListKeys, is_list_of_cells) != nullptr;
         });
}

/// The unit that a key of a signal tells of its list, "unit" or "y_unit".
bool tells_unit_of_list(const std::string& key, const std::string& list_key) {
  const auto list = list_of_unit_key(key);
  return list && (list->empty() || *list == list_key);
}

/// Puts the signals of the list into the object.
void add_signals(const Json& list, Json& object) {
  std::string first_of_times;
  for (const auto& signal : list) {
    std::string list_key;
    std::string time_key;
    const auto name = member(signal, kNameKeys, is_name)->get<std::string>();
    if (object.contains(name)) {
      throw InputError(
          fmt::format("signal {}: given twice; must have names of their own", arm::shown(name)));
    }
    object[name] = *member(signal, kListKeys, is_list_of_cells, &list_key);
    const Json* times = member(signal, kTimeKeys, is_list_of_cells, &time_key);
    if (times != nullptr && first_of_times.empty()) {
      first_of_times = name;
      object["time"] = *times;
    } else if (times != nullptr && object["time"] != *times) {
      throw InputError(fmt::format(
          "signals {} and {}: times of their own that differ; save each in a file of its own and "
          "join them with --join",
          arm::shown(first_of_times), arm::shown(name)));
    }
    Json settings = Json::object();
    for (const auto& [key, value] : signal.items()) {
      if (value.is_string() && tells_unit_of_list(key, list_key)) {
        object[name + "_unit"] = value;
      } else if (value.is_string() && times != nullptr && list_of_unit_key(key) == time_key) {
        object["time_unit"] = value;
      } else if (value.is_number() || (value.is_string() && list_of_unit_key(key))) {
        settings[key] = value;
      }
    }
    if (!settings.empty()) object[name + " settings"] = std::move(settings);
  }
}

}  // namespace

Json with_lists_of_signals(Json value, int depth) {
  constexpr int kDeepest = 16;
  Json made = Json::object();
  if (is_list_of_named(value)) {
    add_signals(value, made);
    return made;
  }
  if (!value.is_object() || depth > kDeepest) return value;
  if (std::ranges::none_of(value, is_list_of_named)) {
    for (auto& inside : value) inside = with_lists_of_signals(std::move(inside), depth + 1);
    return value;
  }
  for (auto& [key, inside] : value.items()) {
    if (is_list_of_named(inside)) {
      add_signals(inside, made);
    } else {
      made[key] = with_lists_of_signals(std::move(inside), depth + 1);
    }
  }
  return made;
}

}  // namespace flexarm::measured
