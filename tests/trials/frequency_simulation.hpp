#pragma once

#include "arm/sensor.hpp"
#include "measured/files/modal_table.hpp"
#include "tests/trials/world.hpp"

#include <complex>
#include <span>
#include <vector>

namespace flexarm::trials {

/// Responses per unit of commanded torque, one vector a sensor: solves of the whole finite-element
/// model at each frequency.
std::vector<std::vector<std::complex<double>>> frequency_responses(
    const World& world, std::span<const arm::Sensor> sensors, std::span<const double> frequency_Hz);

/// The lowest poles with damping, and the lowest zeros of the hub angle, `count` each, without
/// noise or standard deviations.
measured::ModalTable poles_and_zeros(const World& world, int count);

}  // namespace flexarm::trials
