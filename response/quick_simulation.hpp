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
/// step, exact for the rest: drag and ripple at their mean of both ends (order 2 in the step),
/// friction at what the end of the step asks for, stopping the hub there where it is strong enough
/// (order 1 where the hub turns back or stops, exact elsewhere). Where dead zone or saturation
/// break a torque that is linear between samples, the sample has its mean.
///
/// One vector a sensor. Throws InputError as `simulate` does for parts that do not fit together,
/// and for readings that are too large for a number.
std::vector<std::vector<double>> quick_simulation(const arm::ModalModel& model,
                                                  const ArmParts& parts,
                                                  std::span<const arm::Sensor> sensors,
                                                  std::span<const double> torque_N_m,
                                                  const QuickSimulationOptions& options);

}  // namespace flexarm::response
