#include "arm/arm_keys.hpp"
#include "arm/input_error.hpp"
#include "arm/rigid_hub.hpp"
#include "arm/uncertainties.hpp"
#include "arm/utf8.hpp"
#include "measured/files/arm_file.hpp"
#include "measured/files/atomic_file.hpp"
#include "measured/files/hub_torque_table_keys.hpp"
#include "measured/files/stated_effect.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <iterator>
#include <map>
#include <variant>

namespace flexarm::measured {

namespace {

void append_keys(std::string& out, const arm::Arm& arm, const std::string& table) {
  if (table == "beam" && !arm::has_beam(arm)) return;
  std::string lines;
  for (const auto& key : arm::arm_keys()) {
    if (key.table != table) continue;
    const auto value = key.get(arm);
    if (!value || (!key.required && value == key.default_value())) continue;
    fmt::format_to(std::back_inserter(lines), "{} = {}  # {}\n", key.leaf, toml_number(*value),
                   key.unit);
    const auto uncertainty = arm.relative_uncertainties.find(key.name());
    if (uncertainty == arm.relative_uncertainties.end()) continue;
    fmt::format_to(std::back_inserter(lines), "{}{} = {}  # of {}, relative\n", key.leaf,
                   arm::kUncertaintySuffix, toml_number(uncertainty->second), key.leaf);
  }
  if (!lines.empty()) out += fmt::format("\n[{}]\n{}", table, lines);
}

void append_effect(std::string& out, const std::string& name, const arm::Effect& effect) {
  out += fmt::format("\n[effects.{}]\n", name);
  for (const auto& parameter : effect.definition->parameters) {
    const auto value = effect.parameters.find(parameter.name);
    if (value == effect.parameters.end()) continue;
    out +=
        fmt::format("{} = {}  # {}\n", parameter.name, toml_number(value->second), parameter.unit);
  }
  if (!effect.sensor.empty()) out += fmt::format("sensor = {}\n", toml_string(effect.sensor));
}

}  // namespace

std::string toml_number(double value) {
  std::array<char, 32> buffer;
  char* const end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  std::string text(buffer.data(), end);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

std::string toml_string(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (byte < 0x20 || byte == 0x7f) {
      out += fmt::format("\\u{:04X}", byte);
    } else {
      out += c;
    }
  }
  return out + "\"";
}

std::string format_arm(const arm::Arm& arm) {
  arm::require_valid(arm);
  if (!arm::is_utf8(arm.name)) {
    throw arm::InputError(
        fmt::format("name = \"{}\": not UTF-8, as required by TOML", arm::shown(arm.name)), "name");
  }
  std::string out;
  if (!arm.name.empty()) out += fmt::format("name = {}\n", toml_string(arm.name));
  for (const auto& table : arm::arm_tables()) append_keys(out, arm, table);
  for (const auto& [name, effect] : arm.effects) {
    if (const auto* formula = std::get_if<arm::HubTorqueFormula>(&effect.definition->given)) {
      const auto hypothesis = arm.hypotheses.find(name);
      out += format_stated_effect(name, *formula, effect.parameters,
                                  hypothesis == arm.hypotheses.end()
                                      ? std::map<std::string, arm::Interval>()
                                      : hypothesis->second.ranges);
    } else if (const auto* table = std::get_if<arm::HubTorqueTable>(&effect.definition->given)) {
      out += format_hub_torque_table(*table);
    } else {
      append_effect(out, name, effect);
    }
  }
  for (const auto& [name, hypothesis] : arm.hypotheses) {
    if (arm.effects.contains(name)) continue;
    out += format_stated_effect(name, hypothesis.formula, hypothesis.known, hypothesis.ranges);
  }
  return out;
}

void write_arm_file(const arm::Arm& arm, const std::filesystem::path& path) {
  write_atomically(path, format_arm(arm));
}

}  // namespace flexarm::measured
