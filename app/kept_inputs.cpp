#include "app/kept_inputs.hpp"

#include "app/json_file.hpp"
#include "arm/input_error.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>
#include <utility>

namespace flexarm::app {

namespace {

namespace fs = std::filesystem;

/// Options, of whatever command, whose value is a file or a folder to be written.
constexpr std::array<std::string_view, 7> kOutputs = {
    "--json", "--out", "--state-space", "--save-as", "--write", "--report", "--fmu"};

/// A value on the command line that names a file.
struct NamedFile {
  std::string option;
  fs::path path;
};

bool is_output(const CLI::App& command, const CLI::Option& option) {
  const std::string name = option.get_name();
  if (command.get_name() == "new" && name == "FILE") return true;
  return std::ranges::count(kOutputs, std::string_view(name)) > 0;
}

/// One file under either name. What is not there yet is told by its path.
bool is_same_file(const fs::path& one, const fs::path& other) {
  std::error_code error;
  if (fs::equivalent(one, other, error)) return true;
  return fs::weakly_canonical(one, error) == fs::weakly_canonical(other, error);
}

bool is_in_folder(const fs::path& file, const fs::path& folder) {
  std::error_code error;
  const fs::path relative =
      fs::weakly_canonical(file, error).lexically_relative(fs::weakly_canonical(folder, error));
  return !relative.empty() && relative.begin()->string() != "..";
}

}  // namespace

void require_no_input(const std::string& option, const fs::path& output,
                      const std::vector<fs::path>& inputs) {
  std::error_code error;
  for (const fs::path& input : inputs) {
    if (fs::is_directory(output, error) && is_in_folder(input, output)) {
      throw arm::InputError(fmt::format("{} {}: has the input {} in it", option,
                                        arm::shown(output.string()), arm::shown(input.string())));
    }
    if (!is_same_file(output, input)) continue;
    throw arm::InputError(fmt::format("{} {}: would overwrite the input {}", option,
                                      arm::shown(output.string()), arm::shown(input.string())));
  }
}

void require_inputs_kept(const CLI::App& command) {
  std::vector<NamedFile> outputs;
  std::vector<fs::path> inputs;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& value : option->results()) {
      std::error_code error;
      if (!is_output(command, *option)) {
        if (fs::is_regular_file(value, error)) inputs.emplace_back(value);
      } else if (!value.empty() && !is_standard_output(value)) {
        outputs.push_back({option->get_name(), value});
      }
    }
  }
  for (const auto& [option, path] : outputs) require_no_input(option, path, inputs);
  for (auto one = outputs.begin(); one != outputs.end(); ++one) {
    const auto other = std::find_if(one + 1, outputs.end(), [&](const NamedFile& file) {
      return is_same_file(file.path, one->path);
    });
    if (other == outputs.end()) continue;
    throw arm::InputError(fmt::format("{} {}: same file as {}", other->option,
                                      arm::shown(other->path.string()), one->option));
  }
}

}  // namespace flexarm::app
