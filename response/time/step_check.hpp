#pragma once

#include "response/time/simulation.hpp"

#include <span>
#include <vector>

namespace flexarm::response {

/// How far a simulation is from one with finer inner steps.
struct StepCheck {
  int substeps = 0;  ///< of the finer run, a sample
  /// One a sensor: largest difference at a sample over the finer run's peak; 0 for two zeros.
  std::vector<double> relative_difference;
};

/// `made` against the same simulation with inner steps ten times smaller. A method of order p shows
/// its error but for a part in 10^p; what is stepped exactly shows rounding. `model`, `parts`,
/// `sensors`, `torque_N_m` and `options` are those that `made` was made with. A check that
/// `progress` cancels is empty.
StepCheck check_step(const Simulation& made, const arm::ModalModel& model, const ArmParts& parts,
                     std::span<const arm::Sensor> sensors, std::span<const double> torque_N_m,
                     SimulationOptions options, const SimulationProgress& progress = {});

}  // namespace flexarm::response
