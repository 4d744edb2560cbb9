#pragma once

#include "importing/column_choice.hpp"
#include "importing/import_runs.hpp"
#include "importing/joined_files.hpp"

namespace CLI {
class App;
}  // namespace CLI

namespace flexarm::app {

/// Adds `--column`, `--compute`, `--torque`, `--time-unit`, `--reference`, `--own-rate` and
/// `--leave-out` to a command.
void add_column_choice(CLI::App& parser, importing::ColumnChoice& choice);

/// Adds `--id`, `--rows`, `--times`, `--run` and what treats the samples of the runs.
void add_runs_choice(CLI::App& parser, importing::RunsChoice& choice);

/// Adds `--join` and `--join-grid`.
void add_join_choice(CLI::App& parser, importing::JoinChoice& choice);

}  // namespace flexarm::app
