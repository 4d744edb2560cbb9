#include "diagnose/predictors/modal_models.hpp"

#include "arm/rigid_hub.hpp"
#include "response/formulation_maker.hpp"
#include "response/time/time_model.hpp"

#include <algorithm>

namespace flexarm::diagnose {

namespace {

/// Returns the number of masses on springs of an arm. Each has a mode of its own, which among the
/// lowest modes would take the place of one of the beam, so that a mass too small to act would
/// change the simulation.
int suspended_masses(const arm::LinearArm& linear) {
  return static_cast<int>(std::ranges::count_if(
      linear.masses, [](const arm::MassOnBeam& mass) { return mass.suspension.has_value(); }));
}

}  // namespace

std::shared_ptr<const arm::ModalModel> ModalModels::of(const response::ArmParts& parts,
                                                       std::span<const arm::Sensor> sensors) {
  const arm::LinearArm linear = arm::linear_arm(parts.linear);
  const auto computed = [&] {
    return response::time_model(response::formulation_of_fit(parts.linear), parts,
                                flexible_modes_ + suspended_masses(linear), sensors);
  };
  if (!arm::has_beam(parts.linear)) return std::make_shared<const arm::ModalModel>(computed());
  return kept_.of({.arm = linear,
                   .placed = arm::placed(sensors, parts.linear),
                   .has_beam_forces = !parts.beam_forces.empty()},
                  [&](const Key& /*key*/) { return computed(); });
}

}  // namespace flexarm::diagnose
