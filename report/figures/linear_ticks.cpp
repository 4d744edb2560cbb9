#include "report/figures/linear_ticks.hpp"

#include "report/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace flexarm::report {
namespace {

constexpr int kMostTicks = 9;
constexpr int kFewestTicks = 2;
constexpr double kRounding = 1e-9;  // relative to the step: a limit that is a tick has it

/// Power of ten, a multiple of three, in which numbers up to `largest` have few digits; 0 where
/// they have few without.
int exponent_for(double largest) {
  const double decade = std::floor(std::log10(largest));
  const bool is_plain = decade >= -2.0 && decade < 5.0;
  return is_plain ? 0 : 3 * static_cast<int>(std::floor(decade / 3.0));
}

std::string number_text(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", std::abs(value), decimals);
  return value < 0.0 && text.find_first_not_of("0.") != std::string::npos ? "−" + text : text;
}

/// The ticks a step of 10^decade times `digit` apart.
LinearTicks ticks_apart(const Range& range, int digit, int decade) {
  const double step = digit * std::pow(10.0, decade);
  LinearTicks made;
  made.exponent = exponent_for(std::max(std::abs(range.from), std::abs(range.to)));
  const int decimals = std::max(0, made.exponent - decade);
  for (double k = std::ceil(range.from / step - kRounding); k * step <= range.to + kRounding * step;
       k += 1.0) {
    const double scaled = k * digit * std::pow(10.0, decade - made.exponent);
    made.ticks.push_back({k * step, k == 0.0 ? "0" : number_text(scaled, decimals)});
  }
  return made;
}

}  // namespace

LinearTicks linear_ticks(const Range& range, double length_px,
                         const std::function<double(const std::string&)>& room_px) {
  const double width = range.to - range.from;
  int decade = static_cast<int>(std::floor(std::log10(width / kMostTicks)));
  LinearTicks last;
  for (;; ++decade) {
    for (const int digit : {1, 2, 5}) {
      const double step = digit * std::pow(10.0, decade);
      if (width / step > kMostTicks) continue;
      LinearTicks made = ticks_apart(range, digit, decade);
      if (made.ticks.size() < kFewestTicks && !last.ticks.empty()) return last;
      double widest = 0.0;
      for (const Tick& tick : made.ticks) widest = std::max(widest, room_px(tick.label));
      if (widest * width / step <= length_px || made.ticks.size() <= kFewestTicks) return made;
      last = std::move(made);
    }
  }
}

std::string scaled_unit(int exponent, const std::string& unit) {
  if (exponent == 0) return unit;
  const std::string power = "10" + superscript(exponent);
  return unit.empty() ? power : power + " " + unit;
}

}  // namespace flexarm::report
