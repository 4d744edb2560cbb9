#pragma once

#include "arm/formulation.hpp"
#include "arm/linear_arm.hpp"
#include "arm/sensor.hpp"
#include "diagnose/predictors/last_kept.hpp"
#include "response/arm_parts.hpp"

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace flexarm::diagnose {

/// Modal models by exact_tf of arms that are simulated: the last `kKept` are kept. Of the
/// parameters that a fit moves, many leave the linear arm as it is: laws of hub torque, the path of
/// the torque, sensors. Concurrent calls are safe.
class ModalModels {
 public:
  explicit ModalModels(int flexible_modes) : flexible_modes_(flexible_modes), kept_(kKept) {}

  /// Returns response::time_model with the flexible modes and one for each mass on a spring. Throws
  /// InputError as that does.
  std::shared_ptr<const arm::ModalModel> of(const response::ArmParts& parts,
                                            std::span<const arm::Sensor> sensors);
  static constexpr std::size_t kKept = 32;

 private:
  /// All that a model depends on.
  struct Key {
    arm::LinearArm arm;
    std::vector<arm::Sensor> placed;
    bool has_beam_forces = false;

    bool operator==(const Key&) const = default;
  };

  int flexible_modes_;
  LastKept<Key, arm::ModalModel> kept_;
};

}  // namespace flexarm::diagnose
