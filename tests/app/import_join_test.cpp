// Signals of one run in several files, joined by the program as a user would.
#include "measured/files/measurement.hpp"
#include "tests/app/import_files.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace flexarm::testing_app {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class ImportJoin : public ImportFiles {
 protected:
  using Stamp = std::function<std::string(int ms)>;

  /// Torque and angle are the ms since the first row of the first file; the second file begins
  /// 100 ms later.
  void write_pair(const Stamp& of_torque, const Stamp& of_angle, const std::string& name = "time") {
    std::string torque = name + ",torque [N m]\n";
    std::string angle = name + ",hub_angle [rad]\n";
    for (int ms = 0; ms < 600; ms += 2) {
      torque += fmt::format("{},{}\n", of_torque(ms), ms);
      angle += fmt::format("{},{}\n", of_angle(ms + 100), ms + 100);
    }
    write("a.csv", torque);
    write("b.csv", angle);
  }

  /// The samples of the joined run, of which each has torque and angle of one moment.
  std::size_t matching_samples(const std::vector<std::string>& files) const {
    auto arguments = files;
    arguments.emplace_back("--join");
    const auto joined = record(arguments);
    for (std::size_t k = 0; k < joined.time_s.size(); ++k) {
      EXPECT_EQ(joined.channels.at(0).values[k], joined.torque_N_m[k]) << k;
    }
    return joined.time_s.size();
  }
};

constexpr std::size_t kCommon = 250;

std::string clock_of(int ms) {
  return fmt::format("{:02}:{:02}:{:02}.{:03}", ms / 3600000 % 24, ms / 60000 % 60, ms / 1000 % 60,
                     ms % 1000);
}
constexpr int kNoon_ms = 12 * 3600000;
std::string at_noon(int ms) {
  return clock_of(kNoon_ms + ms);
}
std::string without_zone(int ms) {
  return "2024-03-01T" + at_noon(ms);
}
std::string iso(int ms) {
  return without_zone(ms) + "Z";
}
std::string before_midnight(int ms) {
  return clock_of(24 * 3600000 - 50 + ms);
}
std::string since_1970(int ms) {
  return fmt::format("{}.{:03}", 1709294400 + ms / 1000, ms % 1000);
}
std::string since_start(int ms) {
  return fmt::format("{:.3f}", 0.001 * ms);
}

TEST_F(ImportJoin, TimeStampsAreOfOneClock) {
  for (const auto& [of_torque, of_angle] :
       std::vector<std::pair<Stamp, Stamp>>{{iso, iso},
                                            {at_noon, at_noon},
                                            {before_midnight, before_midnight},
                                            {iso, since_1970},
                                            {since_1970, iso},
                                            {since_1970, since_1970},
                                            {since_start, since_start}}) {
    write_pair(of_torque, of_angle);
    EXPECT_EQ(matching_samples({"a.csv", "b.csv"}), kCommon) << of_torque(0) << of_angle(0);
    EXPECT_EQ(matching_samples({"b.csv", "a.csv"}), kCommon) << of_torque(0) << of_angle(0);
  }
  write_pair(iso, iso);
  EXPECT_EQ(matching_samples({"a.csv", "b.csv"}), kCommon);
  EXPECT_THAT(output_, HasSubstr("the times of b.csv start 0.1 s after those of a.csv"));
  write_pair([](int ms) { return "2024-03-01," + at_noon(ms); },
             [](int ms) { return "01.03.2024," + at_noon(ms); }, "Date,Time");
  EXPECT_EQ(matching_samples({"a.csv", "b.csv"}), kCommon);
  write_pair(iso, [](int ms) { return at_noon(ms) + "Z"; });
  EXPECT_EQ(matching_samples({"a.csv", "b.csv"}), kCommon);
  EXPECT_THAT(output_, HasSubstr("not all files tell a date"));
}

