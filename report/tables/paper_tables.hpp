#pragma once

#include "compare/paper/paper_topics.hpp"
#include "report/tables/table.hpp"

#include <string>

namespace flexarm::report {

/// The quantities of one check, one row each: printed, corrected, and from each formulation. A
/// value that is zero within the tolerance is shown as 0.
Table paper_values(const compare::paper::Check& check);

/// One row a check: what it states and the verdict.
Table paper_overview(const compare::paper::Findings& findings);

/// The cells of Tables 2-5 that do not follow from the cells they are made of.
Table paper_cells(const compare::paper::Findings& findings);

/// Every quantity in one table with full precision, for CSV.
Table paper_listing(const compare::paper::Findings& findings);

/// How many cells there are, and how many do not follow, one sentence.
std::string paper_cells_line(const compare::paper::Findings& findings);

/// How many checks there are of each verdict, one sentence.
std::string paper_verdict_line(const compare::paper::Findings& findings);

/// True when `label` names `part`: a number of an equation, within a range too ("(21)-(23)" names
/// 22), or any part of the label's text, in either case ("table 6").
bool names_part(const std::string& label, const std::string& part);

/// Everything for a terminal; when `part` is not empty only the checks that `names_part`, and empty
/// when there are none.
std::string paper_text(const compare::paper::Findings& findings, const std::string& part);

}  // namespace flexarm::report
