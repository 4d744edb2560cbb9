#pragma once

#include "arm/linear_arm.hpp"
#include "arm/sensor.hpp"
#include "response/arm_parts.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

namespace flexarm::diagnose {

/// Modal models by exact_tf of arms that are simulated: the last `kKept` are kept. Of the
/// parameters that a fit moves, many leave the linear arm as it is: laws of hub torque, the path of
/// the torque, sensors. Concurrent calls are safe, and give what a computation would; of the same
/// arm they may both compute it.
class ModalModels {
 public:
  explicit ModalModels(int flexible_modes) : flexible_modes_(flexible_modes) {}

  /// response::time_model. Throws InputError as that does.
  std::shared_ptr<const arm::ModalModel> of(const response::ArmParts& parts,
                                            std::span<const arm::Sensor> sensors);
  static constexpr std::size_t kKept = 32;

 private:
  /// All that a model depends on, with the time of its last use.
  struct Entry {
    arm::LinearArm arm;
    std::vector<arm::Sensor> placed;
    bool has_beam_forces = false;
    std::shared_ptr<const arm::ModalModel> model = {};
    std::uint64_t used = 0;

    bool is_same(const Entry& other) const {
      return arm == other.arm && placed == other.placed && has_beam_forces == other.has_beam_forces;
    }
  };

  int flexible_modes_;
  std::mutex mutex_;  // of what follows
  std::vector<Entry> entries_ = {};
  std::uint64_t uses_ = 0;
};

}  // namespace flexarm::diagnose
