#pragma once

#include "app/arm_choice.hpp"
#include "arm/controller.hpp"
#include "measured/files/measurement.hpp"
#include "measured/files/time_record.hpp"
#include "response/excitation/excitation_keys.hpp"
#include "response/time/stepped_sine.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}  // namespace CLI

namespace flexarm::app {

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
  bool has_own_id = false;  ///< typed, not made from the excitation
  /// In place of times and torque.
  std::optional<response::SteppedSine> stepped_sine = {};
  /// Of a closed loop, in place of the torque.
  std::optional<arm::Controller> controller = {};
  measured::Reference reference = {};
};

/// The runs that a command simulates: each excitation, torque file and reference with each payload.
struct RunChoice {
  std::vector<std::string> excitations;  ///< KIND:KEY=VALUE,...; none and no file: bang-bang
  std::vector<std::string> torque_files;
  std::vector<std::string> references;  ///< of closed loops: KIND:KEY=VALUE,... or a CSV file
  std::string controller;               ///< of them: KEY=VALUE,... or a TOML file
  std::optional<double> duration_s;
  std::optional<double> period_s;
  std::uint64_t seed = 1;

  /// Throws InputError for what cannot be read, does not fit, or goes by one id.
  std::vector<PlannedRun> runs(const arm::Arm& arm,
                               const std::vector<double>& payload_masses_kg) const;
};

inline constexpr double kDefaultDuration_s = 4.0;
inline constexpr double kDefaultPeriod_s = 0.0005;

/// What `--controller` states: KEY=VALUE,... or a TOML file. Throws InputError as
/// measured/files/controller_keys.hpp.
arm::Controller read_controller(const std::string& text);

/// The id of a run, which names its files. Throws InputError for what is no name of a file.
std::string require_id(const std::string& id);

/// "estimation" or "validation". Throws InputError for any other word.
measured::Purpose read_purpose(std::string_view value);

/// An id made of the name of a file.
std::string id_of_file(const std::string& file);

/// Adds `--excitation`, `--torque`, `--reference`, `--controller`, `--duration`, `--period` and
/// `--seed` to a command.
void add_run_choice(CLI::App& parser, RunChoice& choice);

}  // namespace flexarm::app
