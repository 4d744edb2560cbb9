#pragma once

#include "arm/formulation.hpp"
#include "arm/linear_arm.hpp"
#include "exact_tf/analytic_zeros.hpp"

namespace flexarm::exact_tf {

/// The `count` zeros of the undamped arm from hub torque to `sensor` that are smallest in |s|, s =
/// 0 and infinity left out: s^2 = -z omega_scale^2 at the zeros z of the sensor's numerator in
/// exact_tf/numerator.hpp. A zero of the numerator that is a pole too is among them: all those of
/// strain at the root without hub inertia, which follows the torque. `count.expected` is
/// `count.found` plus what the argument principle counts beyond the zeros found;
/// `summary.iterations` are values of the numerator. For a plain arm and a sensor that it carries
/// (`require_valid`) and that does not read zero at every s (`require_responsive`). Throws
/// std::invalid_argument for count < 1.
arm::ZeroSet find_sensor_zeros(const arm::LinearArm& arm, const arm::Sensor& sensor, int count,
                               const AnalyticZeroOptions& options = {});

}  // namespace flexarm::exact_tf
