#pragma once

#include "arm/arm.hpp"
#include "arm/sensor.hpp"
#include "response/time/sensor_imperfections.hpp"

#include <string>
#include <vector>

namespace CLI {
class App;
}  // namespace CLI

namespace flexarm::app {

/// A sensor and what it adds to what it measures.
struct ChosenSensor {
  arm::Sensor sensor;
  response::SensorImperfections imperfections;
};

/// The sensors of a simulated experiment.
struct SensorChoice {
  /// Empty: hub angle, hub velocity and, with a beam, tip acceleration.
  std::vector<std::string> names;
  double relative_noise = 0.0;
  std::vector<std::string> noises;         ///< SENSOR=STD
  std::vector<std::string> quantisations;  ///< SENSOR=STEP

  /// Throws InputError for an unknown sensor, one given twice or that `arm` cannot carry, and for
  /// numbers that are none.
  std::vector<ChosenSensor> sensors(const arm::Arm& arm) const;
};

/// Adds `--sensor`, `--noise`, `--noise-of` and `--quantisation` to a command.
void add_sensor_choice(CLI::App& parser, SensorChoice& choice);

}  // namespace flexarm::app
