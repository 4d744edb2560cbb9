#include "response/time/time_model.hpp"

#include "arm/linear_arm.hpp"
#include "response/residual_mode.hpp"
#include "response/time/beam_forces.hpp"

#include <vector>

namespace flexarm::response {

arm::ModalModel time_model(const AnyFormulation& formulation, const ArmParts& parts, int count,
                           std::span<const arm::Sensor> sensors, bool static_correction) {
  std::vector<double> stations_m;
  if (!parts.beam_forces.empty()) {
    stations_m = beam_stations(arm::linear_arm(parts.linear).length_m).stations_m;
  }
  const arm::ModalModel model = modal_model(formulation, count, sensors, stations_m);
  return static_correction ? with_residual_mode(formulation, model, sensors) : model;
}

}  // namespace flexarm::response
