#pragma once

#include "report/page/diagnosed_channels.hpp"

namespace flexarm::report::page {

/// Returns the frequency responses from the torque, or from the motion of the hub, to each sensor,
/// measured beside simulated, with coherence and, below, the relative difference; a view a run and
/// sensor.
///
/// `frf` runs as they are. Of `time` runs the responses are estimated (measured/spectra), those of
/// the simulated signals with the settings and the estimator of the measured ones, so that leakage,
/// noise and nonlinear effects are in all of them alike. Runs whose responses cannot be estimated
/// have no view.
CurvesBlock diagnosed_responses(const std::vector<DiagnosedChannel>& frequency_channels,
                                const std::vector<DiagnosedChannel>& time_channels,
                                bool has_causes);

}  // namespace flexarm::report::page
