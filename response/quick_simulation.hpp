#pragma once

#include "response/simulation.hpp"

#include <span>
#include <vector>

namespace flexarm::response {

struct QuickSimulationOptions {
  double sample_time_s = 1e-3;
  TorqueHold hold = TorqueHold::zero;
  /// Inner steps a sample where friction, drag or ripple act.
  int substeps = 4;
};

/// The readings that `simulate` gives, for fits that need them by the thousand.
///
/// A linear arm is stepped exactly, as there. Forces that are not linear are held over an inner
/// step at their mean of it, exact for the rest, with an error of order 2 in the step: drag and
/// ripple of both ends, friction of the parts before and after the hub comes to rest. Where dead
/// zone or saturation break a torque that is linear between samples, the sample has its mean.
///
/// One vector a sensor. Throws InputError as `simulate` does for parts that do not fit together,
/// and for readings that are too large for a number.
std::vector<std::vector<double>> quick_simulation(const arm::ModalModel& model,
                                                  const ArmParts& parts,
                                                  std::span<const arm::Sensor> sensors,
                                                  std::span<const double> torque_N_m,
                                                  const QuickSimulationOptions& options);

}  // namespace flexarm::response
