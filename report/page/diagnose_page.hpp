#pragma once

#include "diagnose/diagnosis.hpp"
#include "report/page/page_document.hpp"
#include "report/page/page_origin.hpp"

namespace flexarm::report::page {

/// The report of a diagnosis: verdict and worst channel, causes and what is indistinguishable, what
/// the arm file gets wrong, signals, residuals, responses, poles and zeros, residual hub torque,
/// predictions.
PageDocument diagnose_page(const diagnose::Experiment& experiment,
                           const diagnose::Diagnosis& diagnosis, const PageOrigin& origin);

}  // namespace flexarm::report::page
