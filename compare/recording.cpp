#include "compare/recording.hpp"

#include "arm/input_error.hpp"
#include "effects/registry/vocabulary.hpp"
#include "measured/files/arm_file.hpp"

#include <fmt/format.h>

#include <set>

namespace flexarm::compare {

std::string Recording::place() const {
  return file.empty() ? "measurement" : arm::shown(file.string());
}

std::string Recording::place(const measured::Run& run) const {
  return file.empty() ? "measurement" : arm::shown(measured::beside(file, run.file).string());
}

Recording read_recording(const std::filesystem::path& measurement_file) {
  const auto measurement = measured::read_measurement(measurement_file);
  Recording recording{measurement.name,
                      measured::read_arm_file(measured::arm_file_of(measurement_file, measurement),
                                              effects::vocabulary()),
                      {},
                      measurement_file,
                      measured::files_of(measurement_file, measurement)};
  for (const auto& run : measurement.runs) {
    recording.runs.push_back({run, measured::read_run(measurement_file, run)});
  }
  return recording;
}

void require_valid(const Recording& recording) {
  if (recording.runs.empty()) throw arm::InputError("runs: none; needs one or more");
  std::set<std::string> ids;
  for (const auto& [run, data] : recording.runs) {
    if (!ids.insert(run.id).second) {
      throw arm::InputError(fmt::format("runs: two have the id {}; each needs its own", run.id));
    }
    measured::require_valid(run, data);
  }
}

}  // namespace flexarm::compare
