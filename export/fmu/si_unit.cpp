#include "export/fmu/si_unit.hpp"

#include <charconv>
#include <cmath>
#include <numbers>

namespace flexarm::fmu {

namespace {

const std::map<std::string, SiUnit, std::less<>>& symbols() {
  static const std::map<std::string, SiUnit, std::less<>> all = {
      {"1", {}},
      {"kg", {{{"kg", 1}}}},
      {"m", {{{"m", 1}}}},
      {"s", {{{"s", 1}}}},
      {"A", {{{"A", 1}}}},
      {"K", {{{"K", 1}}}},
      {"rad", {{{"rad", 1}}}},
      {"rev", {{{"rad", 1}}, 2.0 * std::numbers::pi}},
      {"Hz", {{{"s", -1}}}},
      {"N", {{{"kg", 1}, {"m", 1}, {"s", -2}}}},
      {"Pa", {{{"kg", 1}, {"m", -1}, {"s", -2}}}},
      {"V", {{{"kg", 1}, {"m", 2}, {"s", -3}, {"A", -1}}}},
  };
  return all;
}

/// The symbol and exponent of "m^2".
bool multiply(std::string_view factor, int sign, SiUnit& to) {
  const std::size_t caret = factor.find('^');
  int exponent = 1;
  if (caret != std::string_view::npos) {
    const char* const end = factor.data() + factor.size();
    const auto [last, error] = std::from_chars(factor.data() + caret + 1, end, exponent);
    if (error != std::errc() || last != end) return false;
  }
  const auto symbol = symbols().find(factor.substr(0, caret));
  if (symbol == symbols().end()) return false;
  exponent *= sign;
  to.factor *= std::pow(symbol->second.factor, exponent);
  for (const auto& [base, power] : symbol->second.exponents) {
    if ((to.exponents[base] += power * exponent) == 0) to.exponents.erase(base);
  }
  return true;
}

}  // namespace

std::optional<SiUnit> parse_si_unit(std::string_view unit) {
  SiUnit made;
  int sign = 1;
  while (true) {
    const std::size_t end = unit.find_first_of(" /");
    if (!multiply(unit.substr(0, end), sign, made)) return std::nullopt;
    if (end == std::string_view::npos) return made;
    if (unit[end] == '/') {
      if (sign < 0) return std::nullopt;
      sign = -1;
    }
    unit.remove_prefix(end + 1);
  }
}

}  // namespace flexarm::fmu
