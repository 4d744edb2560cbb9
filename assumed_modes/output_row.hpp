#pragma once

#include "arm/linear_arm.hpp"
#include "arm/sensor.hpp"
#include "assumed_modes/admissible_functions.hpp"
#include "assumed_modes/real.hpp"
#include "assumed_modes/scaled_arm.hpp"

namespace flexarm::assumed_modes {

/// What a sensor shows of the coordinates, before time derivatives: unit (row . q).
struct OutputRow {
  Real unit = 1;  ///< 1 for angles, l [m] for displacements, thickness/(2 l) for strain
  Vector row;     ///< exactly 0 in the rigid rotation for what does not see it
};

/// For a sensor that the arm carries, at its place on it (`arm::placed`).
OutputRow output_row(const arm::Sensor& sensor, const arm::LinearArm& arm,
                     const AdmissibleFunctions& functions);

}  // namespace flexarm::assumed_modes
