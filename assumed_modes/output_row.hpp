#pragma once

#include "arm/arm.hpp"
#include "arm/sensor.hpp"
#include "assumed_modes/admissible_functions.hpp"
#include "assumed_modes/mass_matrix.hpp"
#include "assumed_modes/real.hpp"

namespace flexarm::assumed_modes {

/// What a sensor shows of the coordinates, before time derivatives:
/// unit (rigid q_0 + flexible . q).
struct OutputRow {
  Real unit = 1;  ///< 1 for angles, l [m] for displacements, thickness/(2 l) for strain
  Real rigid = 0;
  Vector flexible;

  /// The row for functions freed of rigid-body motion, psi_i - xi coupling_i/rigid:
  /// flexible - rigid mass.coupling/mass.rigid.
  Vector without_rigid_mode(const MassMatrix& mass) const;
};

/// Throws InputError for a sensor that the arm cannot carry.
OutputRow output_row(const arm::Sensor& sensor, const arm::Arm& arm,
                     const AdmissibleFunctions& functions);

}  // namespace flexarm::assumed_modes
