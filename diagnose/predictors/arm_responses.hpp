#pragma once

#include "arm/linear_arm.hpp"
#include "arm/sensor.hpp"
#include "diagnose/predictors/last_kept.hpp"
#include "response/frequency/frequency_response.hpp"

#include <cstddef>
#include <deque>
#include <memory>
#include <span>
#include <vector>

namespace flexarm::diagnose {

/// response::arm_response by exact_tf of the arms of runs: of each run the last `kKept` are kept.
/// Of the parameters that a fit moves, many leave the linear arm as it is: the path of the torque,
/// sensors. Concurrent calls are safe.
class ArmResponses {
 public:
  explicit ArmResponses(std::size_t runs);

  /// Throws InputError as response::arm_response.
  std::shared_ptr<const response::FrequencyResponse> of(std::size_t run, const arm::Arm& arm,
                                                        std::span<const arm::Sensor> sensors,
                                                        std::span<const double> frequency_Hz);
  static constexpr std::size_t kKept = 4;

 private:
  /// All that a response depends on.
  struct Key {
    arm::LinearArm arm;
    std::vector<arm::Sensor> placed;
    std::vector<double> frequency_Hz;

    bool operator==(const Key&) const = default;
  };

  std::deque<LastKept<Key, response::FrequencyResponse>> kept_;  ///< one a run
};

}  // namespace flexarm::diagnose
