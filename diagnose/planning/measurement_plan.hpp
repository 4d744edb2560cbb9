#pragma once

#include "arm/payload.hpp"
#include "arm/sensor.hpp"
#include "measured/files/measurement.hpp"
#include "response/excitation/excitation.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace flexarm::diagnose {

/// Frequencies in equal ratios, both ends included.
struct PlannedBand {
  double from_Hz = 0.0;
  double to_Hz = 0.0;
  int count = 0;

  bool operator==(const PlannedBand&) const = default;
};

/// A sensor of a planned run.
struct PlannedSensor {
  arm::Sensor sensor;
  /// Standard deviation of its noise: of a `time` run over that of the signal, of an `frf` run of
  /// real and of imaginary part over the response, of a `modal` run of a zero over its frequency.
  double noise = 0.0;
  int zeros = 0;  ///< of a `modal` run: the lowest so many
};

/// A run that has not been made.
struct PlannedRun {
  std::string id;
  measured::RunKind kind = measured::RunKind::time;
  std::optional<measured::Purpose> purpose = {};
  std::optional<arm::Payload> payload = {};  ///< in place of the arm's own
  std::vector<PlannedSensor> sensors = {};

  // of a `time` run
  measured::TorqueHold torque_hold = measured::TorqueHold::zero;
  /// An excitation, or a torque as it was recorded [N m], one a sample.
  std::variant<response::Excitation, std::vector<double>> torque = {};
  double duration_s = 0.0;
  double sample_time_s = 0.0;
  // of an `frf` run
  std::variant<PlannedBand, std::vector<double>> frequencies = {};  ///< a list in Hz
  // of a `modal` run
  int poles = 0;
  double noise = 0.0;          ///< relative standard deviation of a pole's frequency
  double damping_noise = 0.0;  ///< of damping ratios, relative
};

/// An experiment before it is made: measurement-plan.toml (docs/formats.md).
struct MeasurementPlan {
  std::string name;
  std::vector<PlannedRun> runs;
};

/// Relative noise of what the file gives none for.
inline constexpr double kPlannedNoise = 0.005;
inline constexpr double kPlannedModalNoise = 0.002;
inline constexpr double kPlannedDampingNoise = 0.1;

/// Reads a plan. Throws InputError `FILE:LINE: KEY = VALUE: what is wrong; what is allowed`, as
/// `measured::read_measurement` does, also for keys of another kind of run and for excitations that
/// do not fit into the run.
MeasurementPlan read_measurement_plan(const std::filesystem::path& path);

/// The same for the text of a file; `file_name` stands in the errors.
MeasurementPlan parse_measurement_plan(std::string_view toml, const std::string& file_name);

/// The plan as the text of a file, which `parse_measurement_plan` reads back. Throws
/// std::invalid_argument for a run whose torque was recorded: the format has excitations.
std::string format_measurement_plan(const MeasurementPlan& plan);

/// Ascending frequencies of an `frf` run [Hz].
std::vector<double> frequencies_of(const PlannedRun& run);

/// The torque of a `time` run at its samples [N m]. Throws InputError as `response::sample` does.
std::vector<double> torque_of(const PlannedRun& run);

}  // namespace flexarm::diagnose
