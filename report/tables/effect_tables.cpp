#include "report/tables/effect_tables.hpp"

#include "report/tables/text_table.hpp"
#include "report/wrapped_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <string_view>

namespace flexarm::report {

namespace {

using arm::Port;

std::string allowed(const arm::Range& range) {
  if (std::isinf(range.minimum)) return "";
  return range.exclusive ? fmt::format(" above {}", range.minimum)
                         : fmt::format(" {} or more", range.minimum);
}

std::string_view meaning_of(Port port) {
  switch (port) {
    case Port::arm_number:
      return "a changed parameter of the arm";
    case Port::linear_term:
      return "a term of the linear arm";
    case Port::sensor_place:
      return "another place of a strain gauge";
    case Port::torque_path:
      return "a stage of the torque path, between commanded torque and hub";
    case Port::hub_torque:
      return "a law of hub torque";
    case Port::beam_force:
      return "a force along the beam";
    case Port::sensor_path:
      return "a stage of a sensor path";
  }
  return "";
}

std::string_view shown_in(effects::Shows shows) {
  switch (shows) {
    case effects::Shows::in_time:
      return "time records";
    case effects::Shows::in_time_and_frequency:
      return "time records, frequency responses";
    case effects::Shows::in_all:
      return "time records, frequency responses, poles and zeros";
  }
  return "";
}

std::string ports_of(const arm::EffectDefinition& definition) {
  std::vector<std::string_view> names;
  for (const Port port : definition.ports()) names.push_back(to_string(port));
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string neutral_of(const arm::EffectParameter& parameter) {
  if (!parameter.neutral) return "";
  return std::isinf(*parameter.neutral) ? "infinite" : fmt::format("{:g}", *parameter.neutral);
}

/// As an arm file switches it on.
std::string example_of(const arm::EffectDefinition& definition) {
  std::string text = fmt::format("[effects.{}]\n", definition.name);
  for (const auto& parameter : definition.parameters) {
    text += fmt::format("{:<28} # {}\n", fmt::format("{} = {}", parameter.name, parameter.example),
                        parameter.unit);
  }
  if (definition.sensor)
    text += fmt::format("sensor = \"{}\"\n", arm::to_string(*definition.sensor));
  return text;
}

std::string section(const effects::Entry& entry) {
  const arm::EffectDefinition& definition = *entry.definition;
  std::string text = fmt::format("### {}\n\n{}\n\n", definition.name, definition.meaning);
  text +=
      "| parameter | unit | allowed | neutral value | meaning |\n| --- | --- | --- | --- | --- |\n";
  for (const auto& parameter : definition.parameters) {
    text += fmt::format("| `{}` | {} |{} | {} | {} |\n", parameter.name, parameter.unit,
                        allowed(parameter.range), neutral_of(parameter), parameter.meaning);
  }
  text += fmt::format("\n- port: `{}`\n- detectable in: {}\n", ports_of(definition),
                      shown_in(entry.shows));
  if (!entry.contains.empty()) {
    text += fmt::format("- limiting case: `{}`\n", fmt::join(entry.contains, "`, `"));
  }
  if (!entry.same_as.empty()) {
    text +=
        fmt::format("- indistinguishable in any data: `{}`\n", fmt::join(entry.same_as, "`, `"));
  }
  text += fmt::format("- evidence for it: {}\n- evidence against it: {}\n", entry.speaks_for,
                      entry.refuted_by);
  return text + fmt::format("\n```toml\n{}```\n\n", example_of(definition));
}

}  // namespace

std::string parameters_of(const arm::EffectDefinition& definition, bool markdown) {
  const char* mark = markdown ? "`" : "";
  std::vector<std::string> parameters;
  for (const auto& parameter : definition.parameters) {
    parameters.push_back(fmt::format("{0}{1}{0} [{2}]{3}{4}", mark, parameter.name, parameter.unit,
                                     allowed(parameter.range),
                                     parameter.otherwise ? ", optional" : ""));
  }
  if (definition.sensor) parameters.push_back(fmt::format("{0}sensor{0}, optional", mark));
  return fmt::format("{}", fmt::join(parameters, "; "));
}

std::string effect_list(const std::vector<effects::Entry>& entries, std::size_t max_width) {
  std::string text;
  std::string_view port;
  for (const auto& entry : entries) {
    const arm::EffectDefinition& definition = *entry.definition;
    const Port first = definition.ports().front();
    if (to_string(first) != port) {
      port = to_string(first);
      text += fmt::format("{}{}: {}\n", text.empty() ? "" : "\n", port, meaning_of(first));
    }
    // Parameters stand in a column of their own, or below the name where there is no room.
    constexpr std::size_t kNames = 28;
    const bool is_wide = max_width >= 2 * kNames;
    const std::size_t indent = is_wide ? kNames : 4;
    const std::size_t room = max_width - indent;
    std::string line = fmt::format("{:<{}}", "  " + definition.name, is_wide ? kNames : 0);
    bool beside = is_wide;
    for (const auto& part : wrapped(parameters_of(definition, false), room, room)) {
      if (!beside) line += "\n" + std::string(indent, ' ');
      line += part;
      beside = false;
    }
    text += line + "\n";
  }
  return text;
}

std::string effect_page(const effects::Entry& entry, std::size_t max_width) {
  const arm::EffectDefinition& definition = *entry.definition;
  std::string text =
      to_paragraph(fmt::format("{}: {}.", definition.name, definition.meaning), 2, max_width);
  Table table{.caption = "",
              .columns = {{"parameter"}, {"unit"}, {"allowed"}, {"neutral value"}, {"meaning"}}};
  for (const auto& parameter : definition.parameters) {
    const std::string range = allowed(parameter.range);
    table.add_row({parameter.name, parameter.unit, range.empty() ? "any" : range.substr(1),
                   neutral_of(parameter), parameter.meaning});
  }
  text += "\n" + to_text(table, {.max_width = max_width}) + "\n";
  text += fmt::format("port:          {}\ndetectable in: {}\n", ports_of(definition),
                      shown_in(entry.shows));
  if (!entry.contains.empty()) {
    text += fmt::format("limiting case: {}\n", fmt::join(entry.contains, ", "));
  }
  if (!entry.same_as.empty()) {
    text += fmt::format("indistinguishable in any data: {}\n", fmt::join(entry.same_as, ", "));
  }
  text += to_paragraph(fmt::format("evidence for it: {}.", entry.speaks_for), 2, max_width);
  text += to_paragraph(fmt::format("evidence against it: {}.", entry.refuted_by), 2, max_width);
  return text + "\n" + example_of(definition);
}

std::string effects_document(const std::vector<effects::Entry>& entries) {
  std::string text =
      "# Effects\n\n"
      "The effect library: effects beyond the ideal arm. Each effect has one name, the same in "
      "`[effects.NAME]` of an arm file, in reports and\n"
      "in a diagnosis. `flexarm effects --markdown` prints this page, `flexarm effects NAME` one "
      "section of it.\n\n"
      "`tau` is the commanded (measured) torque, `T` the torque that reaches the hub, theta the "
      "hub angle, y the displacement of the beam\n"
      "from the resting line, hub rotation included. A parameter without a range can have any "
      "finite value.\n\n"
      "An effect acts through ports. All formulations support `arm_number`, `linear_term` and "
      "`sensor_place`; the time\n"
      "simulation supports all ports.\n"
      "Poles, zeros and frequency responses do not include nonlinear effects, and state this.\n\n"
      "Laws of hub torque that are not in the library can be stated in the arm file as a formula "
      "([stated laws](formats.md#stated-laws)) or as a\n"
      "table, `measured_hub_torque` ([measured law](formats.md#measured-law)).\n\n"
      "| port | the effect is |\n"
      "| --- | --- |\n";
  for (const Port port :
       {Port::arm_number, Port::linear_term, Port::sensor_place, Port::torque_path,
        Port::hub_torque, Port::beam_force, Port::sensor_path}) {
    text += fmt::format("| `{}` | {} |\n", to_string(port), meaning_of(port));
  }
  text += "\n## Overview\n\n| effect | parameters | meaning |\n| --- | --- | --- |\n";
  for (const auto& entry : entries) {
    text += fmt::format("| [`{0}`](#{0}) | {1} | {2} |\n", entry.definition->name,
                        parameters_of(*entry.definition, true), entry.definition->meaning);
  }
  text += "\n## Details\n\n";
  for (const auto& entry : entries) text += section(entry);
  text.pop_back();
  return text;
}

}  // namespace flexarm::report
