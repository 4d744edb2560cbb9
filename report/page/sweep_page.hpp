#pragma once

#include "compare/sweeps/sweep_result.hpp"
#include "report/page/page_document.hpp"
#include "report/page/page_origin.hpp"

namespace flexarm::report::page {

/// The report of a sweep: poles and zeros with a slider for the parameter, curves over it, events
/// and the agreement of the formulations.
PageDocument sweep_page(const compare::SweepResult& result, const PageOrigin& origin);

}  // namespace flexarm::report::page
