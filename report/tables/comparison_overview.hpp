#pragma once

#include "compare/comparison.hpp"
#include "report/tables/table.hpp"

namespace flexarm::report {

/// The roots of the first model, a column a family: frequencies [Hz] of roots on the imaginary
/// axis, s [rad/s] of those on the real axis, |s|/2 pi [Hz] of complex ones. Sensors with equal
/// zeros share a column.
Table roots_overview(const compare::Comparison& comparison);

/// One row a family of roots, the mode shapes and the responses of each sensor: how
/// many were compared, and the largest relative difference of each further model from the first.
Table agreement_overview(const compare::Comparison& comparison);

/// What lies beyond its tolerance, or is missing in a model, the largest excess first; without rows
/// where the models agree.
Table disagreements_table(const compare::Comparison& comparison);

}  // namespace flexarm::report
