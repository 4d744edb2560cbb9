#include "response/time/simulation_input.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <limits>

namespace flexarm::response {

void require_command(const ArmParts& parts, double torque_N_m, std::size_t k,
                     double sample_time_s) {
  // Half: torques between two samples are formed from their difference.
  constexpr double kLargest = 0.5 * std::numeric_limits<double>::max();
  if (std::abs(parts.actuator.mapped(torque_N_m)) <= kLargest) return;
  if (std::isfinite(torque_N_m)) {
    throw arm::InputError(
        fmt::format("torque = {} N m at {:.6g} s: numeric overflow in the actuator model",
                    torque_N_m, static_cast<double>(k) * sample_time_s),
        "torque");
  }
  throw arm::InputError(
      fmt::format("torque = {} N m at sample {} (from 0): must be finite", torque_N_m, k),
      "torque");
}

void require_options(const SimulationOptions& options) {
  using arm::require_in_range;
  require_in_range("sample time", options.sample_time_s, "s", arm::kPositive);
  if (options.substeps < 0 || options.substeps > kMostSubsteps) {
    throw arm::out_of_range("substeps", options.substeps, "",
                            fmt::format("from 0 to {}", kMostSubsteps));
  }
  require_in_range("force tolerance", options.force_tolerance, "", arm::kPositive);
  if (options.most_iterations < 1) {
    throw arm::out_of_range("most iterations", options.most_iterations, "", "1 or more");
  }
}

void require_simulable(const ArmParts& parts, std::span<const double> torque_N_m,
                       const SimulationOptions& options) {
  require_options(options);
  if (torque_N_m.empty()) throw arm::InputError("torque: there are no samples");
  for (std::size_t k = 0; k < torque_N_m.size(); ++k) {
    require_command(parts, torque_N_m[k], k, options.sample_time_s);
  }
}

arm::InputError too_large(const std::string& what, double time_s) {
  return arm::InputError(fmt::format(
      "{} at {:.6g} s: numeric overflow; reduce the torque or the duration", what, time_s));
}

}  // namespace flexarm::response
