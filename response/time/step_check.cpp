#include "response/time/step_check.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace flexarm::response {

StepCheck check_step(const Simulation& made, const arm::ModalModel& model, const ArmParts& parts,
                     std::span<const arm::Sensor> sensors, std::span<const double> torque_N_m,
                     SimulationOptions options, const SimulationProgress& progress) {
  options.substeps = 10 * made.summary.substeps;
  options.energy = false;
  const Simulation finer = simulate(model, parts, sensors, torque_N_m, options, progress);
  StepCheck check;
  if (!finer.summary.completed) return check;
  check.substeps = finer.summary.substeps;
  for (std::size_t j = 0; j < finer.channels.size(); ++j) {
    double peak = 0.0;
    double difference = 0.0;
    const std::size_t samples = std::min(made.channels[j].size(), finer.channels[j].size());
    for (std::size_t k = 0; k < samples; ++k) {
      peak = std::max(peak, std::abs(finer.channels[j][k]));
      difference = std::max(difference, std::abs(finer.channels[j][k] - made.channels[j][k]));
    }
    check.relative_difference.push_back(difference == 0.0 ? 0.0 : difference / peak);
  }
  return check;
}

}  // namespace flexarm::response
