// The program `trials`: makes cases with hidden causes, asks `flexarm diagnose`, and counts.
#include "arm/input_error.hpp"
#include "measured/files/atomic_file.hpp"
#include "tests/trials/results_file.hpp"
#include "tests/trials/scorecard.hpp"
#include "tests/trials/trial_list.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <exception>
#include <mutex>
#include <thread>
#include <unistd.h>

namespace flexarm::trials {

namespace {

namespace fs = std::filesystem;

struct TrialOptions {
  TrialChoice choice;
  std::string program = FLEXARM_PROGRAM;
  std::string version = kUnknownVersion;
  std::string keep;
  std::string results = "trials.csv";
  std::string scorecard;
  double time_limit_s = 240.0;
  int jobs = 1;
  bool list = false;
  std::string only;
};

TrialOptions parse_options(CLI::App& app, int argc, char** argv) {
  TrialOptions options;
  TrialChoice& choice = options.choice;
  app.add_option("--kind", choice.kinds, "time, frf, modal")->delimiter(',');
  app.add_option("--effects", choice.effects,
                 "Effects to simulate: names, several at once joined by +; or single (each of the "
                 "library), one (drawn by chance), "
                 "pairs, triples, none, outside, outside-pairs, rig (five to eight at once)")
      ->delimiter(',');
  app.add_option("--strength", choice.strengths,
                 "faint, weak, middle, strong; default: all except faint")
      ->delimiter(',');
  app.add_option("--arm", choice.arm,
                 "aluminium link, steel link, sandwich link, steel ruler; default: by chance");
  app.add_option(
      "--size", choice.size,
      "Size of the effect in place of the strengths; of a changed number its logarithm; of a "
      "rig the largest NRMSE that an effect makes, default 0.3");
  app.add_option(
         "--dirt", choice.dirts,
         "What a laboratory adds to time runs: all, none, or names as closed_loop; default: "
         "none")
      ->delimiter(',');
  app.add_option("--dirt-size", choice.dirt_size, "Size of the dirt; 1 is usual, 0 none")
      ->capture_default_str();
  app.add_option("--noise", choice.noises, "Noise-to-signal ratio")->delimiter(',');
  app.add_option("--trials", choice.trials, "Number of trials of each combination")
      ->capture_default_str();
  app.add_option("--seed", choice.seed, "Seed of the random numbers")->capture_default_str();
  app.add_option("--keep", options.keep,
                 "Folder for the cases: cases/ (input of the program), truth/, answers/");
  // scripts/trials gives these two; others behind them count.
  app.add_option("--results", options.results,
                 "CSV file to which results are appended; existing trials are skipped")
      ->capture_default_str()
      ->take_last();
  app.add_option("--scorecard", options.scorecard, "Markdown file for the scorecard")->take_last();
  app.add_option("--program", options.program, "The program flexarm")->capture_default_str();
  app.add_option("--built-from", options.version,
                 "Version of the program, stored with the results; one version per file")
      ->capture_default_str();
  app.add_option("--time-limit", options.time_limit_s,
                 "Time after which a diagnosis answers with the best so far [s]")
      ->capture_default_str();
  app.add_option("--jobs", options.jobs, "Number of parallel trials")->capture_default_str();
  app.add_flag("--list", options.list, "List the trials without running them");
  app.add_option("--only", options.only, "Of these trials the one with this id, as --list has it");
  app.parse(argc, argv);
  return options;
}

/// A folder that is removed with the object, unless it is to be kept.
class CaseFolder {
 public:
  explicit CaseFolder(const std::string& keep) : kept_(!keep.empty()) {
    if (kept_) {
      path_ = keep;
      fs::create_directories(path_);
      return;
    }
    std::string name = (fs::temp_directory_path() / "trials-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  CaseFolder(const CaseFolder&) = delete;
  CaseFolder& operator=(const CaseFolder&) = delete;
  ~CaseFolder() {
    std::error_code ignored;
    if (!kept_) fs::remove_all(path_, ignored);
  }
  const fs::path& path() const { return path_; }

 private:
  bool kept_;
  fs::path path_;
};

TrialResult make_trial(const TrialKey& key, const TrialOptions& options) {
  const CaseFolder folder(options.keep);
  const fs::path case_folder = folder.path() / "cases" / key.folder_name();
  const Truth truth = write_case(key, case_folder);
  const Answer answer = ask(options.program, case_folder,
                            folder.path() / "answers" / key.folder_name(), options.time_limit_s);
  TrialResult result = score(truth, answer);
  result.version = options.version;
  if (!options.keep.empty()) {
    result.folder = case_folder.string();
    fs::create_directories(folder.path() / "truth");
    measured::write_atomically(folder.path() / "truth" / (key.folder_name() + ".json"),
                               truth_json(truth).dump(1) + "\n");
  }
  return result;
}

/// Returns how many could not be made.
int make_trials(const std::vector<TrialKey>& keys, const TrialOptions& options,
                std::vector<TrialResult>& results) {
  std::atomic<std::size_t> next = 0;
  std::size_t made = 0;
  std::mutex told;
  int failed = 0;
  const bool tell = ::isatty(STDERR_FILENO) != 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < keys.size(); i = next++) {
      try {
        const TrialResult result = make_trial(keys[i], options);
        const std::scoped_lock lock(told);
        results.push_back(result);
        append_result(result, options.results);
        if (tell) {
          fmt::print(stderr, "{}/{} {}: {}\n", ++made, keys.size(), result.id,
                     to_string(result.outcome));
        }
      } catch (const std::exception& error) {
        const std::scoped_lock lock(told);
        fmt::print(stderr, "{}: could not be made: {}\n", keys[i].id(), error.what());
        ++failed;
      }
    }
  };
  std::vector<std::jthread> workers;
  for (int job = 1; job < options.jobs; ++job) workers.emplace_back(work);
  work();
  workers.clear();
  return failed;
}

int run(const TrialOptions& options) {
  std::vector<TrialKey> keys = list_trials(options.choice);
  if (!options.only.empty()) {
    std::erase_if(keys, [&](const TrialKey& key) { return key.id() != options.only; });
    if (keys.empty()) throw arm::InputError("--only " + options.only + ": is none of these trials");
  }
  if (options.list) {
    for (const auto& key : keys) fmt::print("{} {}\n", key.id(), key.folder_name());
    return 0;
  }
  std::vector<TrialResult> results = read_results(options.results);
  require_one_version(results, options.version);
  std::erase_if(keys, [&](const TrialKey& key) {
    return std::ranges::find(results, key.id(), &TrialResult::id) != results.end();
  });
  const int failed = make_trials(keys, options, results);
  const std::string card = scorecard(results);
  fmt::print("{}", card);
  if (!options.scorecard.empty()) measured::write_atomically(options.scorecard, card);
  return failed == 0 ? 0 : 1;
}

}  // namespace

}  // namespace flexarm::trials

int main(int argc, char** argv) {
  CLI::App app("Blind trials of flexarm diagnose");
  try {
    return flexarm::trials::run(flexarm::trials::parse_options(app, argc, argv));
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  } catch (const flexarm::arm::InputError& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
