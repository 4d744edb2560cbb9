// Logs of closed loops: the reference and the controller on the command line of an import.
#include "measured/files/measurement.hpp"
#include "measured/files/run_data.hpp"
#include "tests/app/flexarm_fixture.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <numbers>

namespace flexarm::testing_app {
namespace {

using arm::Controller;
using arm::PidController;
using arm::SensorKind;
using measured::InitialState;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

constexpr double kDegree = std::numbers::pi / 180.0;

/// Every 2 ms; in row k the command is k deg, the encoder k counts, the speed k rad/s.
std::string loop_log(int rows, double jitter_periods = 0.0) {
  std::string log = "t_s,i_A,counts,speed_rad_s,cmd_deg\n";
  for (int k = 0; k < rows; ++k) {
    const double off = k % 3 == 1 ? jitter_periods : 0.0;
    log += fmt::format("{:.6f},{},{},{},{}\n", 0.002 * (k + off), 0.1 * k, k, k, k);
  }
  return log;
}

class ImportLoop : public Flexarm {
 protected:
  /// The log with a torque and an angle of 0.5 deg per count.
  Ended import(std::vector<std::string> more) const {
    std::vector<std::string> arguments = {"import",   "log.csv",
                                          "--column", "torque=i_A:A:2",
                                          "--column", "hub_angle=counts:counts:0.5*pi/180"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }
  measured::Run run_in(const std::string& folder, std::size_t at = 0) const {
    return measured::read_measurement(folder_ / folder / "measurement.toml").runs.at(at);
  }
  measured::TimeRecord record_in(const std::string& folder, std::size_t at = 0) const {
    return std::get<measured::TimeRecord>(
        measured::read_run(folder_ / folder / "measurement.toml", run_in(folder, at)));
  }
};

TEST_F(ImportLoop, EveryRunOfTheMeasurementHasReferenceAndController) {
  write("log.csv", loop_log(40));
  const Ended ended =
      import({"--reference", "cmd_deg", "--controller",
              "kp=2.5, kd=0.1, derivative=measurement, limit=0.4", "--run", "a=rows:1:20", "--run",
              "b=rows:21:", "--out", "bench", "--json", "out.json"});
  ASSERT_EQ(ended.status, 0) << ended.errors;
  EXPECT_THAT(ended.output, AllOf(HasSubstr("closed loop: controller { sensor = \"hub_angle\", "),
                                  HasSubstr("reference in rad"), Not(HasSubstr("not used: cmd"))));
  for (const std::size_t at : {0U, 1U}) {
    const measured::Run made = run_in("bench", at);
    EXPECT_EQ(
        made.controller,
        (Controller{.sensors = {{SensorKind::hub_angle}},
                    .law = PidController{.kp = 2.5,
                                         .kd = 0.1,
                                         .derivative = PidController::Derivative::measurement},
                    .limit_N_m = 0.4}));
    EXPECT_EQ(made.torque_hold, measured::TorqueHold::zero);
    const auto record = record_in("bench", at);
    EXPECT_EQ(record.reference.unit, "rad");
    ASSERT_EQ(record.reference.values.size(), 20U);
    EXPECT_NEAR(record.reference.values[3], kDegree * static_cast<double>(20 * at + 3), 1e-15);
  }
  const auto json = nlohmann::json::parse(text_of("out.json"));
  EXPECT_EQ(json["files"][0]["columns"].back()["quantity"], "reference");
  EXPECT_EQ(json["runs"][1]["reference_unit"], "rad");
  EXPECT_THAT(json["runs"][1]["controller"].get<std::string>(), HasSubstr("limit = 0.4"));
}

/// The unit of the file, that of the command line, that of the sensor, and a computed one.
TEST_F(ImportLoop, TheUnitOfTheReferenceIsStatedOrThatOfTheSensor) {
  write("log.csv", loop_log(20));
  const auto fourth = [&](std::vector<std::string> reference) {
    reference.insert(reference.end(), {"--controller", "kp=1", "--out", "bench", "--force"});
    const Ended ended = import(reference);
    EXPECT_EQ(ended.status, 0) << ended.errors;
    return record_in("bench").reference.values.at(4);
  };
  EXPECT_NEAR(fourth({"--reference", "cmd_deg"}), 4.0 * kDegree, 1e-15);
  EXPECT_NEAR(fourth({"--reference", "cmd_deg:rad"}), 4.0, 1e-15);
  EXPECT_NEAR(fourth({"--reference", "#5:deg:2"}), 8.0 * kDegree, 1e-15);
  EXPECT_NEAR(fourth({"--reference", "counts"}), 2.0 * kDegree, 1e-15);
  EXPECT_NEAR(fourth({"--column", "reference=cmd_deg:counts:0.25"}), 1.0, 1e-15);
  EXPECT_NEAR(fourth({"--compute", "reference [deg] = 3*cmd_deg - counts"}), 8.0 * kDegree, 1e-15);
}

TEST_F(ImportLoop, AStateSpaceStandsInAFileAndHasTheUnitOfOneOfItsSensors) {
  write("log.csv", loop_log(20));
  write("law.toml",
        "sensor = [\"hub_velocity\", \"hub_angle\"]\nA = [[0.5]]\nB = [[1, 0, -1]]\n"
        "C = [[0.1]]\nD = [[1, -0.2, -1]]\n");
  const Ended ended =
      import({"--reference", "cmd_deg", "--controller", "law.toml", "--out", "bench"});
  ASSERT_EQ(ended.status, 0) << ended.errors;
  EXPECT_EQ(record_in("bench").reference.unit, "rad");
  const auto controller = run_in("bench").controller;
  ASSERT_TRUE(controller.has_value());
  EXPECT_EQ(std::get<arm::StateSpaceController>(controller->law).d,
            (arm::StateSpaceController::Rows{{1.0, -0.2, -1.0}}));
  // A record of this program has its reference under a header of its own.
  ASSERT_EQ(run({"import", "bench/log.csv", "--reference", "reference", "--controller", "law.toml",
                 "--out", "again"})
                .status,
            0);
  EXPECT_EQ(record_in("again"), record_in("bench"));
}

/// Of a controller with four samples a period the second of a range in the middle is none of its.
TEST_F(ImportLoop, ARangeBeginsWithASampleOfTheController) {
  write("log.csv", loop_log(60));
  const Ended ended = import({"--reference", "cmd_deg", "--controller",
                              "kp=1,ki=2,sample_time=0.008", "--rows", "22:", "--out", "bench"});
  ASSERT_EQ(ended.status, 0) << ended.errors;
  EXPECT_THAT(ended.output,
              AllOf(HasSubstr("3 samples left out in front of the first one of the controller"),
                    HasSubstr("the state of the controller at the first sample is not known")));
  const auto record = record_in("bench");
  EXPECT_NEAR(record.time_s.front(), 0.048, 1e-12);
  EXPECT_NEAR(record.reference.values.front(), 24.0 * kDegree, 1e-15);
  EXPECT_EQ(run_in("bench").initial, InitialState::free);
}

/// A command is held like the torque: its mean over each new step, not a cubic through its steps.
TEST_F(ImportLoop, UnevenTimesResampleTheReferenceAsItIsHeld) {
  std::string log = "t_s,tau_Nm,theta_rad,cmd_rad\n";
  for (int k = 0; k < 60; ++k) {
    const double off = k % 3 == 1 ? 0.2 : 0.0;
    log += fmt::format("{:.6f},{},0.1,{}\n", 0.002 * (k + off), k < 31 ? 0.5 : 2.0,
                       k < 31 ? 0.25 : 1.0);
  }
  write("log.csv", log);
  const Ended ended =
      run({"import", "log.csv", "--column", "torque=tau_Nm", "--column", "hub_angle=theta_rad",
           "--reference", "cmd_rad", "--controller", "kp=2", "--out", "bench"});
  ASSERT_EQ(ended.status, 0) << ended.errors;
  EXPECT_THAT(ended.output, HasSubstr("the reference by"));
  const auto record = record_in("bench");
  ASSERT_EQ(record.reference.values.size(), record.torque_N_m.size());
  for (std::size_t k = 0; k < record.torque_N_m.size(); ++k) {
    EXPECT_NEAR(record.torque_N_m[k], 2.0 * record.reference.values[k], 1e-12) << k;
  }
  EXPECT_THAT(record.reference.values, testing::Contains(testing::Gt(0.9)));
}

TEST_F(ImportLoop, OtherFormatsKeepTheReference) {
  write("log.csv", loop_log(30));
  const std::vector<std::string> loop = {"--reference", "reference", "--controller", "kp=1"};
  ASSERT_EQ(import({"--reference", "cmd_deg", "--controller", "kp=1", "--out", "bench"}).status, 0);
  for (const char* name : {"one.uff", "one.mat", "one.csv"}) {
    std::vector<std::string> save = {"import", "bench/log.csv", "--save-as", name};
    save.insert(save.end(), loop.begin(), loop.end());
    ASSERT_EQ(run(save).status, 0) << name;
    std::vector<std::string> read = {"import", name, "--out", "back", "--force"};
    read.insert(read.end(), loop.begin(), loop.end());
    const Ended ended = run(read);
    ASSERT_EQ(ended.status, 0) << name << ended.errors;
    EXPECT_EQ(record_in("back").reference, record_in("bench").reference) << name;
  }
}

TEST_F(ImportLoop, WhatIsNoLoopIsOneLine) {
  write("log.csv", loop_log(400));
  const auto refused = [&](const std::vector<std::string>& arguments, const std::string& line) {
    expect_refused(import(arguments), line);
  };
  refused({"--controller", "kp=1"},
          "--controller: needs the column with its reference, --reference COLUMN");
  refused({"--reference", "cmd_deg"},
          "--reference cmd_deg: needs --controller, as in --controller kp=2.5,kd=0.1");
  refused({"--compute", "reference=cmd_deg"},
          "--compute reference=cmd_deg: needs --controller, as in --controller kp=2.5,kd=0.1");
  refused({"--reference", "cmd_deg", "--controller", "kp=0"},
          "--controller: kp = 0, kd = 0, ki = 0: does not close the loop; one of the gains must "
          "not be 0");
  refused({"--reference", "cmd_deg", "--controller", "kp=1,kdd=2"},
          "--controller: kdd: unknown key (did you mean kd?); allowed: sensor, kp, kd, ki, "
          "derivative, A, B, C, D, limit, sample_time");
  refused({"--reference", "cmd_deb", "--controller", "kp=1"},
          "--reference cmd_deb: column cmd_deb: not in the file (did you mean cmd_deg?); it has "
          "t_s, i_A, counts, speed_rad_s, cmd_deg");
  refused({"--reference", "cmd_deg", "--controller", "sensor=hub_velocity,kp=1"},
          "--reference cmd_deg: unit = deg: not one of rad/s, deg/s, mrad/s, rev/s, rpm, krpm, "
          "rad/min; give scale "
          "in rad/s per deg");
  refused({"--reference", "cmd_deg", "--column", "reference=counts", "--controller", "kp=1"},
          "--column reference=counts: reference given twice");
  refused({"--reference", "cmd_deg", "--controller", "kp=1,sample_time=0.003"},
          "log.csv: --controller: sample_time = 0.003 s: must be a whole multiple of the period of "
          "the record, 0.002 s");
  refused({"--reference", "cmd_deg", "--controller", "kp=1", "--decimate", "4"},
          "--decimate: not together with --controller; a filtered torque is not what the "
          "controller commanded and held");
  refused({"--reference", "cmd_deg", "--controller", "kp=1", "--hold", "first"},
          "--hold first: not together with --controller, which holds its torque between its "
          "samples");
  write("law.toml", "kp = 1.0\nlimit = -2.0\n");
  refused({"--reference", "cmd_deg", "--controller", "law.toml"},
          "law.toml:2: limit = -2 N m: must be a finite number above 0");
}

TEST_F(ImportLoop, AControllerOfASensorThatIsNotRecordedIsAWarning) {
  write("log.csv", loop_log(20));
  const Ended ended =
      import({"--reference", "cmd_deg:m:0.1", "--controller", "sensor=tip_displacement,kp=1"});
  ASSERT_EQ(ended.status, 0) << ended.errors;
  EXPECT_THAT(ended.output,
              HasSubstr("warning: the controller reads tip_displacement, which is no column"));
  EXPECT_THAT(import({"--reference", "cmd_deg", "--controller", "kp=1"}).output,
              Not(HasSubstr("warning")));
}

TEST_F(ImportLoop, AMissingValueOfTheReferenceIsAMissingSample) {
  std::string log = loop_log(20);
  const std::string row = "0.010000,0.5,5,5,5\n";
  log.replace(log.find(row), row.size(), "0.010000,0.5,5,5,\n");
  write("log.csv", log);
  const Ended ended = import({"--reference", "cmd_deg", "--controller", "kp=1", "--out", "bench"});
  ASSERT_EQ(ended.status, 0) << ended.errors;
  EXPECT_THAT(ended.output, HasSubstr("1 of 20 rows left out, as missing samples"));
  EXPECT_EQ(std::get<measured::TimeRecord>(
                measured::read_run(folder_ / "bench/measurement.toml", run_in("bench", 0)))
                .time_s.size(),
            20U);
}

}  // namespace
}  // namespace flexarm::testing_app
