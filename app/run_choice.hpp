#pragma once

#include "response/experiment/run_choice.hpp"

namespace CLI {
class App;
}  // namespace CLI

namespace flexarm::app {

using response::id_of_file;
using response::PlannedRun;
using response::read_purpose;
using response::require_id;
using response::RunChoice;

/// Adds `--excitation`, `--torque`, `--reference`, `--controller`, `--duration`, `--period` and
/// `--seed` to a command.
void add_run_choice(CLI::App& parser, RunChoice& choice);

}  // namespace flexarm::app
