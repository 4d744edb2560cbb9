#pragma once

#include "compare/comparison.hpp"
#include "compare/measured_responses.hpp"
#include "compare/measured_verdict.hpp"
#include "report/tables/table.hpp"

#include <string>
#include <vector>

namespace flexarm::report {

/// Measured poles and zeros beside the models: frequency, its standard deviation, the first model's
/// frequency, and by how many standard deviations each model is off. `models` are the names.
Table measured_table(const std::vector<compare::MeasuredRow>& rows,
                     const std::vector<std::string>& models);

/// Measured damping ratios of poles and zeros beside those of the damped roots of the first model;
/// without rows where none was measured.
Table measured_damping_table(const std::vector<compare::MeasuredRow>& rows);

/// How many of the differences are within two standard deviations, and whether the uncertain
/// numbers of the arm file are among these; empty where no standard deviation is known.
std::string measured_summary(const std::vector<compare::MeasuredRow>& rows);

/// Fit and NRMSE of each signal of the `time` runs beside their simulation.
Table measured_runs_table(const std::vector<compare::MeasuredTimeRun>& runs);

/// Returns a sentence on the work that the time limit left no time for; empty without any.
std::string out_of_time_text(const compare::Comparison& comparison,
                             const compare::MeasuredComparison& measured);

/// Measured and simulated signals of one run over time, for CSV.
Table measured_run_listing(const compare::MeasuredTimeRun& run);

/// The verdict on a measurement of which something was compared, in one line: "Measurement: agrees
/// with exact_tf." or "Measurement: DIFFERS from the model.", and the largest differences.
std::string measured_verdict_line(const compare::MeasuredVerdict& verdict);

/// Measured frequency responses against each model's, one row each.
Table measured_response_table(const std::vector<compare::MeasuredResponse>& responses);

/// The MAC matrix of the first model: measured modes down, computed ones across.
Table mac_table(const compare::ShapeCorrelation& shapes);

/// Every value of the matrices of all models, for CSV.
Table mac_listing(const std::vector<compare::ShapeCorrelation>& shapes);

}  // namespace flexarm::report
