#pragma once

#include "report/tables/identified_root_tables.hpp"

namespace flexarm::report {

/// One row a pole, by the method that determines it best: a rational fit, else circles, responses,
/// autopower spectra; of several sensors, the one with the smallest standard error. Frequency and
/// damping ratio with their standard errors, beside the analytical ones. Poles of these methods
/// that stand for no analytical pole follow, at most five. Without rows where none was read.
Table identified_poles_overview(const IdentifiedData& data);

/// The same of the zeros of each sensor, without damping.
Table identified_zeros_overview(const IdentifiedData& data);

}  // namespace flexarm::report
