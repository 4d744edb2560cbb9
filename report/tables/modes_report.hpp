#pragma once

#include "arm/arm.hpp"
#include "report/figures/figure.hpp"
#include "report/tables/table.hpp"
#include "response/modal_summary.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace flexarm::report {

/// Poles with frequency, lambda, hub slope, tip displacement and projected damping ratio.
Table poles_table(const arm::Arm& arm, const response::ModalSummary& summary);

/// The two poles of the lowest mode (0) and of each flexible one, with damping.
Table damped_poles_table(const response::ModalSummary& summary);

/// What holds the hub, in a line: the frequency of the lowest mode, or the rate at which the arm
/// falls; empty for an arm that turns freely.
std::string lowest_mode_line(const response::ModalSummary& summary);

/// Zeros of every sensor asked for, as frequency on the imaginary axis or s on the real one.
Table zeros_table(const response::ModalSummary& summary);

/// Displacements of the modes over x, one column a mode.
Table shapes_over_x_table(const response::ModalSummary& summary);

/// The shapes of the first eight modes.
Figure shapes_figure(const std::string& formulation, const response::ModalSummary& summary);

/// Members `lowest_omega_squared_rad2_per_s2`, `damped_poles`, `stations_m`, `modes`, `zeros` of an
/// arm in schema `flexarm.modes/1` (docs/json.md).
nlohmann::ordered_json modes_json(const arm::Arm& arm, const response::ModalSummary& summary);

}  // namespace flexarm::report
