// A file of another kind than a command takes, and numbers with a unit behind them.
#include "measured/files/measurement.hpp"
#include "measured/files/run_data.hpp"
#include "tests/app/flexarm_fixture.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace flexarm::testing_app {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
using Words = std::vector<std::string>;

class WrongFile : public Flexarm {
 protected:
  WrongFile() {
    run({"new", "rig.toml"});
    run({"modes", "rig.toml", "--json", "result.json"});
    write("measurement.toml",
          "arm = \"rig.toml\"\n[[run]]\nid = \"a\"\nkind = \"time\"\nfile = \"a.csv\"\n");
    write("plan.toml", "[[run]]\nid = \"a\"\nkind = \"modal\"\npoles = 3\n");
    write("log.csv", "t;tau\n0;1\n1;2\n2;3\n");
    write("log.json", "[{\"t\": 0, \"tau\": 1}, {\"t\": 1, \"tau\": 1}]");
    write("sheet.xlsx", "PK\x03\x04......xl/workbook.xml");
  }
};

TEST_F(WrongFile, EveryCommandSaysWhatTheFileIsAndWhichCommandTakesIt) {
  struct Case {
    Words command;  ///< FILE is the file
    std::string due;
    Words files;
  };
  const std::vector<Case> cases = {
      {{"modes", "FILE"},
       "must be an arm file",
       {"measurement.toml", "plan.toml", "log.csv", "log.json", "result.json", "sheet.xlsx"}},
      {{"compare", "FILE"}, "must be an arm file", {"measurement.toml", "log.csv"}},
      {{"response", "FILE"}, "must be an arm file", {"measurement.toml", "log.json"}},
      {{"simulate", "FILE"}, "must be an arm file", {"measurement.toml", "log.csv"}},
      {{"sweep", "FILE", "--over", "payload.mass=0:0.1:2"}, "must be an arm file", {"plan.toml"}},
      {{"export", "FILE", "--fmu", "--out", "exported"},
       "must be an arm file",
       {"measurement.toml"}},
      {{"plan", "FILE", "plan.toml"}, "must be an arm file", {"plan.toml", "log.csv"}},
      {{"plan", "rig.toml", "FILE"},
       "must be a measurement plan",
       {"rig.toml", "measurement.toml", "log.csv"}},
      {{"diagnose", "FILE"},
       "must be a measurement",
       {"rig.toml", "plan.toml", "log.csv", "log.json", "result.json"}},
      {{"identify", "FILE"}, "must be a measurement", {"rig.toml", "log.csv", "sheet.xlsx"}},
      {{"compare", "rig.toml", "--measured", "FILE"},
       "must be",
       {"rig.toml", "log.csv", "result.json", "sheet.xlsx"}},
      {{"simulate", "rig.toml", "--torque", "FILE"},
       "must be a time record",
       {"rig.toml", "log.json"}},
      {{"import", "log.csv", "--arm", "FILE"}, "must be an arm file", {"measurement.toml"}},
      {{"import", "FILE"},
       "must be a log",
       {"rig.toml", "measurement.toml", "plan.toml", "result.json", "sheet.xlsx"}}};
  for (const auto& [command, due, files] : cases) {
    for (const auto& file : files) {
      Words words = command;
      std::ranges::replace(words, std::string("FILE"), file);
      const Ended ended = run(words);
      EXPECT_EQ(ended.status, 2) << command.front() << " " << file;
      EXPECT_THAT(ended.errors, AllOf(StartsWith(file + ": is "), HasSubstr("; " + due)))
          << command.front();
      EXPECT_EQ(std::ranges::count(ended.errors, '\n'), 1);
      EXPECT_EQ(ended.output, "");
    }
  }
  expect_refused(
      run({"diagnose", "rig.toml"}),
      "rig.toml: is an arm file; must be a measurement (measurement.toml); flexarm modes, "
      "compare, response and simulate take it");
  EXPECT_THAT(run({"diagnose", "log.csv"}).errors,
              HasSubstr("flexarm import log.csv --out FOLDER makes a measurement of it"));
}

TEST_F(WrongFile, WhatCompareTakesAsMeasuredIsNamedWhole) {
  write("record.csv", "time [s],torque [N m],hub_angle [rad]\n0,0,0\n0.1,1,0\n0.2,1,0.1\n");
  const std::string due =
      "must be a modal table or frequency responses (CSV), or a measurement.toml, whose time runs "
      "are simulated; ";
  expect_refused(run({"compare", "rig.toml", "--measured", "record.csv"}),
                 "record.csv: is a time record; " + due +
                     "a run of a measurement.toml names it, and flexarm import record.csv --out "
                     "FOLDER makes one of it");
  EXPECT_THAT(run({"compare", "rig.toml", "--measured", "log.csv"}).errors,
              AllOf(HasSubstr(due), HasSubstr("flexarm import log.csv")));
  // A modal table with a fault keeps its line.
  write("table.csv", "sensor,feature,frequency [Hz]\nall,pole,-3\n");
  EXPECT_THAT(run({"compare", "rig.toml", "--measured", "table.csv"}).errors,
              AllOf(StartsWith("table.csv:2: "), Not(HasSubstr("measurement.toml"))));
}

