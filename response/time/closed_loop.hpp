#pragma once

#include "arm/controller.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <span>
#include <vector>

namespace flexarm::response {

/// What makes the torque of an arm in closed loop: a controller, and the reference that it is to
/// follow.
///
/// It reads its sensors as they are (gain, delay, lag, offset) at sample 0 and after each of its
/// periods, just before its torque jumps: an acceleration is that with the torque from before; of a
/// delayed sensor that with the torque from before the delayed instant. What it commands is held,
/// and goes through the torque's path (delay, gain, saturation, lag, ...) to the hub.
struct ClosedLoop {
  arm::Controller controller;
  std::vector<double> reference;              ///< one a sample of the record, in SI
  std::vector<double> controller_state = {};  ///< before sample 0 (`controller_states`); else zeros
};

/// A closed loop that was simulated.
struct ClosedLoopReadings {
  Eigen::MatrixXd readings;        ///< a row a sample, a column a sensor
  std::vector<double> torque_N_m;  ///< as the controller commanded it, one a sample
};

}  // namespace flexarm::response
