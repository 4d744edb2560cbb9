#include "app/command.hpp"
#include "app/folder_place.hpp"
#include "app/json_file.hpp"
#include "app/screen.hpp"
#include "app/standard_output.hpp"
#include "app/version.hpp"
#include "arm/arm.hpp"
#include "report/figures/gnuplot.hpp"
#include "report/json/json_document.hpp"
#include "report/terminal.hpp"
#include "response/formulation_maker.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <tbb/task_arena.h>
#include <thread>
#include <unistd.h>
#include <vector>

namespace flexarm::app {

namespace {

namespace fs = std::filesystem;

enum class Condition {
  ok,
  warning,  ///< flexarm works; something is less than it could be
  failed    ///< something that flexarm needs does not work
};

std::string word_for(Condition condition) {
  switch (condition) {
    case Condition::ok:
      return "ok";
    case Condition::warning:
      return "warning";
    case Condition::failed:
      return "failed";
  }
  return "";
}

/// One thing that was tried.
struct Check {
  std::string name;
  Condition condition = Condition::ok;
  std::string found = {};
  std::string advice = {};            ///< what to do; empty where there is nothing
  std::optional<double> time_s = {};  ///< that it took
};

/// Poles of the paper's arm [Hz], from the 30-digit values of tests/reference/exact.json.
constexpr std::array kKnownPoles_Hz = {11.86182864446254, 32.26056709631877, 58.53265337267774};
constexpr double kPoleTolerance = 1e-9;
constexpr double kLeastSpace_bytes = 1e9;

class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun_).count();
  }

 private:
  std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
};

/// The first line that a program prints; empty where it is missing or fails.
std::string first_line_of(const char* command) {
  std::string text;
  std::FILE* output = ::popen(command, "r");
  if (output == nullptr) return "";
  std::array<char, 512> buffer{};
  while (std::fgets(buffer.data(), buffer.size(), output) != nullptr) text += buffer.data();
  if (::pclose(output) != 0) return "";
  return text.substr(0, text.find('\n'));
}

Check libraries() {
  std::string found;
  for (const auto& list : {numeric_libraries(), text_libraries()}) {
    for (const auto& [name, version] : list) {
      found += fmt::format("{}{} {}", found.empty() ? "" : ", ", name, version);
    }
  }
  return {"libraries", Condition::ok, found};
}

Check processor() {
  return {"processor", Condition::ok,
          fmt::format("{} cores; sweeps use {} threads", std::thread::hardware_concurrency(),
                      tbb::this_task_arena::max_concurrency())};
}

Check formulation(const std::string& name) {
  Check check{name};
  try {
    const Stopwatch stopwatch;
    const auto poles =
        response::poles(response::make_formulation(name, arm::paper_arm(), kKnownPoles_Hz.size()),
                        kKnownPoles_Hz.size());
    check.time_s = stopwatch.seconds();
    double largest = 0.0;
    for (std::size_t i = 0; i < kKnownPoles_Hz.size(); ++i) {
      const double pole_Hz = poles.omega_rad_per_s.at(i) / (2.0 * std::numbers::pi);
      largest = std::max(largest, std::abs(pole_Hz / kKnownPoles_Hz[i] - 1.0));
    }
    check.found = fmt::format("{} poles of the paper's arm, relative error {:.1e}",
                              kKnownPoles_Hz.size(), largest);
    if (!(largest <= kPoleTolerance)) check.condition = Condition::failed;
  } catch (const std::exception& error) {
    check.condition = Condition::failed;
    check.found = error.what();
  }
  if (check.condition == Condition::failed) {
    check.advice = "build anew from unchanged sources, and run scripts/test";
  }
  return check;
}

Check gnuplot() {
  Check check{"gnuplot"};
  try {
    std::string version = report::run_gnuplot(
        "set print '-'\n"
        "print sprintf('%.1f patchlevel %s', GPVAL_VERSION, GPVAL_PATCHLEVEL)\n");
    version = version.substr(0, version.find('\n'));
    const Stopwatch stopwatch;
    const std::string drawn = report::run_gnuplot("set terminal svg\nplot sin(x)\n");
    check.time_s = stopwatch.seconds();
    const bool is_whole = drawn.find("</svg>") != std::string::npos;
    check.found = fmt::format("{}, {} a figure", version, is_whole ? "draws" : "does not draw");
    if (!is_whole) check.condition = Condition::failed;
  } catch (const std::exception& error) {
    check.condition = Condition::failed;
    check.found = error.what();
  }
  if (check.condition == Condition::failed) {
    check.advice = "figures (--out) need it: apt-get install gnuplot-nox";
  }
  return check;
}

