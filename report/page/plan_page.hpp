#pragma once

#include "diagnose/planning/plan.hpp"
#include "report/page/page_document.hpp"
#include "report/page/page_origin.hpp"

namespace flexarm::report::page {

/// The report of a plan: which effects its runs detect and distinguish, what is indistinguishable,
/// expected standard errors, and further runs.
PageDocument plan_page(const diagnose::Plan& plan, const PageOrigin& origin);

}  // namespace flexarm::report::page
