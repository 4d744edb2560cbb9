#include "app/suggestion.hpp"

#include "arm/decimal_comma.hpp"
#include "arm/input_error.hpp"
#include "arm/nearest_name.hpp"
#include "measured/files/column_name.hpp"
#include "measured/files/delimited_line.hpp"
#include "measured/files/unit.hpp"
#include "measured/files/unit_spelling.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>
#include <vector>

namespace flexarm::app {

namespace {

std::vector<std::string> subcommands_of(const CLI::App& parser) {
  std::vector<std::string> names;
  for (const auto* command : parser.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(command->get_name());
  }
  return names;
}

std::vector<std::string> options_of(const CLI::App& parser) {
  std::vector<std::string> names;
  for (const auto* option : parser.get_options()) {
    for (const auto& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

/// SI units in one of the unit, "ms" of a number in s; empty for a unit of something else.
std::optional<double> units_in_one(const std::string& unit, const std::string& typed) {
  if (typed == unit || measured::canonical_unit(typed) == measured::canonical_unit(unit))
    return 1.0;
  // Times alone are typed in several units.
  if (unit != "s") return std::nullopt;
  for (const auto& known : measured::units_for("s")) {
    if (known.name == measured::canonical_unit(typed)) return known.to_si(1.0);
  }
  return measured::other_unit_scale("s", measured::canonical_unit(typed));
}

/// "--duration = 4s: must be a number in s, without a unit behind it; write 4".
std::string not_a_number(const CLI::Option& option, const std::string& value) {
  const std::string unit = unit_of_option(option.get_name(), option.get_description());
  const bool is_whole = option.get_type_name().find("INT") != std::string::npos;
  double number = 0.0;
  const char* const end_of_value = value.data() + value.size();
  const auto [end, error] = std::from_chars(value.data(), end_of_value, number);
  std::string hint = arm::decimal_comma_hint(value);
  if (hint.empty() && error == std::errc() && end != end_of_value) {
    const std::string rest(end, end_of_value);
    const auto scale = units_in_one(unit, std::string(measured::trimmed(rest)));
    if (scale) hint = fmt::format("; write {}", number * *scale);
  }
  return fmt::format(
      "{} = {}: must be a {}, without a unit behind it{}", option.get_name(), arm::shown(value),
      (is_whole ? "whole number" : "number") + (unit.empty() ? "" : " in " + unit), hint);
}

/// The value of an option that is no number; empty for any other error.
std::string number_fault(const CLI::App& parser, const CLI::ParseError& error) {
  constexpr std::string_view kFront = "Could not convert: ";
  const std::string what = error.what();
  const auto equals = what.find(" = ");
  if (!what.starts_with(kFront) || equals == std::string::npos) return "";
  const CLI::Option* option =
      parser.get_option_no_throw(what.substr(kFront.size(), equals - kFront.size()));
  const bool is_number =
      option != nullptr && (option->get_type_name().find("INT") != std::string::npos ||
                            option->get_type_name().find("FLOAT") != std::string::npos);
  return is_number ? not_a_number(*option, what.substr(equals + 3)) : "";
}

}  // namespace

std::string unit_of_option(const std::string& name, const std::string& help) {
  if (help.starts_with("Seconds")) return "s";
  constexpr std::string_view kHertz = "-Hz";
  if (name.ends_with(kHertz)) return "Hz";
  const auto open = help.find('[');
  const auto close = help.find(']', std::min(open, help.size()));
  if (close == std::string::npos) return "";
  std::string unit = help.substr(open + 1, close - open - 1);
  const bool is_unit = unit == "%" || unit.starts_with("kg") ||
                       measured::is_canonical_unit(measured::canonical_unit(unit));
  return is_unit ? unit : "";
}

std::string explain(const CLI::App& program, const CLI::ParseError& error) {
  const auto chosen = program.get_subcommands();
  const CLI::App& parser = chosen.empty() ? program : *chosen.front();
  const std::string help =
      chosen.empty() ? "flexarm --help" : fmt::format("flexarm {} --help", parser.get_name());

  const auto extras = program.remaining(true);
  if (dynamic_cast<const CLI::ExtrasError*>(&error) == nullptr || extras.empty()) {
    if (const std::string fault = number_fault(parser, error); !fault.empty()) {
      return fmt::format("{}; see {}", fault, help);
    }
    // Some of the library's messages run over several lines.
    std::string what = error.what();
    std::ranges::replace(what, '\n', ' ');
    if (dynamic_cast<const CLI::ConversionError*>(&error) != nullptr) {
      what += arm::decimal_comma_hint(what.substr(what.rfind(' ') + 1));
    }
    return fmt::format("{}; see {}", what, help);
  }
  // "--name=value" was meant as "--name".
  const std::string typed = extras.front().substr(0, extras.front().find('='));
  const bool is_option = typed.starts_with('-');
  const bool is_command = !is_option && chosen.empty();
  const auto names = is_option ? options_of(parser) : subcommands_of(program);
  return fmt::format("{}: unknown {}{}; see {}", arm::shown(typed),
                     is_option    ? "option"
                     : is_command ? "command"
                                  : "argument",
                     is_option || is_command ? arm::did_you_mean(typed, names) : "", help);
}

}  // namespace flexarm::app
