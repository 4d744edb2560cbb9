#include "arm/formula_syntax.hpp"

#include "arm/ascii.hpp"
#include "arm/input_error.hpp"

#include <fmt/format.h>

#include <muParser.h>

namespace flexarm::arm {

bool begins_number(std::string_view formula, std::size_t at) {
  return is_digit(formula[at]) ||
         (formula[at] == '.' && at + 1 < formula.size() && is_digit(formula[at + 1]));
}

std::size_t number_end(std::string_view formula, std::size_t at) {
  std::size_t end = at;
  const auto skip = [&] {
    while (end < formula.size() && (is_digit(formula[end]) || formula[end] == '.')) ++end;
  };
  skip();
  if (end >= formula.size() || (formula[end] != 'e' && formula[end] != 'E')) return end;
  std::size_t exponent = end + 1;
  if (exponent < formula.size() && (formula[exponent] == '+' || formula[exponent] == '-')) {
    ++exponent;
  }
  if (exponent < formula.size() && is_digit(formula[exponent])) {
    end = exponent;
    skip();
  }
  return end;
}

std::string syntax_fault(const mu::ParserError& error, std::string_view operand,
                         std::string_view formula, std::size_t place) {
  switch (error.GetCode()) {
    case mu::ecMISSING_PARENS:
      return "a parenthesis is not closed";
    case mu::ecUNEXPECTED_EOF:
    case mu::ecEMPTY_EXPRESSION:
      return fmt::format("ends where a number, {} or a function must follow", operand);
    case mu::ecTOO_MANY_PARAMS:
      return "a function has too many arguments";
    case mu::ecTOO_FEW_PARAMS:
      return "a function has too few arguments";
    default:
      break;
  }
  if (place >= formula.size()) return "cannot be read at its end";
  return fmt::format("cannot be read at character {}, {}", place + 1, shown(formula.substr(place)));
}

}  // namespace flexarm::arm
