#include "app/error_place.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::app {

namespace {

/// Options whose values have keys of their own: KIND:KEY=VALUE,... or KEY=START:END:COUNT.
constexpr std::array<std::string_view, 3> kWithKeys = {"--excitation", "--reference", "--over"};

/// How libraries call the number of roots that an option asks for, directly or by what is computed
/// from them.
constexpr std::array<std::string_view, 2> kNumbersOfRoots = {"roots", "count"};
constexpr std::array<std::string_view, 5> kAskForRoots = {"--modes", "--poles", "--zeros",
                                                          "--to-Hz", "--frequencies"};

template <std::size_t n>
bool is_among(const std::array<std::string_view, n>& names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

/// "from_Hz" and "payload.mass" as an option would be called: "--from-Hz", "--payload-mass".
std::string option_of_key(std::string_view key) {
  std::string name = "--" + std::string(key);
  std::ranges::replace(name, '_', '-');
  std::ranges::replace(name, '.', '-');
  return name;
}

/// Whether the line goes on as one about the value of the key: "KEY = 3: ..." or "KEY word: ...".
bool is_about_value(std::string_view rest, const CLI::Option& option) {
  if (rest.starts_with(" = ")) return true;
  return std::ranges::any_of(option.results(), [&](const std::string& value) {
    const auto at = rest.find(": ");
    return at != std::string_view::npos && at > 0 &&
           value.find(rest.substr(1, at - 1)) != std::string::npos;
  });
}

/// Whether a value of the option begins with what the key begins with: "random:rms=-1" with
/// "random.rms" or "random", "payload.mass=nan:1:3" with "payload.mass".
bool is_within(std::string_view key, const CLI::Option& option) {
  const std::string_view kind = key.substr(0, key.find('.'));
  return std::ranges::any_of(option.results(), [&](const std::string& value) {
    const std::string_view head = std::string_view(value).substr(0, value.find_first_of(":="));
    return head == kind || head == key;
  });
}

/// Where in the line a key of an option may be: at its beginning, and behind "run ID: " and
/// "at KEY = VALUE UNIT: ".
std::vector<std::size_t> places_of_keys(std::string_view line) {
  std::vector<std::size_t> places = {0};
  std::size_t begin = 0;
  for (std::size_t end; (end = line.find(": ", begin)) != std::string_view::npos;) {
    const std::string_view part = line.substr(begin, end - begin);
    begin = end + 2;
    if (part.starts_with("run ") || part.starts_with("at ")) places.push_back(begin);
  }
  return places;
}

/// The line from a key on in the words of `option`; empty where it is about something else.
std::string in_words_of(const CLI::Option& option, std::string_view line) {
  const std::string_view key = line.substr(0, line.find_first_of(" :/"));
  const std::string_view rest = line.substr(key.size());
  const std::string whole = option_of_key(key);  // "payload.mass" of --payload-mass
  const std::string leaf = option_of_key(key.substr(key.rfind('.') + 1));  // "mesh.elements"
  const std::string name = option.get_name();
  if ((name == whole || name == leaf) && is_about_value(rest, option)) {
    return name + std::string(rest);
  }
  // A ratio: "payload.mass/(m l) = 1e+10: ...".
  if (name == whole && rest.starts_with("/(")) return name + ": " + std::string(line);
  if (is_among(kNumbersOfRoots, key) && is_among(kAskForRoots, name) && rest.starts_with(" = ")) {
    return name + ": " + std::string(line);
  }
  if (is_among(kWithKeys, name) && rest.starts_with(" = ") && is_within(key, option)) {
    return name + " " + std::string(line);
  }
  return "";
}

}  // namespace

arm::InputError placed(const arm::InputError& error, const CLI::App& command) {
  const std::string_view line = error.what();
  for (const std::size_t place : places_of_keys(line)) {
    for (const CLI::Option* option : command.get_options()) {
      if (option->count() == 0) continue;
      const std::string worded = in_words_of(*option, line.substr(place));
      if (!worded.empty()) return arm::InputError(std::string(line.substr(0, place)) + worded);
    }
  }
  return error;
}

}  // namespace flexarm::app
