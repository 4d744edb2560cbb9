#pragma once

#include "compare/sweeps/sweep_result.hpp"
#include "report/tables/table.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::report {

/// "payload.mass from 0 to 0.5 kg, 200 values"; one line an axis.
std::string sweep_axes_lines(const compare::SweepResult& result);

/// The models of a sweep: name, settings, degrees of freedom.
Table sweep_models_table(const compare::SweepResult& result);

/// One table for the poles, of a damped arm two for those with damping, one for each sensor's
/// zeros; a row each: its first, last, lowest and highest value by the first model, and where.
/// Poles and collocated zeros are frequencies [Hz]; other zeros |s| [rad/s].
std::vector<Table> sweep_range_tables(const compare::SweepResult& result);

/// The same of hub slopes and end-point values; empty where they were not asked for.
std::vector<Table> sweep_mode_tables(const compare::SweepResult& result);

/// What happens to tracks of zeros, and where: `most` rows at most.
Table sweep_events_table(const compare::SweepResult& result, std::size_t most);

/// Worst relative difference of each model from the first, and where.
Table sweep_agreement_table(const compare::SweepResult& result);

/// The difference of all quantities that is largest beside its tolerance, a missing root before
/// all; null for one model.
const compare::SweepAgreement* largest_sweep_difference(const compare::SweepResult& result);

/// Whether the models agree, in one line.
std::string sweep_verdict_line(const compare::SweepResult& result);

/// Every value in long form as CSV: one row a point, model and root.
std::string sweep_csv(const compare::SweepResult& result);

/// "comes from beyond", "meets": what happens to a track, in words.
std::string_view word_for(compare::SweepEvent::Kind kind);

}  // namespace flexarm::report
