#include "effects/registry/vocabulary.hpp"
#include "measured/files/arm_file.hpp"
#include "measured/files/text_file.hpp"
#include "tests/app/flexarm_fixture.hpp"
#include "tests/app/process.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <sys/stat.h>

namespace flexarm::testing_app {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;

TEST_F(Flexarm, AloneItPrintsItsHelp) {
  const Ended alone = run({});
  EXPECT_EQ(alone.status, 0);
  EXPECT_EQ(alone.errors, "");
  EXPECT_THAT(alone.output, HasSubstr("Typical session:"));
  EXPECT_EQ(run({"--help"}).output, alone.output);
}

TEST_F(Flexarm, HelpOfACommandHasAnExample) {
  const Ended help = run({"new", "--help"});
  EXPECT_EQ(help.status, 0);
  EXPECT_THAT(help.output, HasSubstr("Usage: flexarm new"));
  EXPECT_THAT(help.output, HasSubstr("Example:\n  flexarm new rig.toml\n"));
}

TEST_F(Flexarm, VersionNamesBuildAndLibraries) {
  const Ended version = run({"--version"});
  EXPECT_EQ(version.status, 0);
  EXPECT_THAT(version.output, StartsWith("flexarm " FLEXARM_VERSION "\n"));
  EXPECT_THAT(version.output, HasSubstr("\nbuild: "));
  EXPECT_THAT(version.output, HasSubstr("\nnumerics: Eigen "));
}

TEST_F(Flexarm, AMistypedCommandLineGetsOneLineAndStatusTwo) {
  expect_refused(run({"nwe", "rig.toml"}),
                 "flexarm: nwe: unknown command (did you mean new?); see flexarm --help");
  expect_refused(run({"--vresion"}),
                 "flexarm: --vresion: unknown option (did you mean --version?); "
                 "see flexarm --help");
  expect_refused(run({"new", "--fouce", "rig.toml"}),
                 "flexarm: --fouce: unknown option (did you mean --force?); "
                 "see flexarm new --help");
  expect_refused(run({"new", "--forse=1", "rig.toml"}),
                 "flexarm: --forse: unknown option (did you mean --force?); "
                 "see flexarm new --help");
  expect_refused(run({"new"}), "flexarm: FILE is required; see flexarm new --help");
  expect_refused(run({"new", "rig.toml", "two.toml"}),
                 "flexarm: two.toml: unknown argument; see flexarm new --help");
  expect_refused(run({"-x"}), "flexarm: -x: unknown option; see flexarm --help");
  expect_refused(run({"a\nb"}), "flexarm: a\\x0ab: unknown command; see flexarm --help");
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(Flexarm, NewWritesAnArmOfTheUsersNameAndSaysWhatIsNext) {
  const Ended ended = run({"new", "rig.toml"});
  EXPECT_EQ(ended.status, 0);
  EXPECT_EQ(ended.errors, "");
  EXPECT_THAT(ended.output, HasSubstr("flexarm modes rig.toml\n"));
  arm::Arm expected = arm::paper_arm();
  expected.name = "rig";
  expected.beam.given_flexural_rigidity_N_m2.reset();
  EXPECT_EQ(measured::read_arm_file(folder_ / "rig.toml", effects::vocabulary()), expected);
}

TEST_F(Flexarm, TheStarterFileStaysValidWithEveryOptionalKeyGiven) {
  run({"new", "rig.toml"});
  std::istringstream lines(text_of("rig.toml"));
  std::string all;
  for (std::string line; std::getline(lines, line);) {
    const bool is_key = line.starts_with("# [") ||
                        (line.find(" = ") != std::string::npos && !line.starts_with("#  "));
    all += (line.starts_with("# ") && is_key ? line.substr(2) : line) + "\n";
  }
  const arm::Arm arm = measured::parse_arm(all, "rig.toml", effects::vocabulary());
  EXPECT_TRUE(arm.beam.given_linear_density_kg_per_m.has_value());
  EXPECT_GT(arm.damping.kelvin_voigt_s, 0.0);
  EXPECT_TRUE(arm.effects.contains("coulomb_friction"));
}

TEST_F(Flexarm, TheStarterFileIsShortAndLeavesTheEffectsToTheirCommand) {
  run({"new", "rig.toml"});
  const std::string starter = text_of("rig.toml");
  EXPECT_LT(std::ranges::count(starter, '\n'), 40);
  EXPECT_THAT(starter, HasSubstr("\n# flexarm effects lists them, "));
  EXPECT_EQ(run({"effects", "coulomb_friction"}).status, 0);
}

TEST_F(Flexarm, NewNamesTheArmOfAnyFileSoThatItIsRead) {
  for (const std::string file : {"my rig.toml", "rig", "a\"b'c\\d.toml", "\xc3\xa9tude.toml",
                                 "\xff.toml", "two\nlines.toml"}) {
    ASSERT_EQ(run({"new", file}).status, 0) << file;
    EXPECT_NO_THROW(measured::read_arm_file(folder_ / file, effects::vocabulary())) << file;
  }
}

TEST_F(Flexarm, NewDoesNotOverwriteUnlessForced) {
  run({"new", "rig.toml"});
  const std::string starter = text_of("rig.toml");
  fs::resize_file(folder_ / "rig.toml", 10);
  expect_refused(run({"new", "rig.toml"}), "rig.toml: already exists; --force overwrites it");
  EXPECT_EQ(text_of("rig.toml"), starter.substr(0, 10));
  EXPECT_EQ(run({"new", "--force", "rig.toml"}).status, 0);
  EXPECT_EQ(text_of("rig.toml"), starter);
}

TEST_F(Flexarm, NewSaysWhyAFileCannotBeWritten) {
  expect_refused(run({"new", "none/rig.toml"}),
                 "none/rig.toml: cannot be written: there is no folder none");
  expect_refused(run({"new", "--force", "."}), ".: cannot be written: is a folder");
  expect_refused(run({"new", ""}), "flexarm: FILE: is empty; see flexarm new --help");
}

TEST_F(Flexarm, AClosedPipeEndsItWithoutAWord) {
  for (const std::string option : {"--help", "--version"}) {
    const Ended ended = run_flexarm({option}, ".", Output::closed_pipe);
    EXPECT_EQ(ended.status, 128 + SIGPIPE);
    EXPECT_EQ(ended.errors, "");
  }
}

TEST_F(Flexarm, AFullDiskUnderStandardOutputIsReported) {
  const Ended ended = run_flexarm({"--help"}, ".", Output::full_disk);
  EXPECT_EQ(ended.status, 2);
  EXPECT_EQ(ended.errors, "flexarm: standard output: No space left on device\n");
}

TEST_F(Flexarm, CtrlCEndsItAsAShellExpects) {
  // Opening a pipe that nobody reads blocks.
  const std::string pipe = (folder_ / "pipe").string();
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const Ended ended = interrupt_flexarm({"new", "--force", pipe}, SIGINT);
  EXPECT_EQ(ended.status, 130);
  EXPECT_EQ(ended.errors, "flexarm: interrupted\n");
}

}  // namespace
}  // namespace flexarm::testing_app
