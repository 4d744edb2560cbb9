#pragma once

#include "arm/arm.hpp"
#include "arm/controller.hpp"
#include "measured/files/time_record.hpp"
#include "report/figures/figure.hpp"
#include "report/tables/table.hpp"
#include "response/excitation/excitation_keys.hpp"
#include "response/time/simulation.hpp"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>
#include <vector>

namespace flexarm::report {

/// A run of a simulated experiment.
struct SimulatedRun {
  std::string id;
  std::string excitation;                     ///< "bang-bang", "torque.csv"
  std::vector<response::ExcitationKey> keys;  ///< its numbers; none for a torque from a file
  std::vector<double> lines_Hz;               ///< of a multisine
  std::vector<double> detection_Hz;           ///< its lines that were left out
  arm::Payload payload;
  measured::TimeRecord record;          ///< as the sensors read it, noise and all
  response::Simulation simulation;      ///< without their noise; channels in the record's order
  std::vector<double> noise_deviation;  ///< one a channel, in its unit
  double fall_rate_rad_per_s = 0.0;  ///< of an arm that stands up: undamped poles +- this; else 0
  std::vector<double> step_error;  ///< one a channel: largest difference to a tenfold smaller step,
                                   ///< over the largest size; empty when not asked for
  std::optional<arm::Controller> controller = {};  ///< of a closed loop; its excitation is the
                                                   ///< record's reference
};

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
