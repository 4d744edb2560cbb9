#pragma once

#include "compare/identification.hpp"
#include "measured/run_identification.hpp"
#include "report/tables/table.hpp"

#include <string>
#include <vector>

namespace flexarm::report {

/// A line a fit whose poles and zeros are not to be relied on: it did not converge, or is
/// unphysical.
std::vector<std::string> doubts(const measured::Identification& identification);

/// A line a fault found in a run, and why runs or fits were refused.
std::vector<std::string> data_notes(const measured::Identification& identification);

/// The settings of a run's spectra, each with its value and reason.
std::vector<std::string> setting_lines(const measured::RunIdentification& run);

/// Tables 6 and 7: hub slopes by (48) and, of the modes fitted, by (47), whose product goes on
/// beyond them; accelerometer gains by (49) and, other modes taken for nothing, by (52); beside
/// those of the formulations.
Table gain_table(const measured::RunsFit& fit, const compare::IdentifiedCondition& condition);

/// Each sensor's noise and what is left of it beside noise.
Table residual_table(const measured::RunsFit& fit);

/// Odd and even distortion of a run whose torque repeats itself; empty where it was not testable.
Table distortion_table(const measured::RunIdentification& run);

/// The runs of a fit.
std::vector<std::string> ids_of(const measured::RunsFit& fit,
                                const measured::Identification& identification);

/// "random-low+random-high".
std::string joined(const std::vector<std::string>& run_ids);

}  // namespace flexarm::report
