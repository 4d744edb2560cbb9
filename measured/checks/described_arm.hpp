#pragma once

#include "arm/sensor.hpp"

#include <functional>
#include <span>
#include <vector>

namespace flexarm::measured {

/// What the arm as its file describes it reads: one series a sensor, in the sensor's unit, for a
/// torque [N m] at even samples, from rest. Nothing where it has no such sensor.
using DescribedArm = std::function<std::vector<std::vector<double>>(
    std::span<const double> torque_N_m, double period_s, std::span<const arm::Sensor> sensors)>;

}  // namespace flexarm::measured
