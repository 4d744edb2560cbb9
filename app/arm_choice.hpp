#pragma once

#include "arm/arm.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}  // namespace CLI

namespace flexarm::app {

/// The arm that a command works on: a file, or the paper's arm, with numbers changed on the command
/// line.
struct ArmChoice {
  std::string file;                             ///< empty: the paper's arm
  std::vector<double> payload_masses_kg;        ///< empty: the arm's own
  std::optional<double> payload_inertia_kg_m2;  ///< empty: the arm's own
  std::optional<double> hub_inertia_kg_m2;      ///< empty: the arm's own

  /// One arm a payload mass asked for, at least one. Throws InputError.
  std::vector<arm::Arm> arms() const;
};

/// Adds `ARM` and the options that change its numbers to a command.
void add_arm_choice(CLI::App& parser, ArmChoice& choice);

/// What a report calls the choice: the arm file, or "the paper's arm".
std::string subject_of(const ArmChoice& choice);

/// Where the files of one of `arms` arms go: `out` itself, or a folder in it named for the payload.
std::filesystem::path folder_of(const std::filesystem::path& out, const arm::Arm& arm,
                                std::size_t arms);

/// Name, rigidity, density, inertias and their ratios, effects, what is not plausible: lines for
/// the head of an output.
std::string describe(const arm::Arm& arm);

/// Lines that name the arm's effects that its poles, zeros and modes leave out, since they act
/// outside its linear equations, and those that are there with their slopes at rest; empty where
/// there are none.
std::string left_out_of_roots(const arm::Arm& arm);

}  // namespace flexarm::app
