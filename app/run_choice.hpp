#pragma once

#include "experiment/run_choice.hpp"

namespace CLI {
class App;
}  // namespace CLI

namespace flexarm::app {

using experiment::id_of_file;
using experiment::PlannedRun;
using experiment::read_purpose;
using experiment::require_id;
using experiment::RunChoice;

/// Adds `--excitation`, `--torque`, `--reference`, `--controller`, `--duration`, `--period` and
/// `--seed` to a command.
void add_run_choice(CLI::App& parser, RunChoice& choice);

}  // namespace flexarm::app
