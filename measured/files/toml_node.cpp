#include "measured/files/toml_node.hpp"

#include "arm/input_error.hpp"

#include <fmt/format.h>

namespace flexarm::measured {

std::string_view kind_of(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "an array";
    case toml::node_type::string:
      return "a string";
    case toml::node_type::integer:
    case toml::node_type::floating_point:
      return "a number";
    case toml::node_type::boolean:
      return "a boolean";
    default:
      return "a date or time";
  }
}

std::string equals_value(const toml::node& node) {
  if (const auto* text = node.as_string()) return fmt::format(" = \"{}\"", arm::shown(text->get()));
  if (const auto* number = node.as_integer()) return fmt::format(" = {}", number->get());
  if (const auto* number = node.as_floating_point()) return fmt::format(" = {}", number->get());
  if (const auto* flag = node.as_boolean()) return fmt::format(" = {}", flag->get());
  return "";
}

std::optional<double> number_of(const toml::node& node) {
  if (const auto* number = node.as_integer()) return static_cast<double>(number->get());
  if (const auto* number = node.as_floating_point()) return number->get();
  return std::nullopt;
}

}  // namespace flexarm::measured
