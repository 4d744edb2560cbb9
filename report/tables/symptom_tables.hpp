#pragma once

#include "diagnose/symptoms/symptoms.hpp"
#include "report/tables/table.hpp"
#include "report/terminal.hpp"

#include <cstddef>
#include <string>

namespace flexarm::report {

/// The section "What is wrong" for a terminal: the most significant statement of each kind, then
/// others by their significance, whole ones up to about `most_lines` of `max_width` columns. Empty
/// without any statement.
std::string what_is_wrong_text(const diagnose::Symptoms& symptoms, std::size_t most_lines = 14,
                               std::size_t max_width = kPipeWidth);

/// All statements with their significance.
Table symptom_table(const diagnose::Symptoms& symptoms);
/// The error by run, sensor and band, per cent of the signal.
Table band_table(const diagnose::Symptoms& symptoms);
/// The error by regime, by quantity and ascending.
Table regime_table(const diagnose::Symptoms& symptoms);
/// The error by regime, the significant regimes first, those with most of the excess residual
/// before others.
Table where_it_fails_table(const diagnose::Symptoms& symptoms);
/// Poles and zeros, measured and simulated.
Table root_shift_table(const diagnose::Symptoms& symptoms);
/// What the residual torque at the hub was tested for.
Table hub_torque_table(const diagnose::Symptoms& symptoms);
/// A parameter run by run.
Table run_value_table(const diagnose::Symptoms& symptoms);
/// Odd and even distortion by run and sensor.
Table distortion_table(const diagnose::Symptoms& symptoms);

}  // namespace flexarm::report
