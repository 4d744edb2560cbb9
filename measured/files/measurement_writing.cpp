#include "arm/input_error.hpp"
#include "arm/utf8.hpp"
#include "measured/files/arm_file.hpp"
#include "measured/files/atomic_file.hpp"
#include "measured/files/controller_keys.hpp"
#include "measured/files/measurement.hpp"
#include "measured/files/payload_keys.hpp"

#include <fmt/format.h>

#include <iterator>

namespace flexarm::measured {

namespace {

using arm::InputError;

std::string quoted(const std::string& key, const std::string& text) {
  if (!arm::is_utf8(text)) {
    throw InputError(
        fmt::format("{} = \"{}\": not UTF-8, as required by TOML", key, arm::shown(text)), key);
  }
  return measured::toml_string(text);
}

std::string format_mapping(const std::string& key, const ColumnMapping& mapping) {
  std::string out =
      mapping.expression.empty()
          ? fmt::format("{{ name = {}", quoted(key + ".name", mapping.name))
          : fmt::format("{{ expression = {}", quoted(key + ".expression", mapping.expression));
  if (!mapping.unit.empty()) {
    out += fmt::format(", unit = {}", quoted(key + ".unit", mapping.unit));
  }
  return out + fmt::format(", scale = {} }}", measured::toml_number(mapping.scale));
}

}  // namespace

std::string format_measurement(const Measurement& measurement) {
  std::string out;
  const auto line = [&out](const char* key, std::string_view value) {
    fmt::format_to(std::back_inserter(out), "{} = {}\n", key, value);
  };
  const auto word = [&](const char* key, std::string_view value) {
    line(key, fmt::format("\"{}\"", value));
  };
  if (!measurement.name.empty()) line("name", quoted("name", measurement.name));
  if (!measurement.arm.empty()) line("arm", quoted("arm", measurement.arm));
  for (const auto& run : measurement.runs) {
    out += "\n[[run]]\n";
    line("id", quoted("run.id", run.id));
    word("kind", to_string(run.kind));
    line("file", quoted("run.file", run.file));
    if (run.purpose) word("purpose", to_string(*run.purpose));
    if ((run.kind == RunKind::time && run.torque_hold_is_known) ||
        run.torque_hold != TorqueHold::zero) {
      word("torque_hold", to_string(run.torque_hold));
    }
    if (run.payload) {
      line("payload", format_payload(*run.payload));
    }
    if (run.initial != InitialState::rest) word("initial", to_string(run.initial));
    for (const auto& [name, mapping] : run.columns) {
      const std::string key =
          "columns." + (name.find('@') == std::string::npos ? name : measured::toml_string(name));
      line(key.c_str(), format_mapping(key, mapping));
    }
    if (run.reference) {
      line("reference", run.columns.empty() ? quoted("run.reference", run.reference->name)
                                            : format_mapping("run.reference", *run.reference));
    }
    if (run.controller) line("controller", format_controller(*run.controller));
  }
  return out;
}

void write_measurement(const Measurement& measurement, const std::filesystem::path& path) {
  measured::write_atomically(path, format_measurement(measurement));
}

}  // namespace flexarm::measured
