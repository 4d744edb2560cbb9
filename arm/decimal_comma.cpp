#include "arm/decimal_comma.hpp"

#include "arm/ascii.hpp"
#include "arm/input_error.hpp"
#include "arm/number.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace flexarm::arm {

namespace {

using std::string_view;

constexpr string_view kDigits = "0123456789";

/// Digits, perhaps with an exponent: 05, 5e-3.
bool are_decimals(string_view item) {
  const auto end = std::min(item.find_first_not_of(kDigits), item.size());
  if (end == 0) return false;
  if (end == item.size()) return true;
  return (item[end] == 'e' || item[end] == 'E') && parse_number<double>(item).has_value();
}

/// What stands in front of the whole number that `before` ends with, its sign included.
string_view in_front_of_number(string_view before) {
  const auto last = before.find_last_not_of(kDigits);
  if (last == string_view::npos) return {};
  const bool is_sign = before[last] == '-' || before[last] == '+';
  return before.substr(0, is_sign ? last : last + 1);
}

std::string with_point(string_view text) {
  std::string out(text);
  for (std::size_t i = 1; i + 1 < out.size(); ++i) {
    if (out[i] == ',' && is_digit(out[i - 1]) && is_digit(out[i + 1])) out[i] = '.';
  }
  return out;
}

/// "0,05" as the list 0.0,5.0.
std::string as_list(string_view first, string_view second) {
  const auto number = [](string_view item) {
    const std::string shortest = fmt::format("{}", parse_number<double>(item).value_or(0.0));
    return shortest.find_first_of(".e") == std::string::npos ? shortest + ".0" : shortest;
  };
  return number(first) + "," + number(second);
}

}  // namespace

bool may_be_decimals(string_view before, string_view next) {
  if (before.empty() || next.empty() || !is_digit(before.back()) || !is_digit(next.front())) {
    return false;
  }
  const string_view front = in_front_of_number(before);
  // A number with a point has its decimals; a word that ends in digits is no number.
  return front.empty() || string_view("=@:/").find(front.back()) != string_view::npos;
}

std::vector<std::string> list_items(string_view text) {
  std::vector<std::string> items;
  for (string_view rest = text;;) {
    const auto comma = std::min(rest.find(','), rest.size());
    items.emplace_back(rest.substr(0, comma));
    if (comma == rest.size()) break;
    rest.remove_prefix(comma + 1);
  }
  for (std::size_t i = 1; i < items.size(); ++i) {
    const std::string& before = items[i - 1];
    const std::string& item = items[i];
    if (!may_be_decimals(before, item) || !are_decimals(item)) continue;
    const std::string pair = before + "," + item;
    if (!in_front_of_number(before).empty()) {
      throw InputError(
          fmt::format("{}: the comma separates items; numbers have a decimal point: {}",
                      shown(pair), shown(with_point(pair))));
    }
    if (items.size() > 2 && item.front() == '0' && item.size() > 1) {
      throw InputError(fmt::format(
          "{}: {} is {}, or two numbers of the list? Write a decimal point, or {} for {}",
          shown(text), shown(pair), shown(with_point(pair)),
          fmt::format("{}", *parse_number<double>(item)), shown(item)));
    }
    if (items.size() == 2) {
      throw InputError(fmt::format("{}: one number, or two? Write {} or {}", shown(text),
                                   shown(with_point(pair)), as_list(before, item)));
    }
  }
  return items;
}

std::vector<double> number_list(string_view text) {
  std::vector<double> numbers;
  for (const auto& item : list_items(text)) {
    const auto number = parse_number<double>(item);
    if (!number || !std::isfinite(*number)) {
      throw InputError(
          fmt::format("{}: {} is not a number; give numbers with a decimal point, "
                      "separated by commas",
                      shown(text), item.empty() ? "an empty item" : shown(item)));
    }
    numbers.push_back(*number);
  }
  return numbers;
}

std::string decimal_comma_hint(string_view text) {
  const std::string pointed = with_point(text);
  return pointed == text ? "" : "; numbers have a decimal point: " + shown(pointed);
}

}  // namespace flexarm::arm
