#include "compare/paper/paper_check.hpp"

#include <cmath>
#include <utility>

namespace flexarm::compare::paper {

namespace {

bool agrees(const std::optional<double>& value, const Comparison& comparison) {
  return !value || std::abs(*value - comparison.corrected) <= comparison.tolerance;
}

}  // namespace

std::string_view to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::holds:
      return "holds";
    case Verdict::harmless_misprint:
      return "harmless misprint";
    case Verdict::slip_of_print:
      return "misprint";
    case Verdict::slip_of_algebra:
      return "algebra error";
    case Verdict::does_not_follow:
      return "not reproducible";
  }
  return "";
}

Comparison comparison(std::string quantity, std::string unit, std::optional<double> printed,
                      double corrected, ByFormulation formulations, double relative_tolerance) {
  return {.quantity = std::move(quantity),
          .unit = std::move(unit),
          .printed = printed,
          .corrected = corrected,
          .formulations = formulations,
          .tolerance = relative_tolerance * std::abs(corrected)};
}

Comparison against_print(std::string quantity, std::string unit, const PrintedNumber& printed,
                         double corrected, ByFormulation formulations) {
  return {.quantity = std::move(quantity),
          .unit = std::move(unit),
          .printed = printed.value,
          .corrected = corrected,
          .formulations = formulations,
          .tolerance = 0.5 * std::pow(10.0, -printed.decimals)};
}

bool formulations_agree(const Comparison& comparison) {
  const auto& from = comparison.formulations;
  return agrees(from.exact_tf, comparison) && agrees(from.fem, comparison) &&
         agrees(from.assumed_modes, comparison);
}

bool printed_agrees(const Comparison& comparison) {
  return agrees(comparison.printed, comparison);
}

}  // namespace flexarm::compare::paper