TEST_F(ImportJoin, TimeStampsOfJsonAreOfTheSameClock) {
  write_pair(iso, iso);
  std::string times;
  std::string values;
  for (int ms = 0; ms < 600; ms += 2) {
    times += fmt::format("{}\"{}\"", ms == 0 ? "" : ",", iso(ms));
    values += fmt::format("{}{}", ms == 0 ? "" : ",", ms);
  }
  write("a.json", fmt::format(R"({{"time":[{}],"torque":[{}]}})", times, values));
  EXPECT_EQ(matching_samples({"a.json", "b.csv"}), kCommon);
}

TEST_F(ImportJoin, StampsWithoutACommonTimeAreRefused) {
  write_pair(without_zone, [](int ms) { return "2024-03-02T" + at_noon(ms); });
  EXPECT_THAT(import({"a.csv", "b.csv", "--join"}).errors,
              AllOf(HasSubstr("no time in which all files have samples"),
                    HasSubstr("b.csv from 86400.1 s")));
  write_pair(iso, since_start);
  expect_refused(import({"a.csv", "b.csv", "--join"}),
                 "--join: a.csv has time stamps and b.csv seconds from 0.1 s, of which no time "
                 "of day is known; write both with time stamps, or both in seconds of one clock");
  write_pair(without_zone, iso);
  expect_refused(import({"a.csv", "b.csv", "--join"}),
                 "--join: the times of b.csv have a time zone, those of a.csv have none; must be "
                 "told in both, 12:00:00Z or 12:00:00+01:00, or in neither");
}

TEST_F(ImportJoin, ARunThatBeginsAfterItsTorqueIsFree) {
  using measured::InitialState;
  write_pair(since_start, since_start);
  EXPECT_EQ(imported({"a.csv", "b.csv", "--join"}).run.initial, InitialState::free);
  EXPECT_EQ(imported({"a.csv", "b.csv", "--join", "--hold", "first"}).run.initial,
            InitialState::free);
  EXPECT_EQ(imported({"a.csv", "b.csv", "--join", "--initial", "rest"}).run.initial,
            InitialState::rest);
  // The torque of the joined run, 0 before, acts from 100 ms on.
  std::string torque = "time,torque [N m]\n";
  for (int ms = 0; ms < 600; ms += 2) {
    torque += fmt::format("{},{}\n", since_start(ms), ms < 100 ? 0 : ms);
  }
  write("a.csv", torque);
  EXPECT_EQ(imported({"a.csv", "b.csv", "--join"}).run.initial, InitialState::rest);
}

TEST_F(ImportJoin, RowsThatOneFileLacksAreFilledOrSplitTheRun) {
  std::string torque = "time [s],torque [N m]\n";
  std::string angle = "time [s],hub_angle [rad]\n";
  std::string angle_with_gap = angle;
  for (int ms = 0; ms < 600; ms += 2) {
    torque += fmt::format("{},{}\n", since_start(ms), ms);
    const std::string row = fmt::format("{},{}\n", since_start(ms), ms);
    if (ms != 300) angle += row;
    if (ms < 300 || ms >= 320) angle_with_gap += row;
  }
  write("a.csv", torque);
  write("b.csv", angle);
  const auto filled = record({"a.csv", "b.csv", "--join"});
  ASSERT_EQ(filled.time_s.size(), 300U);
  EXPECT_NEAR(filled.channels.at(0).values[150], 300.0, 1e-6);
  EXPECT_EQ(record({"b.csv", "a.csv", "--join"}).time_s.size(), 300U);
  write("b.csv", angle_with_gap);
  EXPECT_THAT(import({"a.csv", "b.csv", "--join"}).output,
              AllOf(HasSubstr("run a-1"), HasSubstr("run a-2")));
}

