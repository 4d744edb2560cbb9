#pragma once

#include "arm/arm.hpp"
#include "arm/controller.hpp"
#include "arm/option_name.hpp"
#include "measured/files/measurement.hpp"
#include "measured/files/time_record.hpp"
#include "response/excitation/excitation_keys.hpp"
#include "response/time/stepped_sine.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::experiment {

/// A time of an excitation that was moved to whole samples.
struct RoundedKey {
  std::string name;
  std::string unit;
  std::string typed;
  std::string taken;
};

/// A run that was asked for, with its torque: in time, or a stepped sine.
struct PlannedRun {
  std::string id;
  std::string excitation;                     ///< its name, or that of the torque's file
  std::vector<response::ExcitationKey> keys;  ///< as they were taken
  std::vector<double> time_s;
  response::SampledTorque torque;
  std::optional<arm::Payload> payload;  ///< in place of the arm's own
  std::optional<measured::Purpose> purpose;
  std::vector<RoundedKey> rounded;
  std::string id_typed_in = {};  ///< option and value; empty: the id is made from the excitation
  /// In place of times and torque.
  std::optional<response::SteppedSine> stepped_sine = {};
  /// Of a closed loop, in place of the torque.
  std::optional<arm::Controller> controller = {};
  measured::Reference reference = {};
};

/// The runs to be simulated, in a user's words: each excitation, torque file and reference with
/// each payload.
struct RunChoice {
  std::vector<std::string> excitations;  ///< KIND:KEY=VALUE,...; none and no file: bang-bang
  std::vector<std::string> torque_files;
  std::vector<measured::TimeRecord> torque_records = {};  ///< given as numbers, without a file
  std::vector<std::string> references;  ///< of closed loops: KIND:KEY=VALUE,... or a CSV file
  /// References given as numbers, in the unit of the controller's first sensor.
  std::vector<measured::TimeRecord> reference_records = {};
  std::string controller;                    ///< of them: KEY=VALUE,... or a TOML file
  std::optional<arm::Controller> loop = {};  ///< in place of `controller`
  std::optional<double> duration_s;
  std::optional<double> period_s;
  std::uint64_t seed = 1;
  arm::OptionSpelling spelled = arm::on_command_line;  ///< of options in errors

  /// Throws InputError for what cannot be read, does not fit, or goes by one id.
  std::vector<PlannedRun> runs(const arm::Arm& arm,
                               const std::vector<double>& payload_masses_kg) const;
};

inline constexpr double kDefaultDuration_s = 4.0;
inline constexpr double kDefaultPeriod_s = 0.0005;

/// A controller as KEY=VALUE,... or a TOML file; `option` stands in front of what is wrong with the
/// former. Throws InputError as measured/files/controller_keys.hpp.
arm::Controller read_controller(const std::string& text, const std::string& option);

/// The id of a run, which names its files. Throws InputError for what is no name of a file.
std::string require_id(const std::string& id);

/// "estimation" or "validation". Throws InputError for any other word.
measured::Purpose read_purpose(std::string_view value);

/// An id made of the name of a file: its letters, digits, - _ and ., at most 48; - in place of what
/// else stands between them. "run" where nothing is left.
std::string id_of_file(const std::string& file);

}  // namespace flexarm::experiment
