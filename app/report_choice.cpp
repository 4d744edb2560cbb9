#include "app/report_choice.hpp"

#include "app/command.hpp"
#include "app/folder_place.hpp"
#include "app/kept_inputs.hpp"
#include "app/version.hpp"
#include "arm/input_error.hpp"
#include "arm/number.hpp"
#include "measured/files/atomic_file.hpp"
#include "report/page/page_file.hpp"

#include <CLI/CLI.hpp>
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <string_view>
#include <utility>

namespace flexarm::app {

namespace {

namespace fs = std::filesystem;

std::string& command_line() {
  static std::string line = "flexarm";
  return line;
}

/// An argument as it is typed to a shell.
std::string typed(std::string_view argument) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_@%+=:,./-";
  if (!argument.empty() && argument.find_first_not_of(kPlain) == std::string_view::npos) {
    return std::string(argument);
  }
  std::string made = "'";
  for (const char c : argument) {
    if (c == '\'') {
      made += "'\\''";
    } else {
      made += c;
    }
  }
  return made + "'";
}

/// The date of the run in UTC; that of SOURCE_DATE_EPOCH, where it is set, so that a page can be
/// made again.
std::string today() {
  std::time_t seconds = std::time(nullptr);
  if (const char* epoch = std::getenv("SOURCE_DATE_EPOCH")) {
    constexpr std::int64_t kYear9999_s = 253402300799;
    if (const auto given = arm::parse_number<std::int64_t>(epoch)) {
      seconds = std::clamp(*given, std::int64_t{0}, kYear9999_s);
    }
  }
  return fmt::format("{:%Y-%m-%d}", fmt::gmtime(seconds));
}

}  // namespace

void note_command_line(int argc, const char* const* argv) {
  std::string line = "flexarm";
  for (int i = 1; i < argc; ++i) line += " " + typed(argv[i]);
  command_line() = std::move(line);
}

void ReportChoice::prepare(const std::string& folder, const std::vector<fs::path>& inputs) const {
  if (!is_given()) return;
  const std::string extension = fs::path(file).extension().string();
  if (extension != ".html" && extension != ".htm") {
    throw arm::InputError(fmt::format("--report {}: must end in .html", arm::shown(file)));
  }
  require_no_input("--report", file, inputs);
  require_json_place(file, folder);
}

void ReportChoice::write(report::page::PageDocument document) const {
  document.date = today();
  measured::write_atomically(file, report::page::page_html(std::move(document)));
}

std::string ReportChoice::last_line() const {
  return is_given() ? fmt::format("wrote {}\n", file) : "";
}

void add_report_choice(CLI::App& parser, ReportChoice& choice) {
  parser
      .add_option("--report", choice.file,
                  "HTML file for a report with interactive figures; it opens without a network")
      ->check(not_empty());
}

report::page::PageOrigin page_origin(const std::string& subject) {
  std::string program = version_text();
  program = program.substr(0, program.find('\n'));
  return {std::move(program), command_line(), subject};
}

}  // namespace flexarm::app
