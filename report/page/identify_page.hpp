#pragma once

#include "compare/identification.hpp"
#include "measured/run_identification.hpp"
#include "report/page/page_document.hpp"
#include "report/page/page_origin.hpp"

#include <vector>

namespace flexarm::report::page {

/// The report of an identification: responses with fit and arm file, poles and zeros with standard
/// errors beside those of the arm file, spectra, stabilisation chart, circles, and the recordings
/// with what was found in them. `recorded` are the runs as they were read.
PageDocument identify_page(const measured::Identification& identification,
                           const std::vector<compare::IdentifiedCondition>& conditions,
                           const std::vector<measured::MeasuredRun>& recorded,
                           const PageOrigin& origin);

}  // namespace flexarm::report::page
