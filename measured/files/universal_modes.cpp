#include "measured/files/universal_modes.hpp"

#include "arm/input_error.hpp"
#include "measured/files/delimited_line.hpp"
#include "measured/files/number_cell.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace flexarm::measured {

namespace {

using arm::InputError;

constexpr std::size_t kDefinition = 5;  // place of record 6
constexpr std::size_t kIntegers = 6;
constexpr std::size_t kReals = 7;
constexpr std::size_t kIntegerWidth = 10;
constexpr std::size_t kRealWidth = 13;

/// The numbers of a record by columns of a width, or between blanks where these are none.
template <class T>
std::vector<T> fields_of(std::string_view line, std::size_t width) {
  std::vector<T> by_columns;
  bool fits = true;
  for (std::string_view rest = line; !trimmed(rest).empty();) {
    const auto value = number_cell<T>(trimmed(rest.substr(0, width)));
    fits = fits && value;
    by_columns.push_back(value.value_or(T{}));
    rest.remove_prefix(std::min(width, rest.size()));
  }
  if (fits) return by_columns;
  std::vector<T> by_blanks;
  LineSplitter splitter(' ');
  for (const auto cell : splitter.split(line)) {
    const auto value = number_cell<T>(cell);
    if (!value) throw InputError(fmt::format("{}: must be a number", arm::shown(cell)));
    by_blanks.push_back(*value);
  }
  return by_blanks;
}

ModalEntry pole_at(double frequency_Hz, double damping_ratio) {
  ModalEntry pole;
  pole.frequency_Hz = frequency_Hz;
  if (damping_ratio != 0.0) pole.damping_ratio = damping_ratio;
  return pole;
}

}  // namespace

UniversalMode read_universal_mode(std::span<const std::string_view> lines) {
  if (lines.size() <= kReals) throw InputError("data set 55 incomplete: records 1 to 8 are due");
  const auto definition = fields_of<int>(lines[kDefinition], kIntegerWidth);
  const int analysis = definition.size() > 1 ? definition[1] : 0;
  constexpr int kNormal = 2;
  constexpr int kComplex = 3;
  constexpr int kComplexSecondOrder = 7;
  const bool is_complex = analysis == kComplex || analysis == kComplexSecondOrder;
  if (analysis != kNormal && !is_complex) {
    return {std::nullopt, fmt::format("data set 55 of analysis type {}, no modes", analysis)};
  }
  const auto reals = fields_of<double>(lines[kReals], kRealWidth);
  if (reals.size() < 2) throw InputError("data set 55: record 8 must have two numbers or more");
  double frequency_Hz = reals[0];
  double damping_ratio = 0.0;
  if (is_complex) {
    const double size_rad_per_s = std::hypot(reals[0], reals[1]);
    frequency_Hz = size_rad_per_s / (2.0 * std::numbers::pi);
    damping_ratio = size_rad_per_s > 0.0 ? -reals[0] / size_rad_per_s : 0.0;
  } else {
    if (reals.size() > 2) damping_ratio = reals[2];
    if (damping_ratio == 0.0 && reals.size() > 3) damping_ratio = 0.5 * reals[3];
  }
  const auto integers = fields_of<int>(lines[kIntegers], kIntegerWidth);
  const std::string mode = integers.size() > 3 ? fmt::format("mode {}", integers[3]) : "a mode";
  if (!std::isfinite(frequency_Hz) || !std::isfinite(damping_ratio)) {
    throw InputError(fmt::format("{} at {} Hz: must be a finite number", mode, frequency_Hz));
  }
  if (frequency_Hz <= 0.0) return {std::nullopt, mode + " at 0 Hz, of the rigid body"};
  if (std::abs(damping_ratio) > 1.0) {
    throw InputError(fmt::format(
        "{} at {} Hz: damping ratio {}: must be from -1 to 1, a fraction, not in per cent", mode,
        frequency_Hz, damping_ratio));
  }
  return {pole_at(frequency_Hz, damping_ratio), "shape of " + mode};
}

}  // namespace flexarm::measured
