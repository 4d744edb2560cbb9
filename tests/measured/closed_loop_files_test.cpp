// Runs of a closed loop: the keys of a measurement, the column of a record, and what is refused.
#include "measured/files/controller_keys.hpp"
#include "measured/files/measurement.hpp"
#include "measured/files/run_data.hpp"
#include "measured/files/text_file.hpp"
#include "tests/measured/mistake.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

namespace flexarm::measured {
namespace {

using arm::Controller;
using arm::PidController;
using arm::StateSpaceController;
using testing::ElementsAre;

const std::string kLoopHead =
    "arm = \"arm.toml\"\n[[run]]\nid = \"a\"\nkind = \"time\"\nfile = \"a.csv\"\n";
const std::string kPid =
    "controller = { sensor = \"hub_angle\", kp = 2, kd = 0.1, ki = 0.5, "
    "derivative = \"measurement\", limit = 0.4, sample_time = 0.004 }\n";
const std::string kReferenceLine = "reference = \"reference\"\n";

Controller hub_pid() {
  return {.sensors = {{arm::SensorKind::hub_angle}},
          .law = PidController{.kp = 2.0,
                               .kd = 0.1,
                               .ki = 0.5,
                               .derivative = PidController::Derivative::measurement},
          .limit_N_m = 0.4,
          .sample_time_s = 0.004};
}

/// Reads the tip and the hub, with one state.
Controller two_sensors() {
  return {.sensors = {{arm::SensorKind::hub_angle}, {arm::SensorKind::strain, 0.05}},
          .law = StateSpaceController{
              .a = {{0.9}}, .b = {{0.0, 0.1, -2.0}}, .c = {{1.0}}, .d = {{1.5, -1.5, 0.0}}}};
}

TEST(ClosedLoopFiles, EveryKeyOfAPidReachesItsMember) {
  const auto run = parse_measurement(kLoopHead + kReferenceLine + kPid, "m.toml").runs[0];
  EXPECT_EQ(run.controller, hub_pid());
  EXPECT_EQ(run.reference, (ColumnMapping{"reference", "", 1.0}));
  EXPECT_TRUE(run.torque_hold_is_known);  // held between the controller's samples
  EXPECT_EQ(run.torque_hold, TorqueHold::zero);
}

TEST(ClosedLoopFiles, TheHubAngleIsReadUnlessSaid) {
  const auto run =
      parse_measurement(kLoopHead + kReferenceLine + "controller = { kp = 1 }\n", "m.toml").runs[0];
  EXPECT_EQ(run.controller, (Controller{.sensors = {{arm::SensorKind::hub_angle}},
                                        .law = PidController{.kp = 1.0}}));
}

TEST(ClosedLoopFiles, AStateSpaceReachesItsMatrices) {
  const auto run = parse_measurement(
                       kLoopHead + kReferenceLine +
                           "controller = { sensor = [\"hub_angle\", \"strain@0.05\"], A = [[0.9]], "
                           "B = [[0, 0.1, -2]], C = [[1]], D = [[1.5, -1.5, 0]] }\n",
                       "m.toml")
                       .runs[0];
  EXPECT_EQ(run.controller, two_sensors());
}

TEST(ClosedLoopFiles, WhatIsWrittenReadsBackEqual) {
  for (const Controller& controller : {hub_pid(), two_sensors()}) {
    Measurement measurement{"bench", "arm.toml", {}};
    measured::Run run{.id = "a", .file = "a.csv"};
    run.controller = controller;
    run.reference = ColumnMapping{"reference", "", 1.0};
    measurement.runs.push_back(run);
    run.id = "log";
    run.columns = {{"time", {"t", "s", 1.0}}, {"torque", {"u", "", 1.0}}};
    run.reference = ColumnMapping{"Cmd", "deg", 2.0};
    measurement.runs.push_back(run);
    EXPECT_EQ(parse_measurement(format_measurement(measurement), "m.toml"), measurement);
  }
}

TEST(ClosedLoopFiles, AReferenceOfALogHasUnitAndScaleOfItsSensor) {
  const std::string columns =
      "columns = { time = { name = \"t\" }, torque = { name = \"u\" }, hub_angle = { name = "
      "\"enc\", unit = \"deg\", scale = -2.0 } }\n";
  const auto of_sensor =
      parse_measurement(kLoopHead + columns + "reference = \"Cmd\"\n" + kPid, "m.toml").runs[0];
  EXPECT_EQ(of_sensor.reference, (ColumnMapping{"Cmd", "deg", -2.0}));
  const auto own =
      parse_measurement(
          kLoopHead + columns + "reference = { name = \"Cmd\", unit = \"rad\" }\n" + kPid, "m.toml")
          .runs[0];
  EXPECT_EQ(own.reference, (ColumnMapping{"Cmd", "rad", 1.0}));
}

TEST(ClosedLoopFiles, KeysOnOneLineAreTheSameController) {
  EXPECT_EQ(parse_controller_keys("kp=2,kd=0.1,ki=0.5,derivative=measurement,limit=0.4,"
                                  "sample_time=0.004,sensor=hub_angle",
                                  "--controller"),
            hub_pid());
  const auto error_of = [](const char* text) -> std::string {
    try {
      parse_controller_keys(text, "--controller");
    } catch (const arm::InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(error_of("kp=2,kp=3"), "--controller: kp: given twice");
  EXPECT_EQ(error_of("kp"),
            "--controller: kp: must be KEY=VALUE, separated by commas, or a TOML file");
  EXPECT_EQ(error_of("kp=a"),
            "--controller: kp = \"a\": a string; must be a finite number [N m/(rad)]");
  EXPECT_EQ(error_of("kp=0"),
            "--controller: kp = 0, kd = 0, ki = 0: does not close the loop; one of the gains must "
            "not be 0");
}

const std::vector<Mistake> kMistakes = {
    {"ControllerWithoutReference", kPid,
     "6: run.controller: needs the column with its reference, as in reference = \"reference\""},
    {"ReferenceWithoutController", kReferenceLine,
     "6: run.reference = \"reference\": needs a controller, as in controller = { sensor = "
     "\"hub_angle\", kp = 2.5, kd = 0.1 }"},
    {"NoColumnOfATimeRecord", "reference = \"cmd\"\n" + kPid,
     "6: run.reference = \"cmd\": not a column of a time record; must be \"reference\", which is "
     "reference [UNIT] in its header"},
    {"NoGain", kReferenceLine + "controller = { kp = 0.0, limit = 1.0 }\n",
     "7: run.controller.kp = 0, kd = 0, ki = 0: does not close the loop; one of the gains must not "
     "be 0"},
    {"NoLaw", kReferenceLine + "controller = { limit = 1.0 }\n",
     "7: run.controller.kp: missing; needs one or more of the gains kp, kd, ki, or the matrices A, "
     "B, C, D"},
    {"GainsAndMatrices", kReferenceLine + "controller = { kp = 1.0, D = [[1.0, -1.0]] }\n",
     "7: run.controller.D: not together with kp; allowed: kp, kd, ki, derivative, or A, B, C, D"},
    {"LimitNegative", kReferenceLine + "controller = { kp = 1.0, limit = -1.0 }\n",
     "7: run.controller.limit = -1 N m: must be a finite number above 0"},
    {"UnknownKey", kReferenceLine + "controller = { kp = 1.0, kdd = 1.0 }\n",
     "7: run.controller.kdd: unknown key (did you mean kd?); allowed: sensor, kp, kd, ki, "
     "derivative, A, B, C, D, limit, sample_time"},
    {"UnknownSensor", kReferenceLine + "controller = { kp = 1.0, sensor = \"hub_angel\" }\n",
     "7: run.controller.sensor: sensor hub_angel: unknown (did you mean hub_angle?); allowed: "
     "hub_angle, hub_velocity, tip_acceleration, tip_displacement, tip_deflection, strain@X (X in "
     "metres from the hub)"},
    {"TwoSensorsOfAPid",
     kReferenceLine + "controller = { kp = 1.0, sensor = [\"hub_angle\", \"hub_velocity\"] }\n",
     "7: run.controller.sensor: 2 sensors; a controller with kp, kd, ki has one"},
    {"DerivativeOfNeither", kReferenceLine + "controller = { kp = 1.0, derivative = \"errors\" }\n",
     "7: run.controller.derivative = \"errors\": must be error or measurement (did you mean "
     "error?)"},
    {"MatricesThatDoNotFit",
     kReferenceLine + "controller = { A = [[0.5]], B = [[1.0]], C = [[1.0]], D = [[1.0, -1.0]] }\n",
     "7: run.controller.B: must be 1 x 2: a column for the reference and one for each sensor"},
    {"NoMatrix", kReferenceLine + "controller = { D = [1.0, -1.0] }\n",
     "7: run.controller.D: an array; must be a list of rows of numbers, as in [[0.9, 0.0], [0.1, "
     "1.0]]"},
    {"MatricesThatDoNotClose",
     kReferenceLine + "controller = { A = [[0.5]], B = [[1.0, 0.0]], C = [[1.0]], D = [[1.0, 0.0]] "
                      "}\n",
     "7: run.controller.D: does not close the loop; the torque must depend on a sensor by D, or by "
     "B, A and C"},
    {"FirstOrderHold", kReferenceLine + kPid + "torque_hold = \"first\"\n",
     "8: run.torque_hold = \"first\": must be \"zero\" where a controller made the torque, which "
     "it "
     "holds between its samples"},
    {"NoTable", kReferenceLine + "controller = 3\n",
     "7: run.controller = 3: a number; must be a table, as in { sensor = \"hub_angle\", kp = 2.5, "
     "kd = 0.1 }"},
};

class ClosedLoopMistake : public testing::TestWithParam<Mistake> {};

TEST_P(ClosedLoopMistake, IsSaidWithItsLine) {
  expect_line(GetParam(), "m.toml", [](const std::string& text, const std::string& file) {
    parse_measurement(kLoopHead + text, file);
  });
}

INSTANTIATE_TEST_SUITE_P(, ClosedLoopMistake, testing::ValuesIn(kMistakes), name_of_mistake);

TEST(ClosedLoopFiles, OnlyTimeRunsHaveALoop) {
  const Mistake mistake{"", "", "6: run.controller: only for time runs"};
  expect_line(mistake, "m.toml", [](const std::string& /*text*/, const std::string& file) {
    parse_measurement("arm = \"a\"\n[[run]]\nid = \"a\"\nkind = \"frf\"\nfile = \"a.csv\"\n" + kPid,
                      file);
  });
}

/// A measurement's folder of its own, removed afterwards.
class LoopFolder : public testing::Test {
 protected:
  LoopFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "flexarm-test-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
  }
  ~LoopFolder() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  TimeRecord read(const std::string& measurement) const {
    write("m.toml", measurement);
    const Measurement made = read_measurement(folder_ / "m.toml");
    return std::get<TimeRecord>(read_run(folder_ / "m.toml", made.runs[0]));
  }
  std::string refusal(const std::string& measurement) const {
    try {
      read(measurement);
    } catch (const arm::InputError& error) {
      std::string what = error.what();
      for (auto at = what.find(folder_.string()); at != std::string::npos;
           at = what.find(folder_.string())) {
        what.erase(at, folder_.string().size() + 1);
      }
      return what;
    }
    return "accepted";
  }

  std::filesystem::path folder_;
};

TEST_F(LoopFolder, ARecordHasItsReferenceInItsUnit) {
  write("a.csv",
        "time [s],torque [N m],reference [deg],hub_angle [rad]\n0,1,90,0\n0.002,2,180,0.1\n");
  const TimeRecord record = read(kLoopHead + kReferenceLine + kPid);
  EXPECT_EQ(record.reference.unit, "rad");
  EXPECT_THAT(record.reference.values, ElementsAre(std::numbers::pi / 2, std::numbers::pi));
  ASSERT_EQ(record.channels.size(), 1U);
  EXPECT_EQ(parse_time_record(format_time_record(record), "a.csv"), record);
}

TEST_F(LoopFolder, ALogHasItsReferenceByItsColumn) {
  write("a.csv", "t;u;enc;Cmd\n0;1;0;90\n2;-2;-90;180\n");
  const std::string columns =
      "columns = { time = { name = \"t\", unit = \"ms\" }, torque = { name = \"u\" }, hub_angle = "
      "{ "
      "name = \"enc\", unit = \"deg\", scale = 2.0 } }\n";
  const TimeRecord record = read(kLoopHead + columns + "reference = \"Cmd\"\n" + kPid);
  EXPECT_THAT(record.reference.values, ElementsAre(std::numbers::pi, 2 * std::numbers::pi));
  EXPECT_EQ(record.reference.unit, "rad");
  ASSERT_EQ(record.channels.size(), 1U);
  EXPECT_THAT(record.channels[0].values, ElementsAre(0.0, -std::numbers::pi));
  EXPECT_EQ(
      refusal(kLoopHead + columns + "reference = \"cmd\"\n" + kPid),
      "m.toml:7: run.reference = \"cmd\": column cmd: not in the file (did you mean Cmd?); it "
      "has t, u, enc, Cmd");
}

TEST_F(LoopFolder, AReferenceOfALogMayBeComputed) {
  write("a.csv", "t;u;enc;Cmd\n0;1;0;90\n0.002;-2;-90;180\n");
  const std::string columns =
      "columns = { time = { name = \"t\" }, torque = { name = \"u\" }, hub_angle = { expression = "
      "\"2*enc\", unit = \"deg\" } }\n";
  const TimeRecord computed = read(
      kLoopHead + columns + "reference = { expression = \"Cmd + enc\", unit = \"deg\" }\n" + kPid);
  EXPECT_THAT(computed.reference.values, ElementsAre(std::numbers::pi / 2, std::numbers::pi / 2));
  // The column in the unit of the sensor, not what the sensor is computed from.
  const TimeRecord named = read(kLoopHead + columns + "reference = \"Cmd\"\n" + kPid);
  EXPECT_THAT(named.reference.values, ElementsAre(std::numbers::pi / 2, std::numbers::pi));
  EXPECT_EQ(refusal(kLoopHead + columns + "reference = { expression = \"2*cmd\" }\n" + kPid),
            "m.toml:7: run.reference.expression = 2*cmd: column cmd: not in the file (did you mean "
            "Cmd?); it has t, u, enc, Cmd");
}

TEST_F(LoopFolder, WhatTheRecordDoesNotFitIsSaidWithTheLineOfTheKey) {
  write("a.csv", "time [s],torque [N m],hub_angle [rad]\n0,1,0\n0.002,2,0.1\n");
  EXPECT_EQ(refusal(kLoopHead + kReferenceLine + kPid),
            "m.toml:6: run.reference = \"reference\": no column reference [UNIT] in a.csv");
  write("a.csv", "time [s],torque [N m],reference [mm]\n0,1,0\n0.002,2,0.1\n");
  EXPECT_EQ(refusal(kLoopHead + kReferenceLine + kPid),
            "m.toml:6: run.reference = \"reference\": in m in a.csv; must be in rad, the unit of "
            "hub_angle");
  write("a.csv", "time [s],torque [N m],reference [rad]\n0,1,0\n0.003,2,0.1\n");
  EXPECT_EQ(
      refusal(kLoopHead + kReferenceLine + kPid),
      "m.toml:7: run.controller.sample_time = 0.004 s: must be a whole multiple of the period "
      "of the record, 0.003 s (a.csv)");
  write("a.csv", "time [s],torque [N m],reference [N m]\n0,1,0\n0.003,2,0.1\n");
  EXPECT_EQ(refusal(kLoopHead + kReferenceLine + kPid),
            "a.csv:1: column reference: unit N m unknown; allowed: rad, deg, rad/s, deg/s, m, mm, "
            "m/s^2, g, 1, ustrain");
}

TEST_F(LoopFolder, AFileOfAReferenceNeedsNoTorque) {
  write("r.csv", "time [s],reference [deg]\n0,90\n1,180\n");
  const TimeRecord record = read_reference(folder_ / "r.csv");
  EXPECT_THAT(record.reference.values, ElementsAre(std::numbers::pi / 2, std::numbers::pi));
  EXPECT_THAT(record.torque_N_m, ElementsAre(0.0, 0.0));
  write("r.csv", "time [s],torque [N m]\n0,90\n1,180\n");
  EXPECT_THROW(read_reference(folder_ / "r.csv"), arm::InputError);
}

TEST_F(LoopFolder, AControllerHasAFileOfItsOwn) {
  write("c.toml",
        "sensor = \"hub_angle\"\nkp = 2\nkd = 0.1\nki = 0.5\nderivative = \"measurement\"\n"
        "limit = 0.4\nsample_time = 0.004\n");
  EXPECT_EQ(read_controller_file(folder_ / "c.toml"), hub_pid());
  write("c.toml", "kp = 2\nlimit = 0\n");
  try {
    read_controller_file(folder_ / "c.toml");
    ADD_FAILURE() << "accepted";
  } catch (const arm::InputError& error) {
    EXPECT_EQ(error.what(),
              (folder_ / "c.toml").string() + ":2: limit = 0 N m: must be a finite number above 0");
  }
}

}  // namespace
}  // namespace flexarm::measured
