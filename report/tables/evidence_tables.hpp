#pragma once

#include "diagnose/diagnosis.hpp"
#include "report/tables/table.hpp"

#include <string>

namespace flexarm::report {

/// Returns whether the causes have grades: those of the ranked search have.
bool has_grades(const diagnose::Diagnosis& diagnosis);

/// Returns the verdict of a diagnosis with grades in two or three sentences: the causes with values
/// and grades, the NRMSE of the validation runs (of the estimation runs without any) before and
/// after, and where the largest excess residual is.
std::string graded_verdict_text(const diagnose::Diagnosis& diagnosis);

/// Returns what is lost without each cause, and how its estimates agree between runs: a row a
/// cause; no rows without grades.
Table loss_table(const diagnose::Diagnosis& diagnosis);

}  // namespace flexarm::report
