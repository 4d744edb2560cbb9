#include "measured/files/json_reading.hpp"

#include "arm/input_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace flexarm::measured {

namespace {

using arm::InputError;
using Json = nlohmann::ordered_json;
using std::string_view;

/// NaN and Infinity, which Python writes and JSON does not know, as null, outside of texts.
std::string without_nan(string_view text) {
  std::string out;
  bool in_text = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '"' && (i == 0 || text[i - 1] != '\\')) in_text = !in_text;
    if (!in_text) {
      bool found = false;
      for (const string_view word : {"NaN", "-Infinity", "Infinity"}) {
        if (!text.substr(i).starts_with(word)) continue;
        out += "null";
        i += word.size() - 1;
        found = true;
        break;
      }
      if (found) continue;
    }
    out += text[i];
  }
  return out;
}

/// Discarded for what is no JSON.
Json parsed_once(string_view text) {
  std::vector<std::set<std::string>> keys;  // of the objects around
  return Json::parse(
      text,
      [&](int /*depth*/, Json::parse_event_t event, Json& parsed) {
        if (event == Json::parse_event_t::object_start) keys.emplace_back();
        if (event == Json::parse_event_t::object_end) keys.pop_back();
        if (event != Json::parse_event_t::key) return true;
        const auto& key = parsed.get_ref<const std::string&>();
        if (keys.back().insert(key).second) return true;
        throw InputError(
            fmt::format("{}: given twice in one object; must be given once", arm::shown(key)));
      },
      false);
}

/// The list of the objects that stand one a line; discarded for any other text.
Json objects_by_line(string_view text) {
  Json list = Json::array();
  while (!text.empty()) {
    const auto end = std::min(text.find('\n'), text.size());
    const string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.find_first_not_of(" \t\r") == string_view::npos) continue;
    Json object = parsed_once(line);
    const bool is_row = object.is_object() || object.is_array();
    if (!is_row) {
      // The last one may be cut off.
      if (object.is_discarded() && text.empty() && !list.empty()) break;
      return Json(Json::value_t::discarded);
    }
    list.push_back(std::move(object));
  }
  return list;
}

}  // namespace

Json parsed_json(string_view text) {
  const std::string sound = without_nan(text);
  Json json = parsed_once(sound);
  if (json.is_discarded()) json = objects_by_line(sound);
  if (!json.is_discarded()) return json;
  try {
    [[maybe_unused]] const Json whole = Json::parse(sound);
  } catch (const Json::parse_error& error) {
    throw InputError(
        fmt::format("not JSON, nor a JSON object a line: wrong or cut off at byte {}", error.byte));
  } catch (const Json::exception&) {
    throw InputError("JSON with a number above 1e308");
  }
  return json;
}

}  // namespace flexarm::measured
