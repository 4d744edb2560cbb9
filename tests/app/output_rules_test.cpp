#include "tests/app/flexarm_fixture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <future>
#include <set>
#include <string>
#include <vector>

namespace flexarm::testing_app {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using Words = std::vector<std::string>;

Words operator+(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

class OutputRules : public Flexarm {
 protected:
  OutputRules() {
    run({"new", "rig.toml"});
    write("log.csv", "t,tau,theta\n0,0.1,0\n0.01,0.1,0.2\n0.02,0.1,0.3\n");
  }
  /// Small calls of every command that writes a folder and needs no measurement.
  std::vector<Words> commands_with_a_folder() const {
    return {{"compare", "rig.toml", "--quick", "--poles", "1", "--zeros", "1"},
            {"modes", "rig.toml", "--modes", "1"},
            {"modes", "rig.toml", "--modes", "1", "--payload-mass", "0,0.1"},
            {"response", "rig.toml", "--modes", "1", "--points", "10"},
            {"sweep", "rig.toml", "--over", "payload.mass=0:0.1:2", "--poles", "1", "--zeros", "1"},
            {"simulate", "rig.toml", "--duration", "1"},
            {"import", "log.csv"},
            {"paper"}};
  }
};

TEST_F(OutputRules, AFolderWithFilesIsReplacedOnlyWithForceAndOnlyIfItIsTheCommands) {
  for (const auto& command : commands_with_a_folder()) {
    SCOPED_TRACE(testing::PrintToString(command));
    fs::remove_all(folder_ / "out");
    const Words call = command + Words{"--out", "out"};
    ASSERT_EQ(run(call).status, 0) << run(call).errors;
    const auto names = names_in("out");
    const Ended again = run(call);
    EXPECT_EQ(again.status, 2);
    EXPECT_THAT(again.errors, AllOf(HasSubstr("out: cannot be written: is a folder with files in "
                                              "it; --force replaces "),
                                    Not(HasSubstr("next"))));
    write("out/old.csv", "of an earlier run");
    EXPECT_EQ(run(call + Words{"--force"}).status, 0);
    EXPECT_EQ(names_in("out"), names);
    write("out/notes.txt", "mine");
    if (command.front() == "paper") continue;  // its own folder has a text
    const Ended theirs = run(call + Words{"--force"});
    EXPECT_EQ(theirs.status, 2);
    EXPECT_THAT(theirs.errors, HasSubstr("out/notes.txt: not part of "));
    EXPECT_EQ(text_of("out/notes.txt"), "mine");
  }
}

TEST_F(OutputRules, ForceNeedsAFolderAndOneOfItsKind) {
  fs::create_directory(folder_ / "other");
  write("other/some.csv", "mine");
  for (const auto& command : commands_with_a_folder()) {
    SCOPED_TRACE(command.front());
    expect_refused(run(command + Words{"--force"}), "--force: needs --out FOLDER");
    const Ended ended = run(command + Words{"--out", "other", "--force"});
    EXPECT_EQ(ended.status, 2);
    EXPECT_THAT(ended.errors,
                AllOf(HasSubstr("other: contains no "), HasSubstr("; not overwritten by --force")));
  }
  EXPECT_EQ(text_of("other/some.csv"), "mine");
}

TEST_F(OutputRules, AnInterruptedSweepIsContinuedOrBegunAnewButNotByTheWay) {
  fs::create_directory(folder_ / "out");
  write("out/sweep.checkpoint", "hours of work");
  const Words call = {"sweep",   "rig.toml", "--over",  "payload.mass=0:0.1:2",
                      "--poles", "1",        "--zeros", "1",
                      "--out",   "out"};
  expect_refused(run(call),
                 "out: has the checkpoint of an interrupted sweep; --resume continues it, "
                 "--force begins anew");
  EXPECT_EQ(text_of("out/sweep.checkpoint"), "hours of work");
  EXPECT_EQ(run(call + Words{"--force"}).status, 0);
  EXPECT_THAT(names_in("out"), Not(testing::Contains("sweep.checkpoint")));
}

TEST_F(OutputRules, OfTwoCommandsThatWriteOneFolderOneWinsWholeAndTheOtherSaysSo) {
  for (const Words& force : {Words{}, Words{"--force"}}) {
    for (const auto& command : commands_with_a_folder()) {
      if (!std::set<std::string>{"modes", "simulate", "sweep"}.contains(command.front())) continue;
      SCOPED_TRACE(testing::PrintToString(command + force));
      fs::remove_all(folder_ / "out");
      const Words call = command + Words{"--out", "out"};
      if (!force.empty()) {
        ASSERT_EQ(run(call).status, 0);
      }
      auto other = std::async(std::launch::async, [&] { return run(call + force); });
      const Ended one = run(call + force);
      const std::vector<Ended> both = {one, other.get()};
      const auto refused = std::ranges::count(both, 2, &Ended::status);
      EXPECT_EQ(std::ranges::count(both, 0, &Ended::status) + refused, 2);
      // A command that begins when the other has ended replaces its folder, where told to.
      EXPECT_TRUE(refused == 1 || (refused == 0 && !force.empty())) << refused;
      for (const Ended& ended : both) {
        if (ended.status == 0) continue;
        EXPECT_THAT(ended.errors,
                    AllOf(HasSubstr("out: "), testing::AnyOf(HasSubstr("another process has"),
                                                             HasSubstr("has the checkpoint"),
                                                             HasSubstr("with files in it"))));
      }
      const auto names = names_in("out");
      EXPECT_EQ(run(command + Words{"--out", "alone"}).status, 0);
      EXPECT_EQ(names, names_in("alone"));
      fs::remove_all(folder_ / "alone");
    }
  }
}

TEST_F(OutputRules, JsonOnStandardOutputStandsAlone) {
  auto calls = commands_with_a_folder();
  calls.push_back({"effects"});
  calls.push_back({"new", "b.toml"});
  for (const auto& command : calls) {
    SCOPED_TRACE(command.front());
    const Ended ended = run(command + Words{"--json", "-"});
    EXPECT_EQ(ended.status, 0) << ended.errors;
    EXPECT_EQ(ended.errors, "");
    const auto document = nlohmann::json::parse(ended.output, nullptr, false);
    ASSERT_FALSE(document.is_discarded()) << ended.output.substr(0, 300);
    EXPECT_THAT(document["schema"].get<std::string>(), HasSubstr("flexarm." + command.front()));
  }
  EXPECT_FALSE(fs::exists(folder_ / "-"));
  EXPECT_EQ(run({"modes", "--json", "./-"}).status, 0);
  EXPECT_TRUE(fs::exists(folder_ / "-"));
}

TEST_F(OutputRules, JsonOnStandardOutputIsTheOneOfAFile) {
  const Words call = {"modes", "rig.toml", "--modes", "2"};
  const std::string piped = run(call + Words{"--json", "-"}).output;
  run(call + Words{"--json", "file.json"});
  EXPECT_EQ(piped, text_of("file.json"));
}

TEST_F(OutputRules, NoOutputTakesThePlaceOfAnInput) {
  write("modal.csv", "sensor,feature,order,frequency [Hz]\nhub_angle,pole,1,12.00\n");
  write("torque.csv", "time [s],torque [N m]\n0,0.1\n0.01,0.1\n0.02,0\n");
  fs::create_symlink("rig.toml", folder_ / "link.toml");
  fs::create_hard_link(folder_ / "rig.toml", folder_ / "hard.toml");
  const std::string arm = text_of("rig.toml");
  struct Case {
    Words call;
    std::string line;
  };
  for (const auto& [call, line] : std::vector<Case>{
           {{"modes", "rig.toml", "--json", "rig.toml"},
            "--json rig.toml: would overwrite the input rig.toml"},
           {{"modes", "rig.toml", "--json", "./rig.toml"},
            "--json ./rig.toml: would overwrite the input rig.toml"},
           {{"modes", "rig.toml", "--json", "link.toml"},
            "--json link.toml: would overwrite the input rig.toml"},
           {{"modes", "link.toml", "--json", "rig.toml"},
            "--json rig.toml: would overwrite the input link.toml"},
           {{"modes", "rig.toml", "--json", "hard.toml"},
            "--json hard.toml: would overwrite the input rig.toml"},
           {{"compare", "--measured", "modal.csv", "--json", "modal.csv"},
            "--json modal.csv: would overwrite the input modal.csv"},
           {{"simulate", "--torque", "torque.csv", "--json", "torque.csv"},
            "--json torque.csv: would overwrite the input torque.csv"},
           {{"import", "log.csv", "--save-as", "log.csv"},
            "--save-as log.csv: would overwrite the input log.csv"},
           {{"response", "rig.toml", "--state-space", "a.json", "--json", "a.json"},
            "--json a.json: same file as --state-space"},
           {{"new", "x.toml", "--json", "x.toml"}, "--json x.toml: same file as FILE"},
           {{"modes", "rig.toml", "--out", "."}, "--out .: has the input rig.toml in it"},
       }) {
    const Ended ended = run(call);
    EXPECT_EQ(ended.status, 2) << line;
    EXPECT_EQ(ended.output, "") << line;
    EXPECT_EQ(ended.errors, line + "\n");
  }
  EXPECT_EQ(text_of("rig.toml"), arm);
  EXPECT_THAT(text_of("torque.csv"), HasSubstr("0.02"));
  EXPECT_FALSE(fs::exists(folder_ / "x.toml"));
}

/// The files that a measurement names are inputs too.
TEST_F(OutputRules, NoOutputTakesThePlaceOfAFileOfAMeasurement) {
  run({"simulate", "rig.toml", "--duration", "1", "--out", "sim"});
  for (const std::string command : {"identify", "diagnose"}) {
    expect_refused(run({command, "sim/measurement.toml", "--json", "sim/arm.toml"}),
                   "--json sim/arm.toml: would overwrite the input sim/arm.toml");
    expect_refused(run({command, "sim/measurement.toml", "--out", "sim", "--force"}),
                   "--out sim: has the input sim/measurement.toml in it");
  }
}

}  // namespace
}  // namespace flexarm::testing_app
