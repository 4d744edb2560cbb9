#pragma once

#include "compare/identification.hpp"
#include "measured/run_identification.hpp"
#include "report/page/page_document.hpp"

#include <vector>

namespace flexarm::report::page {

/// An identification with what the arm should show.
struct IdentifiedRuns {
  const measured::Identification& identification;
  const std::vector<compare::IdentifiedCondition>& conditions;
  const std::vector<measured::MeasuredRun>& recorded;  ///< the runs as they were read
};

/// Measured frequency responses with coherence and noise, the fit, and the arm file; a view a run
/// and sensor.
CurvesBlock identified_responses(const IdentifiedRuns& runs);

/// Autopower spectra of input and sensors; a view a run.
CurvesBlock autopower_spectra(const IdentifiedRuns& runs);

/// Poles and zeros, each by its best method, with standard errors beside those of the arm file; a
/// block a payload and sensor.
std::vector<MapBlock> identified_maps(const IdentifiedRuns& runs);

/// Poles over the order of the model, by what is stable; a view a fit.
ScatterBlock stabilisation_charts(const IdentifiedRuns& runs);

/// Resonances in the Nyquist diagram with their circles; a view a run, sensor and resonance.
ScatterBlock nyquist_circles_block(const IdentifiedRuns& runs);

/// Torque and sensors over time as recorded; a view a run and signal.
CurvesBlock recorded_signals(const IdentifiedRuns& runs);

}  // namespace flexarm::report::page
