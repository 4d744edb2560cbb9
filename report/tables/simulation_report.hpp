#pragma once

#include "arm/arm.hpp"
#include "arm/controller.hpp"
#include "measured/files/time_record.hpp"
#include "report/figures/figure.hpp"
#include "report/tables/table.hpp"
#include "experiment/simulated_experiment.hpp"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>
#include <vector>

namespace flexarm::report {

using experiment::SimulatedRun;

/// Excitation, duration, peak and root mean square of the torque of each run.
Table torque_table(const std::vector<SimulatedRun>& runs);

/// Largest size, when, last value, noise and step error of each sensor of each run.
Table reading_table(const std::vector<SimulatedRun>& runs);

/// Where the energy went in each run, and what is left over of the work.
Table energy_table(const std::vector<SimulatedRun>& runs);

/// Reversals, stops and rests of the hub; for arms with dry friction.
Table hub_motion_table(const std::vector<SimulatedRun>& runs);

/// The residual of the energy balance over the work in, or over the largest energy where there is
/// no work.
double relative_energy_residual(const response::EnergyBalance& energy);

/// Torque, then each sensor, over time: the paper's Figures 20 to 23 when the sensors are hub
/// angle, hub velocity and tip acceleration. Commanded torque and that at the hub where they
/// differ.
Figure simulation_figure(const std::string& arm_name, const SimulatedRun& run);

/// Member `runs` of schema `flexarm.simulate/1` (docs/json.md).
nlohmann::ordered_json runs_json(const std::vector<SimulatedRun>& runs);

}  // namespace flexarm::report
