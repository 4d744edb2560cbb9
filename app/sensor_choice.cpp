#include "app/sensor_choice.hpp"

#include "app/list_option.hpp"

#include <CLI/CLI.hpp>

namespace flexarm::app {

void add_sensor_choice(CLI::App& parser, SensorChoice& choice) {
  add_list_option(parser, "--sensor", choice.names,
                  "Sensors, comma-separated; default: hub_angle, hub_velocity and, with a beam, "
                  "tip_acceleration");
  parser.add_option(
      "--noise", choice.relative_noise,
      "White noise on all sensors: standard deviation relative to that of the signal");
  add_list_option(
      parser, "--noise-of", choice.noises,
      "SENSOR=STD,...: additional white noise, standard deviation in the unit of the sensor");
  add_list_option(parser, "--quantisation", choice.quantisations,
                  "SENSOR=STEP,...: quantisation step in the unit of the sensor");
}

}  // namespace flexarm::app
