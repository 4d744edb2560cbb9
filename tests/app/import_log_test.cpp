#include "measured/files/measurement.hpp"
#include "measured/files/run_data.hpp"
#include "tests/app/flexarm_fixture.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>

namespace flexarm::testing_app {
namespace {

namespace fs = std::filesystem;
using measured::InitialState;
using measured::Purpose;
using measured::TorqueHold;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// Logs as laboratories make them, imported without a script.
class ImportLog : public Flexarm {
 protected:
  Ended import(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "import");
    return run(arguments);
  }
  measured::Measurement measurement_in(const std::string& folder) const {
    return measured::read_measurement(folder_ / folder / "measurement.toml");
  }
  measured::TimeRecord record_in(const std::string& folder, std::size_t run = 0) const {
    return std::get<measured::TimeRecord>(measured::read_run(folder_ / folder / "measurement.toml",
                                                             measurement_in(folder).runs.at(run)));
  }
};

/// Tab-separated, names behind a comment mark, milliseconds called seconds, a column without a name
/// at the end.
std::string teaching_log(int rows) {
  std::string log =
      "%Time (s)\tHubangle(Theta in rad)\tTip Deflection(m)\tHub Angular Velocity (rads/s)\t"
      "Output Voltage (V)\t%4/12/201711:23 AM\r\n";
  for (int k = 0; k < rows; ++k) {
    const double time_s = 0.001 * k;
    log += fmt::format("{:.3f}\t{:.6f}\t0.000\t{:.6f}\t{:.3f}\t0.000\t0.000\t\r\n", 343393.0 + k,
                       std::sin(10.0 * time_s), 10.0 * std::cos(10.0 * time_s), 0.001 * k);
  }
  return log;
}

const std::vector<std::string> kTeachingTorque = {
    "--torque", "0.1574*([Output Voltage] - 0.518*[Hub Angular Velocity])"};

TEST_F(ImportLog, ATorqueIsComputedFromVoltageAndVelocity) {
  write("log.txt", teaching_log(300));
  std::vector<std::string> arguments = {"log.txt", "--time-unit", "ms", "--out", "bench"};
  arguments.insert(arguments.end(), kTeachingTorque.begin(), kTeachingTorque.end());
  const Ended ended = import(arguments);
  ASSERT_EQ(ended.status, 0) << ended.errors;
  EXPECT_THAT(ended.output, AllOf(HasSubstr("= 0.1574*([Output Voltage] - 0.518*"),
                                  HasSubstr("warning: time: the file tells s of"),
                                  Not(HasSubstr("time is read"))));
  const auto record = record_in("bench");
  ASSERT_EQ(record.time_s.size(), 300U);
  EXPECT_NEAR(measured::sampling_period_s(record), 1e-3, 1e-12);
  EXPECT_EQ(record.torque_N_m[0], 0.1574 * (0.0 - 0.518 * 10.0));
  EXPECT_EQ(record.channels.size(), 3U);
}

TEST_F(ImportLog, AColumnThatIsLeftOutIsNoSensor) {
  write("log.csv", "t_s,torque_Nm,theta_rad,omega_rad_s\n0,1,2,3\n1,1,2,3\n2,1,2,3\n");
  const Ended ended = import({"log.csv", "--leave-out", "omega_rad_s", "--out", "bench"});
  ASSERT_EQ(ended.status, 0) << ended.errors;
  ASSERT_EQ(record_in("bench").channels.size(), 1U);
  EXPECT_EQ(record_in("bench").channels[0].sensor.kind, arm::SensorKind::hub_angle);
  expect_refused(import({"log.csv", "--leave-out", "omega", "--leave-out", "omgea_rad_s"}),
                 "--leave-out: column omgea_rad_s: not in the file (did you mean omega_rad_s?); it "
                 "has t_s, torque_Nm, theta_rad, omega_rad_s");
}

TEST_F(ImportLog, AColumnThatIsLeftOutIsNotTakenByItsHeader) {
  write("log.csv",
        "time [s],torque [N m],hub_angle [rad],hub_velocity [rad/s]\n0,1,2,3\n1,1,2,3\n2,1,2,3\n");
  const Ended ended = import({"log.csv", "--leave-out", "hub_velocity", "--out", "bench"});
  ASSERT_EQ(ended.status, 0) << ended.errors;
  ASSERT_EQ(record_in("bench").channels.size(), 1U);
  EXPECT_EQ(record_in("bench").channels[0].sensor.kind, arm::SensorKind::hub_angle);
}

TEST_F(ImportLog, AColumnThatIsLeftOutMayBeComputedWith) {
  write("log.csv", "time [s],torque [N m],hub_angle [rad]\n0,1,2\n1,1,2\n2,1,2\n");
  const Ended ended = import({"log.csv", "--leave-out", "hub_angle", "--compute",
                              "hub_velocity=3*[hub_angle [rad]]", "--out", "bench"});
  ASSERT_EQ(ended.status, 0) << ended.errors;
  ASSERT_EQ(record_in("bench").channels.size(), 1U);
  EXPECT_EQ(record_in("bench").channels[0].sensor.kind, arm::SensorKind::hub_velocity);
  EXPECT_EQ(record_in("bench").channels[0].values[0], 6.0);
}

TEST_F(ImportLog, MillisecondsCalledSecondsAreAWarning) {
  write("log.txt", teaching_log(300));
  const Ended ended = import({"log.txt", kTeachingTorque[0], kTeachingTorque[1]});
  ASSERT_EQ(ended.status, 0) << ended.errors;
  EXPECT_THAT(ended.output, AllOf(HasSubstr("warning: time is read in s, but the hub angle"),
                                  HasSubstr("add --time-unit ms")));
}

TEST_F(ImportLog, AFormulaOfTheCommandLineIsCheckedBeforeItIsUsed) {
  write("log.txt", "t_s,V,omega,theta\n0,1,2,3\n1,1,2,3\n");
  const auto refused = [&](std::vector<std::string> arguments, const std::string& line) {
    arguments.insert(arguments.begin(), "log.txt");
    expect_refused(import(arguments), line);
  };
  refused({"--torque", "2*(V"}, "--torque: expression = 2*(V: a parenthesis is not closed");
  refused({"--torque", "2*omgea"},
          "--torque: expression = 2*omgea: column omgea: not in the file (did you mean omega?); it "
          "has t_s, V, omega, theta");
  refused({"--torque", "V", "--compute", "hub_velocity [V]=omega"},
          "--compute hub_velocity [V]=omega: unit = V: not one of rad/s, deg/s, mrad/s, rev/s, "
          "rpm, krpm, rad/min; "
          "give scale in rad/s per V");
  refused({"--torque", "V", "--column", "torque=V:N m"}, "--torque: torque given twice");
  refused({"--torque", "V", "--time-unit", "rad"},
          "--time-unit rad: must be s or ms or us or ns or min or h");
}

TEST_F(ImportLog, ColumnsMayBeTakenByNumberAndResultsHaveUnits) {
  write("log.txt", "0 1 90 0\n0.01 2 180 30\n0.02 3 90 60\n");
  const Ended ended =
      import({"log.txt", "--column", "time=#1", "--column", "torque=#2:N cm", "--column",
              "hub_angle=3:deg", "--compute", "hub_velocity [rpm] = ddt([#4])", "--out", "bench"});
  ASSERT_EQ(ended.status, 0) << ended.errors;
  const auto record = record_in("bench");
  EXPECT_EQ(record.torque_N_m[1], 0.02);
  EXPECT_EQ(record.channels[0].values[1], std::numbers::pi);
  EXPECT_NEAR(record.channels[1].values[1], 3000.0 * std::numbers::pi / 30.0, 1e-9);
}

std::string even_log(int rows, double period_s) {
  std::string log = "t_s,torque_Nm,theta_rad\n";
  for (int k = 0; k < rows; ++k) log += fmt::format("{:.6f},{},{}\n", k * period_s, k, -k);
  return log;
}

TEST_F(ImportLog, SeveralFilesAreOneMeasurement) {
  fs::create_directory(folder_ / "day2");
  write("a.csv", even_log(20, 0.01));
  write("b.csv", even_log(30, 0.02));
  write("day2/a.csv", even_log(40, 0.01));
  const Ended ended =
      import({"a.csv", "b.csv", "day2/a.csv", "--validation", "b", "--out", "bench"});
  ASSERT_EQ(ended.status, 0) << ended.errors;
  EXPECT_THAT(names_in("bench"),
              ElementsAre("a-2.csv", "a.csv", "arm.toml", "b.csv", "measurement.toml"));
  const auto measurement = measurement_in("bench");
  EXPECT_EQ(measurement.name, "bench");
  ASSERT_EQ(measurement.runs.size(), 3U);
  EXPECT_EQ(measurement.runs[1].purpose, Purpose::validation);
  EXPECT_EQ(measurement.runs[2].purpose, Purpose::estimation);
  EXPECT_EQ(measurement.runs[2].initial, InitialState::rest);
  EXPECT_EQ(record_in("bench", 2).time_s.size(), 40U);
}

TEST_F(ImportLog, RangesOfAFileAreRunsOfTheirOwn) {
  write("a.csv", even_log(100, 0.01));
  ASSERT_EQ(
      import({"a.csv", "--run", "low=0.1:0.3", "--run", "high=rows:51:", "--out", "two"}).status,
      0);
  const auto runs = measurement_in("two").runs;
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_EQ(runs[0].id, "low");
  EXPECT_EQ(runs[0].initial, InitialState::free);
  EXPECT_EQ(record_in("two", 0).time_s.size(), 21U);
  EXPECT_EQ(record_in("two", 1).torque_N_m.front(), 50.0);
  ASSERT_EQ(import({"a.csv", "--rows", "1:10", "--out", "first"}).status, 0);
  EXPECT_EQ(measurement_in("first").runs[0].initial, InitialState::rest);
  EXPECT_EQ(record_in("first").time_s.size(), 10U);
  ASSERT_EQ(import({"a.csv", "--times", "0.5:", "--initial", "rest", "--out", "late"}).status, 0);
  EXPECT_EQ(measurement_in("late").runs[0].initial, InitialState::rest);
}

TEST_F(ImportLog, ADecimatedTorqueHasAFirstOrderHold) {
  write("a.csv", even_log(1000, 0.001));
  const Ended ended = import({"a.csv", "--decimate", "4", "--out", "slow"});
  ASSERT_EQ(ended.status, 0) << ended.errors;
  EXPECT_THAT(ended.output, AllOf(HasSubstr("zero-phase low-pass"), HasSubstr("up to 100 Hz"),
                                  HasSubstr("first-order hold")));
  EXPECT_EQ(measurement_in("slow").runs[0].torque_hold, TorqueHold::first);
  EXPECT_EQ(measurement_in("slow").runs[0].initial, InitialState::free);
  const auto record = record_in("slow");
  EXPECT_NEAR(measured::sampling_period_s(record), 0.004, 1e-12);
  // A ramp passes a symmetric filter of sum 1 unchanged.
  EXPECT_NEAR(record.torque_N_m[10], record.time_s[10] * 1000.0, 1e-9);
}

TEST_F(ImportLog, AStretchThatIsTooShortToDecimateIsLeftOut) {
  std::string log = "t_s,torque_Nm,theta_rad\n";
  for (int k = 0; k < 600; ++k) log += fmt::format("{:.3f},0,0\n", 0.001 * (k < 550 ? k : k + 50));
  write("log.csv", log);
  const Ended ended = import({"log.csv", "--decimate", "2", "--out", "bench"});
  ASSERT_EQ(ended.status, 0) << ended.errors;
  EXPECT_THAT(ended.output, HasSubstr("1 of the stretches left out"));
  ASSERT_EQ(measurement_in("bench").runs.size(), 1U);
  EXPECT_EQ(measurement_in("bench").runs[0].id, "log");
  EXPECT_LT(record_in("bench").time_s.back(), 0.55);
}

TEST_F(ImportLog, UnevenTimesAreResampledAndGapsSplit) {
  std::string log = "t_s,torque_Nm,theta_rad\n";
  for (int k = 0; k < 200; ++k) {
    const double off = k % 3 == 1 ? 0.12 : 0.0;
    log += fmt::format("{},{},{}\n", 0.01 * (k + off + (k < 120 ? 0 : 20)), 1.0, 0.5);
  }
  write("log.csv", log);
  const Ended ended = import({"log.csv", "--out", "bench"});
  ASSERT_EQ(ended.status, 0) << ended.errors;
  EXPECT_THAT(ended.output, AllOf(HasSubstr("20 samples missing between"),
                                  HasSubstr("sampling jitter up to"), HasSubstr("resampled")));
  const auto runs = measurement_in("bench").runs;
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_EQ(runs[0].id, "log-1");
  EXPECT_EQ(runs[0].initial, InitialState::rest);
  EXPECT_EQ(runs[1].initial, InitialState::free);
  EXPECT_EQ(record_in("bench", 1).channels[0].values[3], 0.5);
  EXPECT_THAT(import({"log.csv", "--clock", "even"}).output, HasSubstr("samples taken as even"));
  EXPECT_EQ(import({"log.csv", "--fill-gaps", "20", "--out", "filled"}).status, 0);
  EXPECT_EQ(measurement_in("filled").runs.size(), 1U);
}

TEST_F(ImportLog, RawDoublesAreColumnsByNumber) {
  std::string bytes;
  for (int k = 0; k < 20; ++k) {
    for (const double value : {0.01 * k, 0.5 * k, -1.0 * k}) {
      auto bits = std::bit_cast<std::uint64_t>(value);
      for (int i = 0; i < 8; ++i, bits >>= 8U) bytes += static_cast<char>(bits & 0xffU);
    }
  }
  write("log.bin", bytes);
  const std::vector<std::string> columns = {"--column",  "time=#1",  "--column",
                                            "torque=#2", "--column", "hub_angle=#3"};
  std::vector<std::string> arguments = {"log.bin", "--raw-columns", "3", "--out", "raw"};
  arguments.insert(arguments.end(), columns.begin(), columns.end());
  const Ended ended = import(arguments);
  ASSERT_EQ(ended.status, 0) << ended.errors;
  EXPECT_THAT(ended.output, StartsWith("log.bin: raw doubles, read as time\n"));
  EXPECT_EQ(record_in("raw").channels[0].values[7], -7.0);
  arguments[2] = "7";
  arguments[4] = "other";
  expect_refused(import(arguments),
                 "log.bin: 480 bytes; must be two or more whole rows of 7 doubles, 56 bytes each");
}

TEST_F(ImportLog, ALogWithoutASensorIsRefused) {
  write("log.csv", "t_s,torque_Nm,room\n0,1,2\n1,1,2\n");
  expect_refused(import({"log.csv"}),
                 "log.csv: no column is a sensor; columns: t_s, torque_Nm, room; assign one with "
                 "--column hub_angle=NAME:UNIT:SCALE");
}

TEST_F(ImportLog, WhatDoesNotGoTogetherIsOneLine) {
  write("a.csv", even_log(20, 0.01));
  write("b.csv", even_log(20, 0.01));
  expect_refused(import({"a.csv", "b.csv", "--run", "x=0:1"}), "--run: needs a single file");
  expect_refused(import({"a.csv", "--run", "x=0:1", "--rows", "1:9"}),
                 "--run: not together with --rows or --times");
  expect_refused(import({"a.csv", "--run", "x"}),
                 "--run x: must be ID=FROM:TO, times in s, or ID=rows:FROM:TO");
  expect_refused(
      import({"a.csv", "--times", "5:9"}),
      "a.csv: --times 5:9: 0 samples in this range; the file has rows 1 to 20, times 0 s "
      "to 0.19 s");
  expect_refused(import({"a.csv", "b.csv", "--id", "x"}),
                 "--id: needs a single file; the runs of several are named after them");
  expect_refused(import({"a.csv", "b.csv", "--validation", "c"}),
                 "--validation c: no run of this id; runs: a, b");
  expect_refused(import({"a.csv", "b.csv", "--save-as", "c.csv"}),
                 "--save-as: writes a single run; the input makes 2");
  expect_refused(import({"a.csv", "--decimate", "1"}), "--decimate 1: must be 2 or more");
  expect_refused(
      import({"a.csv", "--decimate", "5"}),
      "a.csv: 20 samples are too few to decimate by 5, whose filter has 253; needs 258 or "
      "more");
  expect_refused(import({"a.csv", "--hold", "zero", "--decimate", "5"}),
                 "--hold zero: not together with --decimate; a filtered torque has a first-order "
                 "hold");
  expect_refused(import({"a.csv", "--clock", "evn"}),
                 "--clock evn: must be stamped or even (did you mean even?)");
}

}  // namespace
}  // namespace flexarm::testing_app
