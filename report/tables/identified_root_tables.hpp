#pragma once

#include "compare/identification.hpp"
#include "measured/run_identification.hpp"
#include "report/tables/table.hpp"

#include <string>
#include <vector>

namespace flexarm::report {

/// What was read off a run, or off the runs of one fit, beside what the arm should show.
struct IdentifiedData {
  const measured::Identification& identification;
  const compare::IdentifiedCondition& condition;
  std::string runs;  ///< "random-low", "random-low+random-high"
};

/// The runs, and runs of fits, that the readings of a condition come from, each once.
std::vector<std::string> sources(const measured::Identification& identification,
                                 const compare::IdentifiedCondition& condition);

/// The table without the columns of what the arm predicts, where there is no arm.
Table without_predictions(Table table, const compare::IdentifiedCondition& condition);

/// Tables 2 to 4 of the paper: method, sensor, and for each analytical pole that any reading shows
/// the measured frequency, its standard error and its distance from the analytical one in per cent;
/// behind the sensors of a method their mean with the scatter between them. The last columns have,
/// where there are any, the poles that differ from those of a more accurate method
/// (report/tables/method_differences.hpp) and the peaks that stand for no analytical pole. Without
/// rows where no pole was read.
Table pole_table(const IdentifiedData& data);

/// The same of the antiresonances of each sensor, each beside its own analytical one.
Table zero_table(const IdentifiedData& data);

/// Poles with the hub held, read off responses to the hub's motion: frequency, its standard error,
/// distance from the analytical zero of the hub angle in per cent, and damping ratio.
Table held_pole_table(const IdentifiedData& data);

/// The paper's Table 5: damping ratios, in rows as in `pole_table`.
Table damping_table(const IdentifiedData& data);

/// Real zeros that a fit has, such as those of the tip, beside the analytical ones.
Table real_zero_table(const IdentifiedData& data);

}  // namespace flexarm::report
