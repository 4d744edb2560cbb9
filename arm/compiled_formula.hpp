#pragma once

#include "arm/ports.hpp"

#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace flexarm::arm {

/// A formula over the hub's state and numbers of its own: "-c*omega*abs(omega) - F*sign(omega)".
///
/// The grammar is muParser's: + - * / ^, comparisons, && ||, ?:, sin, cos, tan, asin, acos, atan,
/// atan2, sinh, ..., exp, ln, log2, log10, sqrt, abs, sign, rint, min, max, sum, avg. Variables are
/// theta [rad], omega [rad/s], tau [N m] and t [s], the four of HubState in their order; pi is a
/// constant.
///
/// sign(omega) stands for the direction of motion, which is given: at omega = 0 it is that of the
/// motion to come.
class CompiledFormula {
 public:
  /// Throws InputError that says what is wrong: for a text that is no formula, with an unknown
  /// variable or function, without a key; for a number that does not stand in it, or whose name is
  /// none, with that name as the key.
  CompiledFormula(const std::string& text, const std::vector<std::string>& numbers);
  ~CompiledFormula();
  CompiledFormula(const CompiledFormula&) = delete;
  CompiledFormula& operator=(const CompiledFormula&) = delete;

  /// The value; `direction` is -1 or 1, `numbers` in the order given above. Not finite where the
  /// formula has no value. Any number of threads may ask at once: each has a parser of its own.
  double operator()(const HubState& hub, double direction, std::span<const double> numbers) const;

  /// Whether "theta", "omega", "tau" or "t" stands in it; the omega of sign(omega) does not count.
  bool uses(const std::string& variable) const { return variables_.contains(variable); }
  bool has_direction() const { return has_direction_; }
  /// Sums, products, quotients and powers alone: two of them that agree in many places are equal.
  bool is_algebraic() const { return is_algebraic_; }

 private:
  class Parser;
  struct Parsers;  // one a thread

  std::set<std::string> variables_;
  bool has_direction_ = false;
  bool is_algebraic_ = true;
  std::unique_ptr<Parsers> parsers_;
};

/// The names of the four variables, in the order of HubState.
const std::vector<std::string>& formula_variables();

}  // namespace flexarm::arm
