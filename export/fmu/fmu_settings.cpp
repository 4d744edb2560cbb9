#include "export/fmu/fmu_settings.hpp"

#include "arm/input_error.hpp"
#include "measured/files/arm_file.hpp"
#include "measured/files/toml_document.hpp"
#include "response/arm_parts.hpp"
#include "response/formulation_maker.hpp"
#include "response/time/time_model.hpp"

#include <fmt/format.h>

#include <optional>

namespace flexarm::fmu {

std::string format_settings(const FmuSettings& settings) {
  std::string sensors;
  for (const arm::Sensor& sensor : settings.sensors) {
    if (!sensors.empty()) sensors += ", ";
    sensors += measured::toml_string(arm::to_string(sensor));
  }
  return fmt::format(
      "# How the FMU simulates arm.toml, as `flexarm simulate` with these options.\n"
      "token = {}\n"
      "formulation = {}\n"
      "modes = {}\n"
      "static_correction = {}\n"
      "sample_time = {}  # s\n"
      "sensors = [{}]\n",
      measured::toml_string(settings.token), measured::toml_string(settings.formulation),
      settings.modes, settings.static_correction, measured::toml_number(settings.sample_time_s),
      sensors);
}

FmuSettings parse_settings(std::string_view toml, const std::string& file_name) {
  const toml::table document = measured::parse_toml(toml, file_name);
  const auto value = [&]<class T>(const char* key, T& to) {
    const std::optional<T> given = document[key].value<T>();
    if (!given) throw arm::InputError(fmt::format("{}: {}: missing", file_name, key));
    to = *given;
  };
  FmuSettings settings;
  value("token", settings.token);
  value("formulation", settings.formulation);
  value("modes", settings.modes);
  value("static_correction", settings.static_correction);
  value("sample_time", settings.sample_time_s);
  const toml::array* sensors = document["sensors"].as_array();
  if (sensors == nullptr) throw arm::InputError(fmt::format("{}: sensors: missing", file_name));
  for (const toml::node& sensor : *sensors) {
    settings.sensors.push_back(arm::parse_sensor(sensor.value_or(std::string())));
  }
  return settings;
}

response::CosimulatedArm make_cosimulated(const arm::Arm& arm, const FmuSettings& settings) {
  if (settings.modes < 1) throw arm::out_of_range("modes", settings.modes, "", "1 or more");
  const response::ArmParts parts = response::take_apart(arm);
  for (const arm::Sensor& sensor : settings.sensors) arm::require_valid(sensor, arm);
  const auto formulation = response::make_formulation(
      settings.formulation, arm, settings.modes + (settings.static_correction ? 1 : 0));
  const arm::ModalModel model = response::time_model(formulation, parts, settings.modes,
                                                     settings.sensors, settings.static_correction);
  response::SimulationOptions options;
  options.sample_time_s = settings.sample_time_s;
  options.energy = false;
  return {model, parts, settings.sensors, options};
}

}  // namespace flexarm::fmu
