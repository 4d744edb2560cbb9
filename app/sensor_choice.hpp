#pragma once

#include "response/experiment/sensor_choice.hpp"

namespace CLI {
class App;
}  // namespace CLI

namespace flexarm::app {

using response::ChosenSensor;
using response::SensorChoice;

/// Adds `--sensor`, `--noise`, `--noise-of` and `--quantisation` to a command.
void add_sensor_choice(CLI::App& parser, SensorChoice& choice);

}  // namespace flexarm::app
