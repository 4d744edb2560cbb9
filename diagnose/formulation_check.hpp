#pragma once

#include "arm/arm.hpp"
#include "arm/deadline.hpp"
#include "arm/sensor.hpp"

#include <string>
#include <vector>

namespace flexarm::diagnose {

/// Whether fem, assumed_modes and exact_tf say the same of an arm's linear part.
struct FormulationCheck {
  bool agree = false;
  double largest_distance = 0.0;  ///< relative, of poles, zeros, shapes and responses
  double tolerance = 0.0;         ///< of that quantity
  std::string quantity = {};      ///< "hub_angle zero 3", which the largest is of
  std::string refused = {};       ///< why an arm was not compared; empty where it was
};

/// Compares the first `kCheckedRoots` poles and zeros of `sensors` (compare/comparison.hpp).
/// Refused after the deadline.
FormulationCheck check_formulations(const arm::Arm& arm, const std::vector<arm::Sensor>& sensors,
                                    const arm::Deadline& deadline = {});
inline constexpr int kCheckedRoots = 4;

}  // namespace flexarm::diagnose
