#pragma once

#include "diagnose/diagnosis.hpp"
#include "report/figures/figure.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace flexarm::report {

/// Figures of a diagnosis, and what is not drawn.
struct DiagnosisPlots {
  std::vector<NamedFigure> plots;
  std::string left_out;  ///< a sentence; empty where every run was drawn
};

/// Of each of the first `kMostDrawnRuns` predicted runs in time "overlay-RUN" (`overlay_figure`),
/// of as many `frf` runs "frf-RUN-SENSOR"; "hub-torque" where a dependence of the residual torque
/// on the hub's motion was found (`hub_torque_figure`); "hub-law" with an empirical law
/// (`hub_law_figure`); "missing-force" where ports of a missing force were tested
/// (`missing_force_figure`).
DiagnosisPlots diagnosis_plots(const diagnose::Experiment& experiment,
                               const diagnose::Diagnosis& diagnosis);
inline constexpr std::size_t kMostDrawnRuns = 6;
/// Of these each sensor has a figure of its own.
inline constexpr std::size_t kMostDrawnResponses = 12;

/// Residual torque of one run against hub velocity and against hub angle: samples, means of equally
/// many samples with two standard errors, and what the regression found.
Figure hub_torque_figure(const diagnose::HubTorque& torque, const diagnose::HubTorqueTrace& trace);

}  // namespace flexarm::report
