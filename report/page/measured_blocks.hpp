#pragma once

#include "report/page/comparison_blocks.hpp"

namespace flexarm::report::page {

/// Measured frequency responses beside those of every formulation, with coherence and, below, the
/// relative difference; a view an arm, run and sensor. No views where no response was measured.
CurvesBlock measured_responses(const std::vector<NamedArm>& arms);

/// Measured signals of `time` runs over their simulation, the residual below; a view an arm, run and
/// channel. No views without such runs.
CurvesBlock measured_runs(const std::vector<NamedArm>& arms);

/// Of one arm: measured poles, zeros, damping ratios, responses and mode shapes beside the models.
/// Without content where nothing was measured.
void add_measured_tables(Section& section, const NamedArm& arm);

}  // namespace flexarm::report::page
