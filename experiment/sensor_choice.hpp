#pragma once

#include "arm/arm.hpp"
#include "arm/option_name.hpp"
#include "arm/sensor.hpp"
#include "response/time/sensor_imperfections.hpp"

#include <string>
#include <vector>

namespace flexarm::experiment {

/// A sensor and what it adds to what it measures.
struct ChosenSensor {
  arm::Sensor sensor;
  response::SensorImperfections imperfections;
};

/// The sensors of a simulated experiment, in a user's words.
struct SensorChoice {
  /// Empty: hub angle, hub velocity and, with a beam, tip acceleration.
  std::vector<std::string> names;
  double relative_noise = 0.0;
  std::vector<std::string> noises;                     ///< SENSOR=STD
  std::vector<std::string> quantisations;              ///< SENSOR=STEP
  arm::OptionSpelling spelled = arm::on_command_line;  ///< of options in errors

  /// Throws InputError for an unknown sensor, one given twice or that `arm` cannot carry, and for
  /// numbers that are none.
  std::vector<ChosenSensor> sensors(const arm::Arm& arm) const;
};

}  // namespace flexarm::experiment
