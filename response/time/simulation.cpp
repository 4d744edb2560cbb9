#include "response/time/simulation.hpp"

#include "response/time/arm_simulator.hpp"
#include "response/time/simulation_input.hpp"

namespace flexarm::response {

double EnergyBalance::dissipated_J() const {
  return viscous_J + material_air_J + dry_friction_J + drag_J;
}

double EnergyBalance::residual_J() const {
  return work_in_J - kinetic_J - potential_J - dissipated_J();
}

Simulation simulate(const arm::ModalModel& model, const ArmParts& parts,
                    std::span<const arm::Sensor> sensors, std::span<const double> torque_N_m,
                    const SimulationOptions& options, const SimulationProgress& progress) {
  require_simulable(parts, torque_N_m, options);
  return ArmSimulator(model, parts, sensors, options).run(torque_N_m, progress);
}

}  // namespace flexarm::response
