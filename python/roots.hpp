#pragma once

#include "arm/formulation.hpp"

#include <vector>

namespace flexarm::python {

/// Zeros with the sensor that they are of.
struct SensorZeros {
  arm::Sensor sensor;
  arm::ZeroSet zeros;
};

/// Modes with the sensors and stations of their values. `model` has the lowest mode first.
struct Modes {
  arm::ModalModel model;
  std::vector<arm::Sensor> sensors;
  std::vector<double> stations_m;
};

}  // namespace flexarm::python
