#include "tests/app/flexarm_fixture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>

namespace flexarm::testing_app {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

using Sweep = Flexarm;

TEST_F(Sweep, ThreeFormulationsAgreeAndTheLastLineSaysWhatIsNext) {
  const Ended ended = run({"sweep", "--over", "payload.mass=0:0.3:4"});
  EXPECT_EQ(ended.status, 0) << ended.errors;
  EXPECT_EQ(ended.errors, "");
  EXPECT_THAT(ended.output,
              AllOf(StartsWith("Agree: "), HasSubstr("\naluminium link"), HasSubstr("11.86183")));
  EXPECT_THAT(ended.output,
              testing::EndsWith("\nnext: write curves and all values with  flexarm sweep --over "
                                "payload.mass=0:0.3:4 --out swept\n"));
  EXPECT_TRUE(names_in().empty());
}

TEST_F(Sweep, ItsExampleWorks) {
  run({"new", "rig.toml"});
  const Ended help = run({"sweep", "--help"});
  EXPECT_EQ(run(example_in(help.output)).status, 0);
  EXPECT_THAT(names_in("swept"),
              ElementsAre("agreement.csv", "events.csv", "modes.svg", "poles.svg", "sweep.csv",
                          "zeros-hub_angle.svg", "zeros-tip_acceleration.svg"));
}

TEST_F(Sweep, NoLineIsWiderThanATerminal) {
  constexpr std::size_t kColumns = 100;
  const Ended ended = run({"sweep", "--over", "hub.inertia=log:1e-4:1e-2:3", "--over",
                           "payload.inertia=0:0.002:3", "--sensor", "strain@0.25"});
  EXPECT_EQ(ended.status, 0) << ended.errors;
  std::istringstream lines(ended.output);
  for (std::string line; std::getline(lines, line);) {
    // What is one line, however long: the verdict, and the command to try next.
    const bool whole = line.starts_with("Agree: ") || line.starts_with("next: ");
    EXPECT_TRUE(line.size() <= kColumns || whole) << line;
  }
}

TEST_F(Sweep, ThreadsDoNotChangeAByte) {
  const auto swept = [&](const std::string& threads) {
    EXPECT_EQ(run({"sweep", "--over", "payload.inertia=0:0.002:9", "--threads", threads, "--json",
                   "out.json", "--out", "out", "--force"})
                  .status,
              0);
    return text_of("out.json") + text_of("out/sweep.csv") + text_of("out/poles.svg");
  };
  const std::string one = swept("1");
  EXPECT_EQ(swept("3"), one);
}

TEST_F(Sweep, DisagreementIsStatusOne) {
  const Ended ended = run({"sweep", "--over", "payload.mass=0:0.3:3", "--tolerance", "1e-18"});
  EXPECT_EQ(ended.status, 1);
  EXPECT_THAT(ended.output, StartsWith("DISAGREE: "));
}

TEST_F(Sweep, FiguresOfThePaperAreSvgAndCsv) {
  for (const std::string number : {"18", "19"}) {
    const std::string folder = "figure-" + number;
    EXPECT_EQ(run({"sweep", "--figure", number, "--out", folder}).status, 0);
    EXPECT_THAT(names_in(folder), Contains("figure-" + number + ".svg"));
    EXPECT_THAT(text_of(folder + "/figure-" + number + ".csv"),
                StartsWith("payload.mass [kg],model,feature,sensor,number,"));
  }
  expect_refused(run({"sweep", "--figure", "17"}),
                 "--figure = 17: must be 18 (poles) or 19 (zeros)");
  expect_refused(run({"sweep", "--figure", "18", "--over", "payload.mass=0.0,1"}),
                 "--over: --figure has its own");
}

TEST_F(Sweep, BadInputIsOneLineAndStatusTwoBeforeAnyWork) {
  expect_refused(run({"sweep"}),
                 "--over: give one or two parameters, e.g. --over payload.mass=0:0.5:200");
  EXPECT_THAT(run({"sweep", "--over", "payload.mas=0:1:3", "--out", "out"}).errors,
              HasSubstr("(did you mean payload.mass?)"));
  expect_refused(run({"sweep", "--over", "payload.mass=-1:1:3", "--out", "out"}),
                 "--over payload.mass = -1 kg: must be a finite number, 0 or more");
  expect_refused(run({"sweep", "--over", "payload.mass=0.0,1", "--formulation", "fme"}),
                 "--formulation fme: unknown (did you mean fem?); allowed: exact_tf, fem, "
                 "assumed_modes");
  expect_refused(run({"sweep", "--over", "payload.mass=0.0,1", "--threads", "-1"}),
                 "--threads = -1: must be from 1 to 1024, or 0 for one per core");
  expect_refused(run({"sweep", "--over", "payload.mass=0.0,1", "--resume"}),
                 "--resume: give the --out or --json of the interrupted sweep");
  expect_refused(run({"sweep", "--over", "payload.mass=0.0,1", "--resume", "--json", "out.json"}),
                 "out.json.checkpoint: no checkpoint found; start without "
                 "--resume");
  EXPECT_TRUE(names_in().empty());
}

TEST_F(Sweep, CtrlCLeavesACheckpointFromWhichResumeMakesTheSameBytes) {
  // Two seconds or so on one thread, far more than it takes to interrupt it.
  const std::string grid = "payload.mass=0:0.5:5000";
  const auto words = [&](const std::string& name) {
    return std::vector<std::string>{
        "sweep", "--over",   grid,        "--json",       (folder_ / name).string(), "--threads",
        "1",     "--sensor", "hub_angle", "--roots-only", "--formulation",           "fem"};
  };
  const Ended ended = interrupt_flexarm(words("out.json"), SIGINT);
  ASSERT_EQ(ended.status, 130) << "it ended before it was interrupted: " << ended.errors;
  EXPECT_THAT(ended.errors, AllOf(StartsWith("flexarm: interrupted after "),
                                  HasSubstr("continue with the same command and --resume from ")));
  EXPECT_THAT(names_in(), ElementsAre("out.json.checkpoint"));

  expect_refused(run({"sweep", "--over", "payload.mass=0.0,1", "--resume", "--json", "out.json"}),
                 "out.json.checkpoint: checkpoint of another sweep: grid is \"" + grid +
                     "\", not \"payload.mass=0.0,1\"");
  auto resumed = words("out.json");
  resumed.emplace_back("--resume");
  const Ended finished = run(resumed);
  EXPECT_EQ(finished.status, 0) << finished.errors;
  EXPECT_THAT(finished.output, HasSubstr(" of 5000 points from "));
  EXPECT_THAT(names_in(), ElementsAre("out.json"));

  EXPECT_EQ(run(words("whole.json")).status, 0);
  EXPECT_EQ(text_of("out.json"), text_of("whole.json"));
}

TEST_F(Sweep, WithoutAnOutputAnInterruptionSaysThatNothingIsKept) {
  const Ended ended =
      interrupt_flexarm({"sweep", "--over", "payload.inertia=0:0.002:5000"}, SIGTERM);
  EXPECT_EQ(ended.status, 128 + SIGTERM);
  EXPECT_THAT(ended.errors, HasSubstr("no checkpoint without --out or --json"));
}

TEST_F(Sweep, AnOptionForWhatIsSweptOverIsRefused) {
  expect_refused(run({"sweep", "--over", "payload.mass=0:1:3", "--payload-mass", "0.3"}),
                 "--payload-mass: payload.mass is a sweep parameter");
  expect_refused(run({"sweep", "--over", "eta=0:1:3", "--payload-mass", "0.3"}),
                 "--payload-mass: payload_mass_ratio is a sweep parameter");
  expect_refused(run({"sweep", "--over", "payload.inertia=0:1:3", "--payload-inertia", "0.3"}),
                 "--payload-inertia: payload.inertia is a sweep parameter");
  expect_refused(run({"sweep", "--over", "hub.inertia=1:2:3", "--hub-inertia", "0.3"}),
                 "--hub-inertia: hub.inertia is a sweep parameter");
  expect_refused(run({"sweep", "--figure", "18", "--payload-mass", "0.3"}),
                 "--payload-mass: payload.mass is a sweep parameter");
}

TEST_F(Sweep, EffectsOutsideTheLinearArmAreLeftOutAndNamed) {
  write("rig.toml",
        "[beam]\nlength = 0.8\nwidth = 0.02\nthickness = 0.003\ndensity = 2700.0\n"
        "youngs_modulus = 7e10\n[hub]\ninertia = 1e-3\n"
        "[effects.coulomb_friction]\ntorque = 0.01\n");
  const Ended ended = run({"sweep", "rig.toml", "--over", "payload.mass=0,0.1"});
  EXPECT_EQ(ended.status, 0) << ended.errors;
  EXPECT_THAT(ended.output, HasSubstr("coulomb_friction"));
}

}  // namespace
}  // namespace flexarm::testing_app
