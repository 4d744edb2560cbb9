#include "app/measured_choice.hpp"

#include "arm/input_error.hpp"
#include "measured/files/csv.hpp"
#include "measured/files/foreign_file.hpp"
#include "measured/files/text_file.hpp"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>
#include <variant>

namespace flexarm::app {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargestMeasuredFile_bytes = std::size_t{1} << 28U;

/// The kinds of file that `--measured` takes, as an error names them.
constexpr const char* kMeasuredFile =
    "must be a modal table or frequency responses (CSV), or a measurement.toml, whose time runs "
    "are simulated";

bool is_frequency_record(const std::string& file) {
  const std::string text = measured::read_text_file(file, kLargestMeasuredFile_bytes);
  try {
    const auto rows = measured::parse_csv(text, arm::shown(file));
    return !rows.empty() && std::ranges::count(rows.front().cells, "re") > 0;
  } catch (const arm::InputError&) {
    return false;  // the reader of modal tables says what it is
  }
}

MeasuredFile runs_of_measurement(const std::string& file) {
  const auto measurement = measured::read_measurement(file);
  MeasuredFile read;
  read.files = measured::files_of(file, measurement);
  read.arm_file = measured::arm_file_of(file, measurement);
  for (const auto& run : measurement.runs) {
    read.runs.push_back(run);
    read.data.push_back(measured::read_run(file, run));
  }
  return read;
}

/// Whether the run is of this arm.
bool has_payload_of(const measured::Run& run, const arm::Arm& arm) {
  return !run.payload || *run.payload == arm.payload;
}

}  // namespace

bool MeasuredFile::is_in_time() const {
  return !data.empty() && std::ranges::all_of(data, [](const measured::RunData& run) {
    return std::holds_alternative<measured::TimeRecord>(run);
  });
}

std::vector<arm::Sensor> MeasuredFile::sensors_with_zeros() const {
  std::vector<arm::Sensor> sensors;
  for (const auto& run : data) {
    const auto* table = std::get_if<measured::ModalTable>(&run);
    if (table == nullptr) continue;
    for (const auto& sensor : compare::sensors_with_zeros(*table)) {
      if (std::ranges::find(sensors, sensor) == sensors.end()) sensors.push_back(sensor);
    }
  }
  return sensors;
}

MeasuredFile read_measured_file(const std::string& file) {
  const std::string extension = fs::path(file).extension().string();
  if (extension == ".toml") return runs_of_measurement(file);
  MeasuredFile read;
  read.runs.emplace_back();
  read.files = {file};
  if (std::ranges::count(std::vector<std::string>{".uff", ".unv", ".uf58", ".mat"}, extension) >
      0) {
    read.data.emplace_back(
        measured::frequency_record_of(measured::read_foreign_file(file), {}, arm::shown(file)));
  } else if (is_frequency_record(file)) {
    read.data.emplace_back(measured::read_frequency_record(file));
  } else {
    read.data.emplace_back(measured::read_modal_table(file, kMeasuredFile));
  }
  return read;
}

compare::MeasuredComparison beside_models(const MeasuredFile& measured, const arm::Arm& whole,
                                          const compare::Comparison& comparison, bool alone,
                                          const arm::Deadline& deadline,
                                          const std::function<void()>& after_run) {
  compare::MeasuredComparison all;
  for (std::size_t i = 0; i < measured.runs.size(); ++i) {
    const measured::Run& run = measured.runs[i];
    const measured::RunData& data = measured.data[i];
    const bool is_of_arm = has_payload_of(run, whole);
    const bool is_simulated = std::holds_alternative<measured::TimeRecord>(data);
    if (!is_of_arm && !(is_simulated && alone)) {
      all.runs_left_out.push_back(run.id);
    } else if (is_simulated) {
      try {
        all.runs.push_back(compare::run_beside_simulation(whole, {run, data}, deadline));
      } catch (const arm::Cancelled&) {
        all.runs_out_of_time.push_back(run.id);
      }
    } else if (const auto* table = std::get_if<measured::ModalTable>(&data)) {
      auto rows = compare::beside_model(*table, comparison);
      if (auto shapes = compare::correlate_shapes(rows, comparison)) {
        all.shapes.push_back(std::move(*shapes));
      }
      std::ranges::move(rows, std::back_inserter(all.rows));
    } else if (const auto* record = std::get_if<measured::FrequencyRecord>(&data)) {
      auto responses = compare::responses_beside_models(whole, run.id, *record);
      std::ranges::move(responses, std::back_inserter(all.responses));
    }
    after_run();
  }
  return all;
}

}  // namespace flexarm::app
