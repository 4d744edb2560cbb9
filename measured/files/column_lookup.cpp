#include "measured/files/column_lookup.hpp"

#include "arm/nearest_name.hpp"
#include "arm/number.hpp"
#include "measured/files/column_name.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

namespace flexarm::measured {

namespace {

std::vector<std::string> names_without_units(std::span<const std::string> names) {
  std::vector<std::string> bases;
  for (const auto& name : names) bases.push_back(split_column_name(name).base);
  return bases;
}

}  // namespace

std::string shown_names(std::span<const std::string> names) {
  return arm::shown(fmt::format("{}", fmt::join(names, ", ")), 400);
}

std::optional<std::size_t> column_number(std::string_view typed) {
  if (!typed.starts_with('#')) return std::nullopt;
  return arm::parse_number<std::size_t>(typed.substr(1));
}

std::optional<std::size_t> column_place(std::span<const std::string> names,
                                        std::string_view typed) {
  const auto place_in = [&](std::span<const std::string> among) {
    return static_cast<std::size_t>(std::ranges::find(among, typed) - among.begin());
  };
  if (const auto place = place_in(names); place < names.size()) return place;
  auto number = column_number(typed);
  if (!number) number = arm::parse_number<std::size_t>(typed);
  if (number) {
    if (*number == 0 || *number > names.size()) return std::nullopt;
    return *number - 1;
  }
  const std::vector<std::string> bases = names_without_units(names);
  if (std::ranges::count(bases, typed) != 1) return std::nullopt;
  return place_in(bases);
}

arm::InputError unknown_column(std::span<const std::string> names, std::string_view typed) {
  std::string meant = arm::did_you_mean(typed, names);
  const auto bases = names_without_units(names);
  if (const auto base = arm::nearest_name(typed, bases); meant.empty() && base) {
    const auto place = std::ranges::find(bases, *base) - bases.begin();
    meant = fmt::format(" (did you mean {}?)", arm::shown(names[static_cast<std::size_t>(place)]));
  }
  return arm::InputError(fmt::format("column {}: not in the file{}; it has {}", arm::shown(typed),
                                     meant, shown_names(names)));
}

}  // namespace flexarm::measured
