#include "diagnose/predictors/modal_models.hpp"

#include "arm/rigid_hub.hpp"
#include "response/formulation_maker.hpp"
#include "response/time/time_model.hpp"

namespace flexarm::diagnose {

std::shared_ptr<const arm::ModalModel> ModalModels::of(const response::ArmParts& parts,
                                                       std::span<const arm::Sensor> sensors) {
  const auto computed = [&] {
    return response::time_model(response::formulation_of_fit(parts.linear), parts, flexible_modes_,
                                sensors);
  };
  if (!arm::has_beam(parts.linear)) return std::make_shared<const arm::ModalModel>(computed());
  return kept_.of({.arm = arm::linear_arm(parts.linear),
                   .placed = arm::placed(sensors, parts.linear),
                   .has_beam_forces = !parts.beam_forces.empty()},
                  [&](const Key& /*key*/) { return computed(); });
}

}  // namespace flexarm::diagnose
