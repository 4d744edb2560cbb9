#pragma once

#include "arm/arm.hpp"
#include "arm/sensor.hpp"
#include "response/arm_parts.hpp"
#include "response/formulation_choice.hpp"

#include <list>
#include <optional>
#include <vector>

namespace flexarm::experiment {

/// A modal model of the arm with one of the payloads.
struct PayloadModel {
  arm::Payload payload;
  int requested_modes = 0;  ///< flexible ones
  response::ArmParts parts;
  response::ChosenFormulation chosen;
  arm::ModalModel model;

  /// Flexible modes kept: fewer than requested where the formulation has no more.
  int modes() const;
};

/// Models of one arm by payload and number of modes, each formed once.
class PayloadModels {
 public:
  PayloadModels(const arm::Arm& arm, const std::vector<arm::Sensor>& sensors,
                const response::FormulationChoice& formulation, bool static_correction)
      : arm_(arm),
        sensors_(sensors),
        formulation_(formulation),
        static_correction_(static_correction) {}

  const std::vector<arm::Sensor>& sensors() const { return sensors_; }
  const response::FormulationChoice& formulation() const { return formulation_; }

  /// Returns the model with `payload`, or the arm's own where that is empty. The reference stays valid. Throws InputError as the formulation does.
  const PayloadModel& of(const std::optional<arm::Payload>& payload, int modes);

 private:
  arm::Arm arm_;
  std::vector<arm::Sensor> sensors_;
  response::FormulationChoice formulation_;
  bool static_correction_;
  std::list<PayloadModel> models_;
};

}  // namespace flexarm::experiment
