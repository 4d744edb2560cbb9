#include "app/list_option.hpp"

#include "app/command.hpp"
#include "app/suggestion.hpp"
#include "arm/decimal_comma.hpp"
#include "arm/input_error.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

namespace flexarm::app {

namespace {

template <class Item, class Read>
CLI::Option* add_list(CLI::App& parser, const std::string& name, std::vector<Item>& items,
                      const std::string& help, Read read) {
  const std::string unit = unit_of_option(name, help);
  const auto take = [name, unit, &items, read](const std::vector<std::string>& typed) {
    items.clear();
    for (const auto& text : typed) {
      try {
        std::ranges::move(read(text), std::back_inserter(items));
      } catch (const arm::InputError& error) {
        throw arm::InputError(fmt::format("{} {}{}", name, error.what(),
                                          unit.empty() ? "" : fmt::format("; in {}", unit)));
      }
    }
  };
  return parser.add_option_function<std::vector<std::string>>(name, take, help)
      ->check(not_empty())
      ->allow_extra_args(false);
}

}  // namespace

CLI::Option* add_list_option(CLI::App& parser, const std::string& name,
                             std::vector<double>& numbers, const std::string& help) {
  return add_list(parser, name, numbers, help, arm::number_list)->type_name("FLOAT,");
}

CLI::Option* add_list_option(CLI::App& parser, const std::string& name,
                             std::vector<std::string>& words, const std::string& help) {
  CLI::Option* option = add_list(parser, name, words, help, arm::list_items)->type_name("TEXT,");
  if (!words.empty()) option->default_str(fmt::format("{}", fmt::join(words, ",")));
  return option;
}

bool is_list_option(const CLI::Option& option) {
  return option.get_delimiter() == ',' || option.get_type_name().ends_with(',');
}

}  // namespace flexarm::app
