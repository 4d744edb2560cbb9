#pragma once

#include "arm/sensor.hpp"

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace flexarm::measured {

/// What the arm as its file describes it reads: one series a sensor, in the sensor's unit, for a
/// torque [N m] at even samples, from rest. Nothing where it has no such sensor.
using DescribedArm = std::function<std::vector<std::vector<double>>(
    std::span<const double> torque_N_m, double period_s, std::span<const arm::Sensor> sensors)>;

/// An effect that the file may lack, or a number that it may have wrong.
struct ArmVariation {
  std::size_t effect = 0;  ///< below ArmVariations::effects
  double size = 0.0;       ///< from 0 to 1, the largest that is plausible
};

/// Arms that the file's may stand for.
struct ArmVariations {
  std::size_t effects = 0;
  /// The arm with these variations; empty where it is none.
  std::function<DescribedArm(std::span<const ArmVariation> variations)> with = {};
};

/// Those for a record with this torque [N m].
using VariationsOfArm =
    std::function<ArmVariations(std::span<const double> torque_N_m, double period_s)>;

}  // namespace flexarm::measured
