#pragma once

#include "experiment/sensor_choice.hpp"

namespace CLI {
class App;
}  // namespace CLI

namespace flexarm::app {

using experiment::ChosenSensor;
using experiment::SensorChoice;

/// Adds `--sensor`, `--noise`, `--noise-of` and `--quantisation` to a command.
void add_sensor_choice(CLI::App& parser, SensorChoice& choice);

}  // namespace flexarm::app
