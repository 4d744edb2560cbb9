#include "compare/identification_task.hpp"

#include "arm/input_error.hpp"
#include "arm/linear_arm.hpp"
#include "arm/nearest_name.hpp"
#include "arm/range.hpp"
#include "arm/read_word.hpp"
#include "compare/described_arm.hpp"
#include "effects/registry/vocabulary.hpp"
#include "measured/files/arm_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

namespace flexarm::compare {

namespace {

/// The runs asked for, all unless told. Throws InputError for one that there is not.
std::vector<measured::Run> chosen_runs(const IdentificationRequest& request,
                                       const measured::Measurement& measurement,
                                       const std::string& file) {
  if (request.runs.empty()) return measurement.runs;
  std::vector<std::string> ids;
  for (const auto& run : measurement.runs) ids.push_back(run.id);
  std::vector<measured::Run> chosen;
  for (const auto& id : request.runs) {
    const std::string option = request.spelled("run");
    const auto at = std::ranges::find(measurement.runs, id, &measured::Run::id);
    if (at == measurement.runs.end()) {
      throw arm::InputError(fmt::format("{} {}: no such run in {}{}; its runs are {}", option,
                                        arm::shown(id), file, arm::did_you_mean(id, ids),
                                        fmt::join(ids, ", ")));
    }
    if (std::ranges::find(chosen, id, &measured::Run::id) != chosen.end()) {
      throw arm::InputError(fmt::format("{} {}: given twice", option, arm::shown(id)));
    }
    chosen.push_back(*at);
  }
  return chosen;
}

/// Leaves the sensors asked for in the data, all unless told. Throws InputError where none of the
/// runs has one.
void select_sensors(const IdentificationRequest& request,
                    std::vector<measured::MeasuredRun>& runs) {
  std::vector<arm::Sensor> wanted;
  for (const auto& name : request.sensors) wanted.push_back(arm::parse_sensor(name));
  if (wanted.empty()) return;
  std::vector<bool> seen(wanted.size(), false);
  const auto unwanted = [&](const arm::Sensor& sensor) {
    const auto at = std::ranges::find(wanted, sensor);
    if (at == wanted.end()) return true;
    seen[static_cast<std::size_t>(at - wanted.begin())] = true;
    return false;
  };
  for (auto& run : runs) {
    if (auto* table = std::get_if<measured::ModalTable>(&run.data)) {
      std::erase_if(*table,
                    [&](const auto& entry) { return entry.sensor && unwanted(*entry.sensor); });
      continue;
    }
    std::visit(
        [&](auto& record) {
          if constexpr (requires { record.channels; }) {
            std::erase_if(record.channels,
                          [&](const auto& channel) { return unwanted(channel.sensor); });
          }
        },
        run.data);
  }
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (!seen[i]) {
      throw arm::InputError(fmt::format("{} {}: not measured in any run", request.spelled("sensor"),
                                        request.sensors[i]));
    }
  }
}

/// A window, resolution, overlap or trend makes segments of a periodic torque, too.
measured::SpectrumSettings settings_of(const IdentificationRequest& request) {
  const SpectrumRequest& asked = request.spectrum;
  measured::SpectrumSettings settings;
  if (!asked.window.empty()) settings.window = measured::parse_window(asked.window);
  if (!asked.detrend.empty()) {
    settings.detrend = arm::read_word(
        request.spelled("detrend"), asked.detrend,
        std::array{measured::Detrend::none, measured::Detrend::mean, measured::Detrend::line});
  }
  if (asked.resolution_Hz && !(*asked.resolution_Hz > 0.0)) {
    throw arm::out_of_range(request.spelled("resolution"), *asked.resolution_Hz, "Hz", "above 0");
  }
  const auto& overlap = asked.overlap_percent;
  if (overlap && !(*overlap >= 0.0 && *overlap < 100.0)) {
    throw arm::out_of_range(request.spelled("overlap"), *overlap, "%", "0 or more and below 100");
  }
  settings.resolution_Hz = asked.resolution_Hz;
  if (overlap) settings.overlap = *overlap / 100.0;
  if (settings.window || settings.detrend || asked.resolution_Hz || overlap) {
    settings.periodic = false;
  }
  return settings;
}

measured::PeakPlace place_of(const IdentificationRequest& request) {
  const std::string& peaks = request.spectrum.peaks;
  if (peaks == "between") return measured::PeakPlace::resonance;
  if (peaks == "on-line") return measured::PeakPlace::on_line;
  throw arm::InputError(
      fmt::format("{} {}: must be between (interpolated) or on-line (as in the paper)",
                  request.spelled("peaks"), arm::shown(peaks)));
}

measured::IdentificationOptions options_of(const IdentificationRequest& request,
                                           const std::optional<arm::Arm>& arm) {
  measured::IdentificationOptions options;
  options.spectrum = settings_of(request);
  options.peaks.place = place_of(request);
  if (!request.input.empty()) {
    options.input =
        arm::read_word(request.spelled("input"), request.input, measured::kResponseInputs);
  }
  if (arm) options.arms = described_arms(*arm);
  options.fit = request.fit;
  if (request.modes && *request.modes < 1) {
    throw arm::out_of_range(request.spelled("modes"), *request.modes, "", "1 or more");
  }
  if (request.highest_order < 2 || request.highest_order > 100) {
    throw arm::out_of_range(request.spelled("order"), request.highest_order, "", "2 to 100");
  }
  if (request.total_inertia_kg_m2) {
    arm::require_in_range(request.spelled("total-inertia"), *request.total_inertia_kg_m2, "kg m^2",
                          arm::kPositive);
  }
  options.total_inertia_kg_m2 = request.total_inertia_kg_m2;
  options.modal_fit.modes = request.modes;
  options.modal_fit.highest_order = request.highest_order;
  if (arm) options.modal_fit.rigid_body = arm::linear_arm(*arm).turns_freely();
  if (request.from_Hz || request.to_Hz) {
    const double from_Hz = request.from_Hz.value_or(0.0);
    if (!(from_Hz >= 0.0)) {
      throw arm::out_of_range(request.spelled("from-Hz"), from_Hz, "Hz", "0 or more");
    }
    if (!request.to_Hz || !(*request.to_Hz > from_Hz)) {
      throw arm::InputError(
          fmt::format("{}: must be given, and above {:g} Hz", request.spelled("to-Hz"), from_Hz));
    }
    options.modal_fit.band = {from_Hz, *request.to_Hz};
    options.peaks.from_Hz = from_Hz;
    options.peaks.to_Hz = *request.to_Hz;
  }
  return options;
}

std::optional<arm::Arm> arm_of(const std::filesystem::path& measurement_file,
                               const measured::Measurement& measurement) {
  if (measurement.arm.empty()) return std::nullopt;
  const auto arm_file = measured::arm_file_of(measurement_file, measurement);
  if (measured::is_unfilled_arm_file(arm_file)) return std::nullopt;
  arm::Arm arm = measured::read_arm_file(arm_file, effects::vocabulary());
  arm::require_valid(arm);
  return arm;
}

}  // namespace

IdentificationTask read_identification_task(const std::filesystem::path& measurement_file,
                                            const IdentificationRequest& request) {
  IdentificationTask task;
  task.measurement = measured::read_measurement(measurement_file);
  task.arm = arm_of(measurement_file, task.measurement);
  task.options = options_of(request, task.arm);
  for (const auto& run : chosen_runs(request, task.measurement, measurement_file.string())) {
    task.runs.push_back({run, measured::read_run(measurement_file, run)});
  }
  select_sensors(request, task.runs);
  return task;
}

IdentificationTask identification_task(const std::string& name, const std::optional<arm::Arm>& arm,
                                       const std::vector<measured::MeasuredRun>& runs,
                                       const IdentificationRequest& request) {
  IdentificationTask task{{name, "", {}}, arm, {}, {}};
  for (const auto& [run, data] : runs) task.measurement.runs.push_back(run);
  if (arm) arm::require_valid(*arm);
  task.options = options_of(request, task.arm);
  for (const auto& chosen : chosen_runs(request, task.measurement, "the measurement")) {
    task.runs.push_back(
        *std::ranges::find(runs, chosen.id, [](const auto& one) { return one.run.id; }));
  }
  select_sensors(request, task.runs);
  return task;
}

}  // namespace flexarm::compare
