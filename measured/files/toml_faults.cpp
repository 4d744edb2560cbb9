#include "measured/files/toml_faults.hpp"

#include "arm/input_error.hpp"
#include "arm/nearest_name.hpp"
#include "measured/files/toml_node.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace flexarm::measured {

void TomlFaults::wrong(const std::string& key, const toml::node& node, const std::string& allowed) {
  fault(line_of(node),
        fmt::format("{}{}: {}; must be {}", key, equals_value(node), kind_of(node), allowed));
}

void TomlFaults::unknown(const std::string& prefix, const std::string& key, const toml::node& node,
                         const std::vector<std::string>& allowed) {
  fault(line_of(node), fmt::format("{}{}: unknown key{}; allowed: {}", prefix, key,
                                   arm::did_you_mean(key, allowed), fmt::join(allowed, ", ")));
}

void TomlFaults::require(const toml::table& table, int line, const char* key, const char* leaf,
                         const char* what) {
  if (table.contains(leaf)) return;
  missing_.emplace(line, fmt::format("{}: missing; must be {}", key, what));
}

void TomlFaults::read_text(const std::string& key, const toml::node& node, const char* what,
                           std::string& text) {
  const auto* found = node.as_string();
  if (found == nullptr || found->get().empty()) {
    wrong(key, node, what);
  } else {
    text = found->get();
  }
}

std::optional<std::size_t> TomlFaults::read_word(const std::string& key, const toml::node& node,
                                                 std::span<const std::string> words) {
  const auto* text = node.as_string();
  if (text == nullptr) {
    wrong(key, node, fmt::format("{}, in quotes", fmt::join(words, " or ")));
    return std::nullopt;
  }
  const auto found = std::ranges::find(words, text->get());
  if (found == words.end()) {
    fault(line_of(node),
          fmt::format("{}{}: must be {}{}", key, equals_value(node), fmt::join(words, " or "),
                      arm::did_you_mean(text->get(), words)));
    return std::nullopt;
  }
  return static_cast<std::size_t>(found - words.begin());
}

void TomlFaults::read_number(const std::string& key, const toml::node& node, const char* unit,
                             const arm::Range& range, double& number) {
  const auto value = number_of(node);
  if (!value) {
    const std::string in_unit = *unit == '\0' ? "" : fmt::format(" [{}]", unit);
    wrong(key, node, fmt::format("{}{}", to_string(range), in_unit));
    return;
  }
  number = *value;
  if (!range.contains(number)) {
    fault(line_of(node), arm::out_of_range(key, number, unit, to_string(range)).what());
  }
}

void TomlFaults::throw_first() const {
  for (const Faults* faults : {&faults_, &missing_}) {
    if (faults->empty()) continue;
    const auto& [line, what] = *faults->begin();
    throw located(arm::InputError(what), file_name_, line);
  }
}

}  // namespace flexarm::measured
