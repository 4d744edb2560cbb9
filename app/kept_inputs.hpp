#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace CLI {
class App;
}  // namespace CLI

namespace flexarm::app {

/// Throws arm::InputError where an output that the command line names would take the place of a
/// file that it reads, or of another output: by the same path or by another name of the same file
/// (symbolic and hard links). A folder that is written must not hold a file that is read.
///
/// Outputs are known by their options; every other value that names a file is an input.
void require_inputs_kept(const CLI::App& command);

/// The same for an output and inputs that the command line does not name. `option` begins the
/// error.
void require_no_input(const std::string& option, const std::filesystem::path& output,
                      const std::vector<std::filesystem::path>& inputs);

}  // namespace flexarm::app
