#pragma once

#include "tests/app/process.hpp"

#include <map>
#include <string>
#include <vector>

namespace flexarm::testing_app {

/// Runs the program `flexarm` on a terminal of `columns` columns, to its end: what a user sees,
/// standard output and standard error together. `environment` is set besides.
Ended run_on_terminal(const std::vector<std::string>& arguments, unsigned short columns,
                      const std::map<std::string, std::string>& environment = {});

/// The same, with Ctrl-C typed once the program shows its progress.
Ended interrupt_on_terminal(const std::vector<std::string>& arguments, unsigned short columns);

}  // namespace flexarm::testing_app
