#include "arm/decimal_comma.hpp"
#include "arm/input_error.hpp"
#include "arm/number.hpp"
#include "compare/sweeps/sweep_parameter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>

namespace flexarm::compare {

namespace {

constexpr std::string_view kForms =
    "give KEY=START:END:COUNT, KEY=log:START:END:COUNT or KEY=A,B,C";

arm::InputError bad_axis(std::string_view text, const std::string& what) {
  return arm::InputError(fmt::format("--over {}: {}", arm::shown(text), what));
}

std::vector<std::string_view> split(std::string_view text, char at) {
  std::vector<std::string_view> parts;
  while (true) {
    const auto end = text.find(at);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

template <class Number>
Number number_in(std::string_view whole, std::string_view part) {
  const auto value = arm::parse_number<Number>(part);
  if (!value) {
    const std::string hint = arm::decimal_comma_hint(part);
    throw bad_axis(whole,
                   fmt::format("\"{}\" is not a {}{}; {}", arm::shown(part),
                               std::is_integral_v<Number> ? "count" : "number", hint, kForms));
  }
  return *value;
}

std::vector<std::string> items_of(std::string_view whole, std::string_view list) {
  try {
    return arm::list_items(list);
  } catch (const arm::InputError& error) {
    throw bad_axis(whole, error.what());
  }
}

/// The value a part `t` of the way, 0 <= t <= 1.
double between(double start, double end, double t, bool logarithmic) {
  if (t <= 0.0) return start;
  if (t >= 1.0) return end;
  return logarithmic ? start * std::pow(end / start, t) : start + (end - start) * t;
}

void fill_range(SweepAxis& axis, std::string_view text, std::span<const std::string_view> parts) {
  const auto start = number_in<double>(text, parts[0]);
  const auto end = number_in<double>(text, parts[1]);
  const int count = number_in<int>(text, parts[2]);
  if (count < 2 || count > kMostGridPoints) {
    throw bad_axis(text, fmt::format("COUNT = {}: must be from 2 to {}", count, kMostGridPoints));
  }
  if (axis.logarithmic && !(start > 0.0 && end > 0.0)) {
    throw bad_axis(text, "logarithmic spacing needs START and END above 0");
  }
  for (int i = 0; i < count; ++i) {
    axis.values.push_back(between(start, end, i / (count - 1.0), axis.logarithmic));
  }
}

bool is_monotonic(const std::vector<double>& values) {
  const auto has_pair = [&](auto relation) {
    return std::ranges::adjacent_find(values, relation) != values.end();
  };
  return !has_pair(std::less_equal<>()) || !has_pair(std::greater_equal<>());
}

}  // namespace

double SweepAxis::at(double place) const {
  const double low = std::clamp(std::floor(place), 0.0, static_cast<double>(values.size() - 1));
  const auto i = static_cast<std::size_t>(low);
  if (place <= low || i + 1 >= values.size()) return values[i];
  return between(values[i], values[i + 1], place - low, logarithmic);
}

SweepAxis parse_axis(std::string_view text) {
  const auto equals = text.find('=');
  if (equals == std::string_view::npos || equals == 0 || equals + 1 == text.size()) {
    throw bad_axis(text, std::string(kForms));
  }
  SweepAxis axis;
  axis.typed = std::string(text);
  try {
    axis.parameter = sweep_parameter(text.substr(0, equals));
  } catch (const arm::InputError& error) {
    throw arm::InputError(fmt::format("--over {}", error.what()));
  }
  auto parts = split(text.substr(equals + 1), ':');
  axis.logarithmic = parts.front() == "log";
  if (axis.logarithmic) parts.erase(parts.begin());
  if (parts.size() == 3) {
    fill_range(axis, text, parts);
  } else if (parts.size() == 1 && !axis.logarithmic) {
    for (const auto& part : items_of(text, parts.front())) {
      axis.values.push_back(number_in<double>(text, part));
    }
  } else {
    throw bad_axis(text, std::string(kForms));
  }
  for (const double value : axis.values) {
    arm::require_in_range(axis.parameter.name, value, axis.parameter.unit, axis.parameter.range);
  }
  if (!is_monotonic(axis.values)) throw bad_axis(text, "the values must be monotonic");
  return axis;
}

}  // namespace flexarm::compare
