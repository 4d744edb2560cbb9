#pragma once

#include "report/json/comparison_json.hpp"
#include "report/page/page_document.hpp"
#include "report/page/page_origin.hpp"

#include <vector>

namespace flexarm::report::page {

/// The report of a comparison: frequency responses with the differences of the formulations, poles
/// and zeros beside measured ones, mode shapes, convergence, and poles and zeros over the payload.
/// Sections of each arm where there are several. `arms` is not empty.
PageDocument compare_page(const std::vector<ComparedArm>& arms, const PageOrigin& origin);

}  // namespace flexarm::report::page
