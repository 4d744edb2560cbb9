#pragma once

#include "response/arm_parts.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace flexarm::response {

/// When sensors are read so that the readings of a sample show each sensor with its delay: at
/// instants that the stepper comes to, exactly, between samples too.
struct ReadingTimes {
  /// What is read `at` a fraction of the sampling period behind sample j, 0 or more and below 1, is
  /// the reading of sample j + `samples_later`.
  struct OfSensor {
    double at = 0.0;
    std::ptrdiff_t samples_later = 0;
  };
  std::vector<OfSensor> sensors;

  /// Fractions of the sampling period, above 0, at which some sensor is read, ascending.
  std::vector<double> cuts() const;
  /// The longest delay in samples, rounded up.
  std::ptrdiff_t longest_samples() const;
  /// Readings of all sensors that at a sample are taken, but of this sample or a later one: the sum
  /// of `samples_later`.
  std::ptrdiff_t pending_readings() const;
};

/// `chains` are those of ArmParts. A delay of more than kMostDelaySamples counts as that many.
ReadingTimes reading_times(std::span<const SensorChain> chains,
                           std::span<const arm::Sensor> sensors, double sample_time_s);
inline constexpr double kMostDelaySamples = 1e9;

}  // namespace flexarm::response
