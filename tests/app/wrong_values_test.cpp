#include "tests/app/flexarm_fixture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace flexarm::testing_app {
namespace {

using testing::HasSubstr;
using testing::StartsWith;
using Words = std::vector<std::string>;

/// What a command needs besides the option that is tried.
struct Command {
  Words words;
  Words rest;
};

/// Every command with an option that takes a value.
std::vector<Command> commands() {
  return {{{"compare"}, {"--quick"}},
          {{"modes"}, {}},
          {{"response"}, {}},
          {{"simulate"}, {}},
          {{"sweep"}, {}},
          {{"export"}, {"rig.toml"}},
          {{"import"}, {"log.csv"}},
          {{"identify"}, {"none/measurement.toml"}},
          {{"diagnose"}, {"none/measurement.toml"}},
          {{"plan"}, {"rig.toml", "plan.toml"}},
          {{"effects"}, {}},
          {{"paper"}, {}},
          {{"new"}, {"new.toml"}},
          {{"doctor"}, {}}};
}

struct Option {
  std::string name;
  std::string value;  ///< NAME, N, NUMBER, TEXT, FILE or FOLDER
};

/// The options with a value that the help lists.
std::vector<Option> options_of(const std::string& help) {
  static const std::regex kOption(R"((?:^|\n)  (?:-\w, ?)?(--[\w-]+) ([A-Z]+)(?:,\.\.\.)?[ \n])");
  std::vector<Option> options;
  for (auto at = std::sregex_iterator(help.begin(), help.end(), kOption);
       at != std::sregex_iterator(); ++at) {
    options.push_back({(*at)[1], (*at)[2]});
  }
  return options;
}

class WrongValues : public Flexarm {};

TEST_F(WrongValues, AnEmptyValueAndAWordForANumberAreRefusedByTheNameOfTheOption) {
  std::set<std::pair<std::string, std::string>> tried;  // several commands share most options
  for (const auto& [words, rest] : commands()) {
    const auto options = options_of(run({words.front(), "--help"}).output);
    EXPECT_FALSE(options.empty()) << words.front();
    for (const Option& option : options) {
      const bool is_number = option.value == "N" || option.value == "NUMBER";
      for (const char* value : {"", "wrong"}) {
        if (*value != '\0' && !is_number) continue;
        if (!tried.insert({option.name, value}).second) continue;
        Words call = words;
        call.insert(call.end(), rest.begin(), rest.end());
        call.insert(call.end(), {option.name, value});
        SCOPED_TRACE(testing::PrintToString(call));
        const Ended ended = run(call);
        EXPECT_EQ(ended.status, 2);
        EXPECT_EQ(std::ranges::count(ended.errors, '\n'), 1) << ended.errors;
        EXPECT_THAT(ended.errors, HasSubstr(option.name));
      }
    }
  }
  EXPECT_GT(tried.size(), 90U);
}

/// A command line and how its one line of error begins: file and line or option, key, value, unit.
struct Case {
  Words call;
  std::string line;
};

TEST_F(WrongValues, AreNamedByOptionOrFileWithWhatIsAllowed) {
  run({"new", "rig.toml"});
  write("log.csv", "t,tau,theta\n0,0.1,0\n0.01,0.1,0.2\n0.02,0.1,0.3\n");
  write("soft.toml", text_of("rig.toml") + "\n[effects.root_compliance]\nstiffness = 30\n");
  for (const auto& [folder, duration_s] : {std::pair{"short", "0.1"}, std::pair{"long", "2"}}) {
    ASSERT_EQ(run({"simulate", "--duration", duration_s, "--period", "0.01", "--excitation",
                   "random:rms=0.01,to=20", "--out", folder})
                  .status,
              0);
  }
  const std::vector<Case> cases = {
      // Numbers and words that a library names by its key.
      {{"compare", "--poles", "0"}, "--poles = 0: must be 1 or more"},
      {{"compare", "--zeros", "91"}, "--zeros = 91: must be 90 or less"},
      {{"compare", "--tolerance", "nan"}, "--tolerance = nan: must be a finite number above 0"},
      {{"compare", "--accuracy", "-1"}, "--accuracy = -1: must be a finite number above 0"},
      {{"compare", "--sensor", "strain@-1"},
       "--sensor strain@-1: position must be from 0 to the beam's length, 0.96 m"},
      {{"modes", "--sensor", "tip"}, "--sensor tip: unknown"},
      {{"modes", "--formulation", "fem", "--elements", "0"}, "--elements = 0: must be 1 to 100000"},
      {{"modes", "--formulation", "fem", "--degree", "26"}, "--degree = 26: must be 3 to 25"},
      {{"modes", "--formulation", "assumed_modes", "--functions", "1"},
       "--functions = 1: must be from 2 to 200"},
      {{"modes", "--formulation", "assumed_modes", "--basis", "cubic"},
       "--basis cubic: unknown; allowed: legendre"},
      {{"response", "--from-Hz", "inf"}, "--from-Hz = inf Hz: must be finite and above 0"},
      {{"response", "--from-Hz", "1e300"}, "--from-Hz = 1e+300 Hz: must be below 201.5"},
      {{"simulate", "--payload-mass", "-1"},
       "--payload-mass = -1 kg: must be a finite number, 0 or more"},
      {{"simulate", "--payload-mass", "1e300"}, "--payload-mass: payload.mass/(m l) = 6.3"},
      // Keys within the value of an option.
      {{"simulate", "--excitation", "random:rms=-1"},
       "--excitation random.rms = -1 N m: must be a finite number, 0 or more"},
      {{"simulate", "--excitation", "chirp:from=0"},
       "--excitation chirp.from = 0 Hz: must be a finite number above 0"},
      {{"sweep", "--over", "payload.mass=nan:1:3"},
       "--over payload.mass = nan kg: must be a finite number, 0 or more"},
      {{"sweep", "--over", "payload.mass=0:1:3", "--sensor", "strain@-1"},
       "at payload.mass = 0 kg: --sensor strain@-1: position must be from 0"},
      {{"import", "log.csv", "--run", "a:b=1:2"},
       "--run a:b=1:2: id = a:b: must be letters, digits, - _ and ., because it is a file name"},
      // More roots than a formulation has.
      {{"modes", "--formulation", "fem", "--modes", "356"},
       "--modes: needs 356 roots; must be at most 90 for fem; exact_tf has no limit"},
      {{"response", "--formulation", "fem", "--to-Hz", "1e6"},
       "--to-Hz: about 358 roots lie below the highest frequency; fem has at most 90"},
      {{"export", "--fmu", "rig.toml", "--formulation", "fem", "--modes", "300"},
       "--modes: roots = 300: must be at most 90 for fem; exact_tf has no limit"},
      {{"modes", "soft.toml", "--modes", "5000"},
       "--modes: count = 5000: must be from 1 to 2000 with these effects"},
      // Runs of a measurement.
      {{"identify", "short/measurement.toml"},
       "short/measurement.toml: run random: 10 samples: a spectrum needs at least "},
      {{"identify", "long/measurement.toml", "--resolution", "1e9"},
       "long/measurement.toml: run random: --resolution = 1000000000 Hz: must be from "},
      // What would not fit into memory.
      {{"modes", "--modes", "10000001"}, "--modes = 10000001: "},
      {{"simulate", "--modes", "10000000"}, "--modes = 10000000: needs at least 9.6e+06 GB"},
      {{"export", "--fmu", "rig.toml", "--modes", "100000"}, "--modes = 100000: must be 1 to 2000"},
      // Folders and files of another kind.
      {{"compare", "--measured", "short"}, "short: is a folder; must be a file"},
      {{"modes", "short"}, "short: is a folder; must be a file"},
      {{"modes", "log.csv"}, "log.csv: is a table of numbers, as a log has; must be an arm file"},
      {{"paper", "22", "--update", "short"}, "short: is a folder; must be a file"},
      {{"modes", "--json", "short"}, "short: cannot be written: is a folder"},
  };
  for (const auto& [call, line] : cases) {
    SCOPED_TRACE(testing::PrintToString(call));
    const Ended ended = run(call);
    EXPECT_EQ(ended.status, 2);
    EXPECT_EQ(ended.output, "");
    EXPECT_EQ(std::ranges::count(ended.errors, '\n'), 1) << ended.errors;
    EXPECT_THAT(ended.errors, StartsWith(line));
  }
}

TEST_F(WrongValues, AnErrorOfTheArmFileKeepsItsPlaceBesideAnOption) {
  write("rig.toml", "[payload]\nmass = -1\n");
  EXPECT_THAT(run({"modes", "rig.toml", "--payload-mass", "0.1"}).errors,
              StartsWith("rig.toml:2: payload.mass = -1 kg: must be "));
}

}  // namespace
}  // namespace flexarm::testing_app
