#include "app/command.hpp"
#include "app/json_file.hpp"
#include "app/standard_output.hpp"
#include "app/starter_arm.hpp"
#include "arm/input_error.hpp"
#include "measured/files/arm_file.hpp"
#include "measured/files/atomic_file.hpp"
#include "report/json/arm_json.hpp"
#include "report/json/json_document.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <system_error>

namespace flexarm::app {

namespace {

namespace fs = std::filesystem;

/// The file's name without its extension, as an arm file may have it: bytes that are no text
/// escaped.
std::string arm_name(const fs::path& path) {
  const std::string name = path.stem().string();
  try {
    measured::parse_arm(starter_text(name), path.string(), {});
  } catch (const arm::InputError&) {
    return arm::shown(name);
  }
  return name;
}

int write_starter(const fs::path& path, bool force, const std::string& json) {
  std::error_code ignored;
  if (!force && fs::exists(fs::symlink_status(path, ignored))) {
    throw arm::InputError(
        fmt::format("{}: already exists; --force overwrites it", arm::shown(path.string())));
  }
  const std::string name = arm_name(path);
  measured::write_atomically(path, starter_text(name));
  write_json(
      json, report::json_document("flexarm.new/1", {{"file", path.string()},
                                                    {"arm", report::arm_json(starter_arm(name))}}));
  print(fmt::format("wrote {}\nnext: edit the values, then  flexarm modes {}\n",
                    arm::shown(path.string()), arm::shown(path.string())));
  return kSuccess;
}

}  // namespace

Command add_new(CLI::App& program) {
  struct Options {
    std::string path;
    bool force = false;
    std::string json;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* parser = program.add_subcommand("new", "Write a commented arm file template");
  parser->add_option("FILE", options->path, "Arm file to write, e.g. rig.toml")->required();
  parser->add_flag("--force", options->force, "Overwrite an existing file");
  parser->add_option(
      "--json", options->json,
      "JSON file with the numbers of the arm, full precision; - for standard output");
  parser->footer(example("flexarm new rig.toml"));
  return {parser,
          [options] { return write_starter(options->path, options->force, options->json); }};
}

}  // namespace flexarm::app
