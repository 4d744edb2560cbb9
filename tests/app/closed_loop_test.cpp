// Closed loops that the program simulates and writes.
#include "measured/files/measurement.hpp"
#include "measured/files/run_data.hpp"
#include "measured/files/time_record.hpp"
#include "tests/app/flexarm_fixture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <variant>

namespace flexarm::testing_app {
namespace {

using testing::HasSubstr;

const std::vector<std::string> kLoop = {"simulate",
                                        "--duration",
                                        "3",
                                        "--period",
                                        "0.002",
                                        "--reference",
                                        "staircase:amplitude=0.3,dwell=0.7,levels=2",
                                        "--controller",
                                        "kp=0.2,kd=0.01,ki=0.05,limit=0.15,sample_time=0.004",
                                        "--out",
                                        "loop"};

class ClosedLoopCommand : public Flexarm {
 protected:
  ClosedLoopCommand() {
    run({"new", "rig.toml"});
    write("rig.toml", text_of("rig.toml") +
                          "\n[effects.coulomb_friction]\ntorque = 0.01\n"
                          "[effects.time_delay]\ndelay = 0.003\n");
  }
  Ended simulate(std::vector<std::string> more) const {
    std::vector<std::string> arguments = kLoop;
    arguments.insert(arguments.begin() + 1, "rig.toml");
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }
  measured::TimeRecord record(const std::string& folder) const {
    const auto file = folder_ / folder / "measurement.toml";
    const auto measurement = measured::read_measurement(file);
    return std::get<measured::TimeRecord>(measured::read_run(file, measurement.runs.at(0)));
  }
};

TEST_F(ClosedLoopCommand, WritesReferenceAndController) {
  const Ended ended = simulate({"--json", "out.json"});
  ASSERT_EQ(ended.status, 0) << ended.errors;
  EXPECT_THAT(ended.output, HasSubstr("reference staircase, amplitude 0.3 rad, dwell 0.7 s"));
  const auto measurement = measured::read_measurement(folder_ / "loop/measurement.toml");
  ASSERT_EQ(measurement.runs.size(), 1U);
  EXPECT_EQ(measurement.runs[0].controller,
            (arm::Controller{.sensors = {{arm::SensorKind::hub_angle}},
                             .law = arm::PidController{.kp = 0.2, .kd = 0.01, .ki = 0.05},
                             .limit_N_m = 0.15,
                             .sample_time_s = 0.004}));
  const auto loop = record("loop");
  EXPECT_EQ(loop.reference.unit, "rad");
  EXPECT_EQ(loop.reference.values[0], 0.3);
  EXPECT_EQ(loop.reference.values[400], 0.6);
  EXPECT_LE(std::ranges::max(loop.torque_N_m), 0.15);
  // It follows the stairs, to a height of 0.6 rad, with overshoot: of the rigid arm the damping
  // ratio is 0.05.
  const double highest = std::ranges::max(loop.channels[0].values);
  EXPECT_GT(highest, 0.4);
  EXPECT_LT(highest, 1.2);
}

TEST_F(ClosedLoopCommand, ItsReferenceFromAFileGivesTheSameRunAgain) {
  ASSERT_EQ(simulate({}).status, 0);
  const Ended ended =
      run({"simulate", "rig.toml", "--reference", "loop/staircase.csv", "--controller",
           "kp=0.2,kd=0.01,ki=0.05,limit=0.15,sample_time=0.004", "--out", "again"});
  ASSERT_EQ(ended.status, 0) << ended.errors;
  EXPECT_EQ(record("again"), record("loop"));
}

TEST_F(ClosedLoopCommand, TheOpenLoopOfItsTorqueReadsTheSame) {
  ASSERT_EQ(simulate({}).status, 0);
  const Ended ended =
      run({"simulate", "rig.toml", "--torque", "loop/staircase.csv", "--out", "open"});
  ASSERT_EQ(ended.status, 0) << ended.errors;
  const auto open = record("open");
  EXPECT_EQ(open.torque_N_m, record("loop").torque_N_m);
  EXPECT_EQ(open.channels, record("loop").channels);
  EXPECT_TRUE(open.reference.values.empty());
}

TEST_F(ClosedLoopCommand, AControllerFromAFileMayBeAStateSpace) {
  write("c.toml", "sensor = [\"hub_angle\", \"hub_velocity\"]\nD = [[0.2, -0.2, -0.06]]\n");
  const Ended ended = run({"simulate", "rig.toml", "--duration", "2", "--reference",
                           "step:amplitude=0.4", "--controller", "c.toml", "--out", "out"});
  ASSERT_EQ(ended.status, 0) << ended.errors;
  const auto angle = record("out").channels[0].values;
  EXPECT_GT(std::ranges::max(angle), 0.3);
  EXPECT_LT(std::ranges::max(angle), 0.8);
}

TEST_F(ClosedLoopCommand, MistakesAreOneLine) {
  const auto errors = [&](const std::string& reference, const std::string& controller,
                          const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"simulate"};
    if (!reference.empty()) arguments.insert(arguments.end(), {"--reference", reference});
    if (!controller.empty()) arguments.insert(arguments.end(), {"--controller", controller});
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ended ended = run(arguments);
    EXPECT_EQ(ended.status, 2);
    EXPECT_EQ(std::ranges::count(ended.errors, '\n'), 1) << ended.errors;
    return ended.errors;
  };
  EXPECT_THAT(errors("step", ""), HasSubstr("--reference: needs --controller"));
  EXPECT_THAT(errors("", "kp=1"), HasSubstr("--controller: needs --reference"));
  EXPECT_THAT(errors("stair", "kp=1"), HasSubstr("--reference stair: excitation stair: unknown"));
  EXPECT_THAT(errors("step", "kp=0"), HasSubstr("--controller: kp = 0, kd = 0, ki = 0: does not "));
  EXPECT_THAT(errors("step", "none.toml"), HasSubstr("none.toml"));
  EXPECT_THAT(errors("step", "kp=1,sample_time=0.0007"),
              HasSubstr("step: sample_time = 0.0007 s: must be a whole multiple of the period"));
  EXPECT_THAT(errors("step", "kp=1,sensor=tip_deflection"),
              HasSubstr("--controller: reads tip_deflection, which is not among --sensor"));
  EXPECT_THAT(errors("step", "kp=1", {"--hold", "first"}),
              HasSubstr("step: torque hold: must be zero-order in a closed loop"));
}

}  // namespace
}  // namespace flexarm::testing_app
