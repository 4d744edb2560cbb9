#pragma once

#include "compare/identification_task.hpp"

namespace CLI {
class App;
}  // namespace CLI

namespace flexarm::app {

/// Adds `--window`, `--resolution`, `--overlap`, `--detrend` and `--peaks`.
void add_spectrum_choice(CLI::App& parser, compare::SpectrumRequest& choice);

}  // namespace flexarm::app