Check fonts() {
  if (first_line_of("command -v fc-match").empty()) {
    return {"fonts", Condition::ok,
            "not examined: fc-match (Debian package fontconfig) is missing"};
  }
  const std::string family = first_line_of("fc-match --format '%{family}' sans 2>/dev/null");
  if (!family.empty()) return {"fonts", Condition::ok, "sans serif is " + family};
  return {"fonts", Condition::warning, "no sans serif font",
          "text of figures needs one: apt-get install fonts-dejavu-core"};
}

Check terminal() {
  const bool is_terminal = ::isatty(STDOUT_FILENO) == 1;
  return {"terminal", Condition::ok,
          fmt::format("{} columns, {}{}", report::output_width(STDOUT_FILENO),
                      report::shows_colour(STDOUT_FILENO) ? "colour" : "no colour",
                      is_terminal ? "" : " (standard output is no terminal)")};
}

Check folder(const std::string& name, const fs::path& path, const std::string& advice) {
  std::error_code error;
  const auto space = fs::space(path, error);
  if (error || ::access(path.c_str(), W_OK | X_OK) != 0) {
    return {name, Condition::warning, path.string() + " cannot be written", advice};
  }
  const auto free_bytes = static_cast<double>(space.available);
  Check check{name, Condition::ok,
              fmt::format("{} can be written, {:.3g} GB free", path.string(), 1e-9 * free_bytes)};
  if (free_bytes < kLeastSpace_bytes) {
    check.condition = Condition::warning;
    check.advice = "long simulations write more than is free";
  }
  return check;
}

Check python_module() {
  const std::string found = first_line_of(
      "/usr/bin/python3 -P -c 'import flexarm; print(getattr(flexarm, \"__version__\", "
      "\"without version\"), flexarm.__file__)' 2>/dev/null");
  return {"Python module", Condition::ok,
          found.empty() ? "not found by /usr/bin/python3 (the program does not need it)" : found};
}

std::vector<Check> examine() {
  std::vector<Check> checks = {{"program", Condition::ok, program_version() + ", " + build_text()},
                               libraries(),
                               processor()};
  for (const auto name : response::kFormulationNames) {
    checks.push_back(formulation(std::string(name)));
  }
  checks.push_back(gnuplot());
  checks.push_back(fonts());
  checks.push_back(terminal());
  checks.push_back(folder("this folder", fs::current_path(), "give --out elsewhere"));
  std::error_code error;
  const fs::path temporary = fs::temp_directory_path(error);
  checks.push_back(folder("temporary folder", error ? fs::path("/tmp") : temporary,
                          "set TMPDIR to a folder that can be written"));
  checks.push_back(python_module());
  return checks;
}

bool all_works(const std::vector<Check>& checks) {
  return std::ranges::count(checks, Condition::failed, &Check::condition) == 0;
}

std::string doctor_text(const std::vector<Check>& checks) {
  const bool works = all_works(checks);
  std::string text =
      works ? toned("Works: all that flexarm needs.\n\n", "Works", Tone::good)
            : toned("FAILED: something that flexarm needs does not work.\n\n", "FAILED", Tone::bad);
  report::Table table{"", {{"check"}, {"result"}, {"time", "ms", 3}, {"found"}}};
  for (const auto& check : checks) {
    table.add_row({check.name, word_for(check.condition),
                   check.time_s ? report::Cell(1e3 * *check.time_s) : report::Cell(), check.found});
  }
  text += screen_table(table);
  for (const auto& check : checks) {
    if (check.advice.empty()) continue;
    text += screen_note(fmt::format("{}: {}", check.name, check.advice),
                        check.condition == Condition::failed ? "failed" : "warning");
  }
  return text + (works ? "next: compare the three formulations with  flexarm compare\n" : "");
}

std::string doctor_json(const std::vector<Check>& checks) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const auto& check : checks) {
    nlohmann::ordered_json entry = {{"name", check.name},
                                    {"result", word_for(check.condition)},
                                    {"found", check.found},
                                    {"advice", nullptr},
                                    {"time_s", nullptr}};
    if (!check.advice.empty()) entry["advice"] = check.advice;
    if (check.time_s) entry["time_s"] = *check.time_s;
    list.push_back(std::move(entry));
  }
  return report::json_document("flexarm.doctor/1",
                               {{"works", all_works(checks)}, {"checks", list}});
}

}  // namespace

Command add_doctor(CLI::App& program) {
  const auto json_file = std::make_shared<std::string>();
  CLI::App* parser =
      program.add_subcommand("doctor", "Check what is installed and what works, and what to do");
  parser->add_option("--json", *json_file, "JSON file, full precision; - for standard output")
      ->check(not_empty());
  parser->footer("Exit status: 0 all that flexarm needs works; 1 something does not.\n" +
                 example("flexarm doctor"));
  return {parser, [json_file] {
            require_json_place(*json_file, "");
            const auto checks = examine();
            write_json(*json_file, doctor_json(checks));
            print(doctor_text(checks));
            return all_works(checks) ? kSuccess : kFailure;
          }};
}

}  // namespace flexarm::app
