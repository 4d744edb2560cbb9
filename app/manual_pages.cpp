#include "app/command.hpp"
#include "app/manual_page_text.hpp"
#include "app/option_tree.hpp"
#include "measured/files/atomic_file.hpp"

#include <CLI/CLI.hpp>

#include <filesystem>
#include <memory>
#include <string>

namespace flexarm::app {

/// For the build, which installs the pages; no help lists it.
Command add_manual_pages(CLI::App& program) {
  const auto folder = std::make_shared<std::string>();
  CLI::App* parser = program.add_subcommand("manual-pages", "Write the manual pages to a folder");
  parser->group("");
  parser->add_option("FOLDER", *folder, "Folder for flexarm.1, flexarm-compare.1, ...")->required();
  return {parser, [folder, &program] {
            const std::filesystem::path place = *folder;
            measured::make_folder(*folder);
            const auto commands = describe_commands(program);
            measured::write_atomically(place / "flexarm.1",
                                       manual_page(describe_program(program), commands));
            for (const auto& command : commands) {
              measured::write_atomically(place / ("flexarm-" + command.name + ".1"),
                                         manual_page(command));
            }
            return kSuccess;
          }};
}

}  // namespace flexarm::app
