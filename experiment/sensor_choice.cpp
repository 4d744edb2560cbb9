#include "experiment/sensor_choice.hpp"

#include "arm/input_error.hpp"
#include "arm/number.hpp"
#include "arm/range.hpp"
#include "arm/rigid_hub.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace flexarm::experiment {

namespace {

using arm::InputError;
using response::SensorImperfections;

/// Reads SENSOR=NUMBER and sets the number of that sensor, which joins those `given`.
void set_number(const SensorChoice& choice, const char* name, const std::string& text,
                std::vector<ChosenSensor>& sensors, double SensorImperfections::*member,
                std::vector<arm::Sensor>& given) {
  const std::string option = choice.spelled(name);
  const auto equals = text.find('=');
  if (equals == std::string::npos) {
    throw InputError(fmt::format("{} {}: must be SENSOR=NUMBER, e.g. hub_angle=0.001", option,
                                 arm::shown(text)));
  }
  const arm::Sensor sensor = arm::parse_sensor(std::string_view(text).substr(0, equals));
  const auto place = std::ranges::find(sensors, sensor, &ChosenSensor::sensor);
  if (place == sensors.end()) {
    throw InputError(fmt::format("{} {}: {} is not among {}", option, arm::shown(text),
                                 arm::to_string(sensor), choice.spelled("sensor")));
  }
  const auto number = arm::parse_number<double>(std::string_view(text).substr(equals + 1));
  if (!number || !arm::kNotNegative.contains(*number)) {
    throw InputError(fmt::format("{} {}: must be {} [{}]", option, arm::shown(text),
                                 to_string(arm::kNotNegative), arm::unit(sensor)));
  }
  if (std::ranges::count(given, sensor) > 0) {
    throw InputError(
        fmt::format("{} {}: {} given twice", option, arm::shown(text), arm::to_string(sensor)));
  }
  given.push_back(sensor);
  place->imperfections.*member = *number;
}

}  // namespace

std::vector<ChosenSensor> SensorChoice::sensors(const arm::Arm& arm) const {
  arm::require_in_range(spelled("noise"), relative_noise, "", arm::kNotNegative);
  std::vector<ChosenSensor> sensors;
  std::vector<std::string> typed = names;
  if (typed.empty()) {
    typed = {"hub_angle", "hub_velocity"};
    if (arm::has_beam(arm)) typed.emplace_back("tip_acceleration");
  }
  for (const auto& name : typed) {
    const arm::Sensor sensor = arm::parse_sensor(name);
    arm::require_valid(sensor, arm);
    if (std::ranges::count(sensors, sensor, &ChosenSensor::sensor) > 0) {
      throw InputError(
          fmt::format("{}: {} given twice", spelled("sensor"), arm::to_string(sensor)));
    }
    sensors.push_back({sensor, {.relative_noise = relative_noise}});
  }
  std::vector<arm::Sensor> noisy;
  for (const auto& text : noises) {
    set_number(*this, "noise-of", text, sensors, &SensorImperfections::noise, noisy);
  }
  std::vector<arm::Sensor> stepped;
  for (const auto& text : quantisations) {
    set_number(*this, "quantisation", text, sensors, &SensorImperfections::quantisation, stepped);
  }
  return sensors;
}

}  // namespace flexarm::experiment
