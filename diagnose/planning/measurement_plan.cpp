#include "diagnose/planning/measurement_plan.hpp"

#include "measured/files/arm_file.hpp"
#include "measured/files/payload_keys.hpp"
#include "response/excitation/excitation_keys.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

namespace flexarm::diagnose {

namespace {

std::string number_list(const std::vector<double>& numbers) {
  std::vector<std::string> words;
  for (const double number : numbers) words.push_back(measured::toml_number(number));
  return fmt::format("[{}]", fmt::join(words, ", "));
}

std::string frequencies_text(const PlannedRun& run) {
  if (const auto* band = std::get_if<PlannedBand>(&run.frequencies)) {
    return fmt::format("{{ from = {}, to = {}, count = {} }}  # Hz, logarithmic spacing",
                       measured::toml_number(band->from_Hz), measured::toml_number(band->to_Hz),
                       band->count);
  }
  return number_list(std::get<std::vector<double>>(run.frequencies)) + "  # Hz";
}

std::string excitation_text(const PlannedRun& run) {
  const auto* excitation = std::get_if<response::Excitation>(&run.torque);
  if (excitation == nullptr)
    throw std::invalid_argument("a recorded torque cannot be written as an excitation");
  std::string text = fmt::format("{{ kind = \"{}\"", response::name(*excitation));
  for (const auto& [name, unit, value] : response::keys_of(*excitation)) {
    const bool is_word = value.find_first_not_of("0123456789+-.e") != std::string::npos;
    // -0 is a whole number of TOML, which has no sign.
    const std::string number = value == "-0" ? "-0.0" : value;
    text += fmt::format(", {} = {}", name, is_word ? measured::toml_string(value) : number);
  }
  return text + " }  # N m, s, Hz";
}

std::string noise_text(const PlannedRun& run) {
  std::vector<std::string> parts;
  for (const PlannedSensor& sensor : run.sensors) {
    parts.push_back(fmt::format("{} = {}", measured::toml_string(arm::to_string(sensor.sensor)),
                                measured::toml_number(sensor.noise)));
  }
  return fmt::format("{{ {} }}", fmt::join(parts, ", "));
}

}  // namespace

std::string format_measurement_plan(const MeasurementPlan& plan) {
  std::string out;
  const auto line = [&out](const char* key, std::string_view value) {
    fmt::format_to(std::back_inserter(out), "{} = {}\n", key, value);
  };
  const auto word = [&](const char* key, std::string_view value) {
    line(key, fmt::format("\"{}\"", value));
  };
  if (!plan.name.empty()) line("name", measured::toml_string(plan.name));
  for (const PlannedRun& run : plan.runs) {
    out += out.empty() ? "[[run]]\n" : "\n[[run]]\n";
    line("id", measured::toml_string(run.id));
    word("kind", to_string(run.kind));
    if (run.purpose) word("purpose", to_string(*run.purpose));
    if (run.payload) line("payload", measured::format_payload(*run.payload));
    if (run.kind == measured::RunKind::modal) {
      line("poles", fmt::format("{}", run.poles));
      std::vector<std::string> zeros;
      for (const PlannedSensor& sensor : run.sensors) {
        zeros.push_back(fmt::format("{} = {}", measured::toml_string(arm::to_string(sensor.sensor)),
                                    sensor.zeros));
      }
      if (!zeros.empty()) line("zeros", fmt::format("{{ {} }}", fmt::join(zeros, ", ")));
      line("noise", measured::toml_number(run.noise));
      line("damping_noise", measured::toml_number(run.damping_noise));
      continue;
    }
    std::vector<std::string> sensors;
    for (const PlannedSensor& sensor : run.sensors) {
      sensors.push_back(measured::toml_string(arm::to_string(sensor.sensor)));
    }
    line("sensors", fmt::format("[{}]", fmt::join(sensors, ", ")));
    line("noise", noise_text(run));
    if (run.kind == measured::RunKind::frf) {
      line("frequencies", frequencies_text(run));
      continue;
    }
    word("torque_hold", to_string(run.torque_hold));
    line("excitation", excitation_text(run));
    line("duration", measured::toml_number(run.duration_s));
    line("sample_time", measured::toml_number(run.sample_time_s));
  }
  return out;
}

std::vector<double> frequencies_of(const PlannedRun& run) {
  if (const auto* list = std::get_if<std::vector<double>>(&run.frequencies)) return *list;
  const auto& band = std::get<PlannedBand>(run.frequencies);
  std::vector<double> made;
  for (int i = 0; i < band.count; ++i) {
    const double part = band.count > 1 ? static_cast<double>(i) / (band.count - 1) : 0.0;
    made.push_back(band.from_Hz * std::pow(band.to_Hz / band.from_Hz, part));
  }
  return made;
}

std::vector<double> torque_of(const PlannedRun& run) {
  if (const auto* recorded = std::get_if<std::vector<double>>(&run.torque)) return *recorded;
  const response::SampleGrid grid{
      static_cast<std::size_t>(std::max(0.0, std::round(run.duration_s / run.sample_time_s))),
      run.sample_time_s};
  response::Excitation excitation = std::get<response::Excitation>(run.torque);
  auto* multisine = std::get_if<response::Multisine>(&excitation);
  if (multisine != nullptr && multisine->period_s == 0.0) {
    multisine->period_s = grid.duration_s();
  }
  return response::sample(excitation, grid).torque_N_m;
}

}  // namespace flexarm::diagnose