TEST_F(ImportJoin, FilesOfOneSignalHaveTheTimesOfTheirHeads) {
  const auto write_rows = [&](const std::string& file, const std::string& head,
                              const std::string& end, int first_ms) {
    std::string text = head;
    for (int ms = 0; ms < 600; ms += 2) text += fmt::format("{}{}\n", ms + first_ms, end);
    write(file, text);
  };
  const std::vector<std::string> files = {"a.csv", "b.csv"};
  write_rows("a.csv", "Sample Interval,0.002,s\ntorque [N m]\n", "", 0);
  write_rows("b.csv", "Sample Interval,0.002,s\nStart,0.1,s\nhub_angle [rad]\n", "", 100);
  EXPECT_EQ(matching_samples(files), kCommon);
  const std::string keys =
      "\"Header Size\",16\n\"TraceName\",\"{}\"\n\"BlockSize\",300\n\"VUnit\",\"{}\"\n"
      "\"HResolution\",2.0E-03\n\"HOffset\",{}\n\"HUnit\",\"s\"\n\n";
  write_rows("a.csv", fmt::format(fmt::runtime(keys), "torque", "Nm", -0.3), ",", 0);
  write_rows("b.csv", fmt::format(fmt::runtime(keys), "hub_angle", "rad", -0.2), ",", 100);
  EXPECT_EQ(matching_samples(files), kCommon);
  write_rows("a.csv", "torque [N m]\n", "", 0);
  write_rows("b.csv", "hub_angle [rad]\n", "", 0);
  EXPECT_EQ(matching_samples({"a.csv", "b.csv", "--period", "0.002"}), 300U);
  EXPECT_THAT(output_, HasSubstr("all files are taken to begin at one moment"));
  EXPECT_THAT(import({"a.csv", "b.csv", "--join"}).errors,
              HasSubstr("a.csv: --join needs a time and a signal or more in each file"));
  write_pair(since_start, since_start);
  expect_refused(import({"a.csv", "b.csv", "--join", "--period", "0.002"}),
                 "a.csv: --period: not for a file that is joined by its own times, time");
  write_rows("a.csv", "CH1V,t0 = -0.3, tInc = 2.0e-03\n", ",,", 0);
  write_rows("b.csv", "CH1V,t0 = -0.2, tInc = 2.0e-03\n", ",,", 100);
  EXPECT_EQ(matching_samples({"a.csv", "b.csv", "--column", "torque=a.CH1V:V:1", "--column",
                              "hub_angle=b.CH1V:V:1"}),
            kCommon);
}

/// A LabVIEW file whose head tells the clock, and X0 in s.
std::string labview(const std::string& channel, const std::string& clock, double x0_s,
                    int first_ms) {
  std::string text =
      "LabVIEW Measurement\t\nWriter_Version\t2\nSeparator\tTab\nDecimal_Separator\t.\n"
      "X_Columns\tNo\n***End_of_Header***\t\n\t\nChannels\t1\t\nSamples\t300\t\n"
      "Date\t2024/03/01\t\nTime\t" +
      clock + "\t\nX_Dimension\tTime\t\n" +
      fmt::format("X0\t{:.3f}\t\nDelta_X\t0.002000\t\n***End_of_Header***\t\t\n", x0_s) +
      "X_Value\t" + channel + "\tComment\n";
  for (int ms = 0; ms < 600; ms += 2) text += fmt::format("\t{}\n", ms + first_ms);
  return text;
}

TEST_F(ImportJoin, HeadsOfLabviewTellTheClock) {
  write("a.lvm", labview("torque", "12:00:00.000000", 0.0, 0));
  write("b.lvm", labview("hub_angle", "12:00:00.100000", 0.0, 100));
  EXPECT_EQ(matching_samples({"a.lvm", "b.lvm"}), kCommon);
  write("b.lvm", labview("hub_angle", "12:00:00.100000", 0.1, 100));
  EXPECT_EQ(matching_samples({"a.lvm", "b.lvm"}), kCommon);
  write("b.lvm", labview("hub_angle", "12:00:00.000000", 0.1, 100));
  EXPECT_EQ(matching_samples({"a.lvm", "b.lvm"}), kCommon);
  write_pair(without_zone, without_zone);
  EXPECT_EQ(matching_samples({"a.lvm", "b.csv"}), kCommon);
  write_pair(since_start, since_start);
  EXPECT_EQ(matching_samples({"a.lvm", "b.csv"}), kCommon);
}

}  // namespace
}  // namespace flexarm::testing_app
