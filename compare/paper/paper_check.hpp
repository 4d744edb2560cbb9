#pragma once

#include "compare/paper/paper_tables.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::compare::paper {

/// What a check of the paper comes to.
enum class Verdict {
  holds,
  harmless_misprint,  ///< a letter, an index or a limit is wrong; no value changes
  slip_of_print,      ///< what is meant can be seen; evaluated as printed it is wrong
  slip_of_algebra,    ///< the step that leads to it is wrong
  does_not_follow,    ///< a figure that the paper's own equations and tables do not give
};

/// "holds", "harmless misprint", "slip of print", "slip of algebra", "does not follow".
std::string_view to_string(Verdict verdict);

/// The same quantity from each formulation; empty where a formulation has no such quantity.
struct ByFormulation {
  std::optional<double> exact_tf;
  std::optional<double> fem;
  std::optional<double> assumed_modes;
};

/// One quantity that an equation gives: evaluated as printed, as corrected, and by the formulations
/// without that equation.
struct Comparison {
  std::string quantity;
  std::string unit;               ///< "1" for a ratio
  std::optional<double> printed;  ///< empty: the printed form cannot be evaluated
  double corrected = 0.0;
  ByFormulation formulations;
  /// Two values a and b agree when |a - b| <= tolerance, in `unit`.
  double tolerance = 0.0;
};

/// A comparison whose tolerance is a part of the corrected value.
Comparison comparison(std::string quantity, std::string unit, std::optional<double> printed,
                      double corrected, ByFormulation formulations, double relative_tolerance);

/// A figure of the paper's tables: the tolerance is half a unit of its last decimal.
Comparison against_print(std::string quantity, std::string unit, const PrintedNumber& printed,
                         double corrected, ByFormulation formulations);

/// Every value given agrees with the corrected one, the printed one aside.
bool formulations_agree(const Comparison& comparison);
/// The printed value, if any, agrees with the corrected one.
bool printed_agrees(const Comparison& comparison);

/// One equation, remark or table of the paper.
struct Check {
  std::string label;      ///< "(22)", "(18)-(19)", "small epsilon", "Table 6"
  std::string statement;  ///< what it says, in a few words
  Verdict verdict = Verdict::holds;
  std::string finding;  ///< the slip, or why it holds
  std::vector<Comparison> comparisons;
};

/// Checks that belong together; `name` is a word for documents and JSON.
struct Topic {
  std::string name;
  std::string title;
  std::vector<Check> checks;
};

}  // namespace flexarm::compare::paper
