#pragma once

#include <map>
#include <string>
#include <vector>

namespace flexarm::arm {

/// A law of hub torque that an arm file states as a formula, `hub_torque = "-k*theta^3"`:
/// arm/compiled_formula.hpp says what may stand in it.
struct HubTorqueFormula {
  struct Number {
    std::string name;
    std::string unit = {};  ///< as the file gives it; empty: not given

    bool operator==(const Number&) const = default;
  };

  std::string text;
  std::vector<Number> numbers = {};  ///< that stand in it, ascending by name

  bool operator==(const HubTorqueFormula&) const = default;
};

/// Numbers from `lowest` to `highest`, which is above it.
struct Interval {
  double lowest = 0.0;
  double highest = 0.0;

  /// In ratio where all of it is above 0.
  double middle() const;

  bool operator==(const Interval&) const = default;
};

/// A stated law some of whose numbers are to be found.
struct HubTorqueHypothesis {
  HubTorqueFormula formula;
  std::map<std::string, Interval> ranges;    ///< of the numbers that are searched, one or more
  std::map<std::string, double> known = {};  ///< values of the others

  /// A value for every number: the known ones, and the middles of the ranges.
  std::map<std::string, double> typical() const;

  bool operator==(const HubTorqueHypothesis&) const = default;
};

}  // namespace flexarm::arm
