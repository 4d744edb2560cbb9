#include "measured/files/universal_grid.hpp"

#include "arm/number.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

namespace flexarm::measured {

namespace {

constexpr int kDecimals = 5;
/// Powers of ten and whole numbers below these are doubles.
constexpr int kLargestPower = 22;
constexpr double kLargestWhole = 0x1p53;

std::string six_digits(double value) {
  return fmt::format("{:.{}e}", value, kDecimals);
}

double power_of_ten(int exponent) {
  double power = 1.0;
  for (int i = 0; i < exponent; ++i) power *= 10.0;
  return power;
}

/// A number of 6 digits as whole * 10^-places.
struct Decimal {
  double whole = 0.0;
  int places = 0;
};

Decimal decimal_of(double value) {
  const std::string text = six_digits(value);
  const auto e = text.find('e');
  std::string digits = text.substr(0, e);
  digits.erase(digits.find('.'), 1);
  Decimal decimal{*arm::parse_number<double>(digits), kDecimals};
  std::string_view exponent = std::string_view(text).substr(e + 1);
  if (exponent.front() == '+') exponent.remove_prefix(1);
  decimal.places -= *arm::parse_number<int>(exponent);
  return decimal;
}

/// n where 1/n and no other has the digits of the step, but is another number.
std::optional<double> whole_rate(double step) {
  if (!(step > 0.0 && step < 1.0)) return std::nullopt;
  const double rate = std::round(1.0 / step);
  if (1.0 / rate == step) return std::nullopt;
  const std::string text = six_digits(step);
  const auto fits = [&](double n) { return n >= 1.0 && six_digits(1.0 / n) == text; };
  if (!fits(rate) || fits(rate - 1.0) || fits(rate + 1.0)) return std::nullopt;
  return rate;
}

}  // namespace

double in_six_digits(double value) {
  return *arm::parse_number<double>(six_digits(value));
}

std::string fortran_number(double value, int width, int decimals) {
  std::string text = fmt::format("{:.{}E}", value, decimals);
  return fmt::format("{:>{}}", text, width);
}

std::vector<double> grid_points(const UniversalGrid& grid, std::size_t count) {
  std::vector<double> points(count);
  const auto fill = [&](auto&& point) {
    for (std::size_t k = 0; k < count; ++k) points[k] = point(static_cast<double>(k));
  };
  const auto plain = [&](double k) { return grid.first + k * grid.step; };
  const bool is_short =
      in_six_digits(grid.step) == grid.step && in_six_digits(grid.first) == grid.first;
  if (!is_short) {
    fill(plain);
    return points;
  }
  if (const auto rate = whole_rate(grid.step)) {
    fill([&](double k) { return grid.first + k / *rate; });
    return points;
  }
  const Decimal first = decimal_of(grid.first);
  const Decimal step = decimal_of(grid.step);
  // A first value of 0 has any number of places.
  const int places = first.whole == 0.0 ? step.places : std::max(first.places, step.places);
  const int least = first.whole == 0.0 ? places : std::min(first.places, step.places);
  if (places < 0 || places > kLargestPower || places - least > kLargestPower) {
    fill(plain);
    return points;
  }
  const double scaled_first =
      first.whole == 0.0 ? 0.0 : first.whole * power_of_ten(places - first.places);
  const double scaled_step = step.whole * power_of_ten(places - step.places);
  const double largest =
      std::abs(scaled_first) + static_cast<double>(count) * std::abs(scaled_step);
  if (!(largest < kLargestWhole)) {
    fill(plain);
    return points;
  }
  // Both terms are whole, so that the division alone rounds.
  const double divisor = power_of_ten(places);
  fill([&](double k) { return (scaled_first + k * scaled_step) / divisor; });
  return points;
}

}  // namespace flexarm::measured
