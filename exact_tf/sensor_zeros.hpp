#pragma once

#include "arm/formulation.hpp"
#include "arm/linear_arm.hpp"
#include "exact_tf/analytic_zeros.hpp"

namespace flexarm::exact_tf {

/// The `count` zeros that are smallest in |s|, s = 0 and infinity left out, of a transfer function
/// whose numerator is an entire function of z = lambda^4 = -(s/omega_scale)^2. `count.expected` is
/// `count.found` plus what the argument principle counts beyond the zeros found;
/// `summary.iterations` are values of the numerator. Throws std::invalid_argument for count < 1.
arm::ZeroSet find_sensor_zeros(const SectorFunction& numerator, Real omega_scale_rad_per_s,
                               int count, const AnalyticZeroOptions& options = {});

/// The same of a plain arm from hub torque to `sensor`, with the sensor's numerator in
/// exact_tf/numerator.hpp. A zero of the numerator that is a pole too is among them: all those of
/// strain at the root without hub inertia, which follows the torque. For a sensor that the arm
/// carries (`require_valid`) and that does not read zero at every s (`require_responsive`).
arm::ZeroSet find_sensor_zeros(const arm::LinearArm& arm, const arm::Sensor& sensor, int count,
                               Arithmetic arithmetic = Arithmetic::extended);

}  // namespace flexarm::exact_tf
