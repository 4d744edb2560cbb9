#pragma once

#include "arm/formulation.hpp"
#include "arm/sensor.hpp"
#include "fem/discretisation.hpp"
#include "fem/vibration_modes.hpp"

#include <span>

namespace flexarm::fem {

/// The modes of `discretisation` in SI units with what sensors and stations show of them, and the
/// damping that couples them. Sensors and stations are valid for the arm; `vibration` is of the
/// free hub.
arm::ModalModel modal_model(const Discretisation& discretisation, const VibrationModes& vibration,
                            std::span<const arm::Sensor> sensors,
                            std::span<const double> stations_m);

}  // namespace flexarm::fem