TEST_F(WrongFile, AFaultOfTheRightKindOfFileKeepsItsLine) {
  write("typo.toml", "[beam]\nlenght = 1.0\n");
  EXPECT_THAT(run({"modes", "typo.toml"}).errors,
              StartsWith("typo.toml:2: beam.lenght: unknown key"));
}

TEST_F(WrongFile, NumbersWithAUnitAreRefusedInWordsOfTheProgram) {
  const std::vector<std::pair<Words, std::string>> cases = {
      {{"simulate", "--duration", "4s"},
       "--duration = 4s: must be a number in s, without a unit behind it; write 4;"},
      {{"simulate", "--period", "2ms"},
       "--period = 2ms: must be a number in s, without a unit behind it; write 0.002;"},
      {{"modes", "--modes", "5Hz"},
       "--modes = 5Hz: must be a whole number, without a unit behind it;"},
      {{"modes", "--hub-inertia", "1g"},
       "--hub-inertia = 1g: must be a number in kg m^2, without a unit behind it;"},
      {{"response", "--to-Hz", "20Hz"},
       "--to-Hz = 20Hz: must be a number in Hz, without a unit behind it; write 20;"},
      {{"modes", "--payload-mass", "0.05kg"},
       "0.05kg is not a number; give numbers with a decimal point, separated by commas; in kg"}};
  for (const auto& [words, line] : cases) {
    const Ended ended = run(words);
    EXPECT_EQ(ended.status, 2);
    EXPECT_THAT(ended.errors, AllOf(HasSubstr(line), Not(HasSubstr("Could not convert"))));
  }
}

std::string signal(const char* head, double from_s, double period_s, int samples) {
  std::string text = std::string(head) + "\n";
  for (int k = 0; k < samples; ++k) {
    const double time_s = from_s + period_s * k;
    text += fmt::format("{},{}\n", time_s, std::sin(7.0 * time_s));
  }
  return text;
}

class JoinedFiles : public Flexarm {};

TEST_F(JoinedFiles, SignalsOfOneRunInSeveralFilesBecomeOneRun) {
  write("torque.csv", signal("time,value", 0.0, 0.004, 300));
  write("angle.csv", signal("time,value", 0.08, 0.004, 300));
  const Ended ended = run({"import", "torque.csv", "angle.csv", "--join", "--out", "bench"});
  ASSERT_EQ(ended.status, 0) << ended.errors;
  EXPECT_THAT(ended.output, HasSubstr("joined by time over 0.08 s to 1.196 s"));
  const auto file = folder_ / "bench/measurement.toml";
  const auto measurement = measured::read_measurement(file);
  ASSERT_EQ(measurement.runs.size(), 1U);
  EXPECT_EQ(measurement.runs[0].id, "torque");
  const auto record = std::get<measured::TimeRecord>(measured::read_run(file, measurement.runs[0]));
  ASSERT_EQ(record.time_s.size(), 280U);
  // The times of the files differ by their last digit.
  constexpr double kRounding = 1e-12;
  for (std::size_t k = 0; k < record.time_s.size(); ++k) {
    EXPECT_NEAR(record.torque_N_m[k], record.channels.at(0).values[k], kRounding);
  }
}

TEST_F(JoinedFiles, OtherTimesAreResampledIfItIsSaid) {
  write("torque.csv", signal("t,tau", 0.0, 0.004, 300));
  write("angle.csv", signal("t,theta", 0.003, 0.01, 110));
  const Words words = {"import", "torque.csv", "angle.csv", "--join"};
  const auto with = [&](const Words& more) {
    Words all = words;
    all.insert(all.end(), more.begin(), more.end());
    return run(all);
  };
  EXPECT_THAT(with({}).errors, AllOf(HasSubstr("one every 0.01 s, and every 0.004 s"),
                                     HasSubstr("--join-grid first or --join-grid coarsest")));
  EXPECT_THAT(with({"--join-grid", "coarsest"}).output, HasSubstr("110 samples, one every 0.01 s"));
  EXPECT_THAT(with({"--join-grid", "first"}).output, HasSubstr("273 samples, one every 0.004 s"));
  expect_refused(run({"import", "torque.csv", "--join"}), "--join: needs two files or more");
  expect_refused(run({"import", "torque.csv", "--join-grid", "first"}),
                 "--join-grid: needs --join");
}

TEST_F(JoinedFiles, JsonIsReadAsOtherLogs) {
  std::string json;
  for (int k = 0; k < 50; ++k) {
    json += fmt::format("{}{{\"time\": {}, \"torque\": {}, \"theta_deg\": {}}}",
                        k == 0 ? "[" : ",\n", 0.01 * k, 0.1, 0.5 * k);
  }
  write("log.json", json + "]");
  const Ended ended = run({"import", "log.json"});
  EXPECT_EQ(ended.status, 0) << ended.errors;
  EXPECT_THAT(ended.output, AllOf(HasSubstr("log.json: JSON, read as time"), HasSubstr("deg"),
                                  HasSubstr("50 samples, one every 0.01 s")));
}

}  // namespace
}  // namespace flexarm::testing_app
