#pragma once

#include "compare/comparison.hpp"
#include "report/tables/table.hpp"

#include <vector>

namespace flexarm::report {

/// The models of a comparison: name, settings, degrees of freedom.
Table subjects_table(const compare::Comparison& comparison);

/// One table a family: each root from each formulation, with its distance from the first's. Roots
/// on the imaginary axis are shown as frequencies [Hz], roots on the real axis as s [rad/s].
std::vector<Table> root_tables(const compare::Comparison& comparison);

/// Every root in one table with full precision, for CSV.
Table root_listing(const compare::Comparison& comparison);

/// How many roots each model gave, and how many of a discrete model were rejected.
Table notes_table(const compare::Comparison& comparison);

/// Per family, one row a refinement series: order of convergence, floor, cheapest setting.
std::vector<Table> convergence_tables(const compare::Comparison& comparison);

/// What the columns of `convergence_tables` say: a paragraph.
std::string convergence_legend(const compare::Comparison& comparison);

/// One row a root and series, for CSV and for `--full`.
Table convergence_listing(const compare::Comparison& comparison);

/// Every point of every refinement curve, for CSV.
Table refinement_listing(const compare::Comparison& comparison);

/// Mode shapes and hub slopes against the first model's.
Table shapes_table(const compare::Comparison& comparison);

/// Mode shapes of every model at the stations, for CSV.
Table shapes_listing(const compare::Comparison& comparison);

/// Largest difference of responses off resonance.
Table responses_table(const compare::Comparison& comparison);

/// Responses over frequency, for CSV.
Table responses_listing(const compare::Comparison& comparison);

/// The verdict on the formulations in one line, which begins "Verdict: agree." or, beside that on a
/// measurement, "Formulations: agree."
std::string verdict_line(const compare::Comparison& comparison, bool beside_measurement = false);

}  // namespace flexarm::report
