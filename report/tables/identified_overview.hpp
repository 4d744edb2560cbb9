#pragma once

#include "report/tables/identified_root_tables.hpp"

namespace flexarm::report {

/// One row a root, by the method that determines it best: a rational fit, else circles, responses,
/// autopower spectra; of several sensors, the one with the smallest standard error. Frequency and
/// damping ratio with their standard errors, beside the analytical ones. Roots of that method that
/// stand for no analytical root follow, at most five of a kind. Without rows where nothing was
/// read.
Table identified_overview(const IdentifiedData& data);

}  // namespace flexarm::report
