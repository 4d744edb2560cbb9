#include "measured/files/time_record.hpp"

#include "arm/input_error.hpp"
#include "measured/files/text_file.hpp"
#include "tests/measured/any_finite.hpp"
#include "tests/measured/mistake.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>

namespace flexarm::measured {
namespace {

using arm::Sensor;
using arm::SensorKind;

constexpr Sensor kHubAngle{SensorKind::hub_angle, 0.0};

TEST(TimeRecord, EveryColumnReachesItsVector) {
  const TimeRecord record = parse_time_record(
      "time [s],torque [N m],hub_angle [rad],strain@0.05 [1]\n"
      "0,0.1,1e-3,-2e-6\n0.002,-0.1,+2e-3,3e-6\n0.004,0,0,0\n",
      "r");
  EXPECT_EQ(record.time_s, (std::vector{0.0, 0.002, 0.004}));
  EXPECT_EQ(record.torque_N_m, (std::vector{0.1, -0.1, 0.0}));
  ASSERT_EQ(record.channels.size(), 2U);
  EXPECT_EQ(record.channels[0], (Channel{kHubAngle, {1e-3, 2e-3, 0.0}}));
  EXPECT_EQ(record.channels[1], (Channel{{SensorKind::strain, 0.05}, {-2e-6, 3e-6, 0.0}}));
  EXPECT_EQ(sampling_period_s(record), 0.002);
}

TEST(TimeRecord, ColumnsStandInAnyOrderAndUnitsAreConverted) {
  const TimeRecord record = parse_time_record(
      "\xef\xbb\xbf# bench\r\n\r\n\"tip_acceleration [g]\", torque [N mm] ,time [ms],"
      "hub_angle [deg],hub_velocity [deg/s],strain@0.05 [ustrain],tip_deflection [mm]\r\n"
      "1,20,7,180,-90,5,3\r\n0,0,9,0,0,0,0\r\n",
      "r");
  EXPECT_EQ(record.time_s, (std::vector{0.007, 0.009}));
  EXPECT_EQ(record.torque_N_m[0], 0.02);
  EXPECT_EQ(record.channels[0].values[0], 9.80665);
  EXPECT_EQ(record.channels[1].values[0], std::numbers::pi);
  EXPECT_EQ(record.channels[2].values[0], -std::numbers::pi / 2.0);
  EXPECT_EQ(record.channels[3].values[0], 5e-6);
  EXPECT_EQ(record.channels[4].values[0], 0.003);
  EXPECT_EQ(parse_time_record("time [us],torque [N m]\n0,1\n2500,1\n", "r").time_s[1], 0.0025);
}

TEST(TimeRecord, ATorqueAloneIsARecord) {
  const TimeRecord record = parse_time_record("time [s],torque [N m]\n0,0.1\n0.002,0.2\n", "r");
  EXPECT_EQ(record.torque_N_m, (std::vector{0.1, 0.2}));
  EXPECT_TRUE(record.channels.empty());
}

TEST(TimeRecord, WhatIsWrittenReadsBackBitForBit) {
  std::mt19937_64 random(20261120);
  TimeRecord record;
  record.channels = {{kHubAngle, {}},
                     {{SensorKind::hub_velocity, 0.0}, {}},
                     {{SensorKind::tip_acceleration, 0.0}, {}},
                     {{SensorKind::tip_displacement, 0.0}, {}},
                     {{SensorKind::tip_deflection, 0.0}, {}},
                     {{SensorKind::strain, 0x1.999999999999ap-5}, {}}};
  for (int i = 0; i < 2000; ++i) {
    record.time_s.push_back(static_cast<double>(i) / 300.0);
    record.torque_N_m.push_back(any_finite(random));
    for (auto& channel : record.channels) channel.values.push_back(any_finite(random));
  }
  const TimeRecord read = parse_time_record(format_time_record(record), "r");
  EXPECT_EQ(read, record);
}

TEST(TimeRecord, NegativeZeroKeepsItsSign) {
  const TimeRecord record{{0.0, 1.0}, {-0.0, 0.0}, {}};
  EXPECT_TRUE(std::signbit(parse_time_record(format_time_record(record), "r").torque_N_m[0]));
}

TEST(TimeRecord, AMillionRowsAreReadInSeconds) {
  constexpr int kSamples = 1'000'000;
  TimeRecord record;
  record.channels = {{kHubAngle, {}}, {{SensorKind::tip_acceleration, 0.0}, {}}};
  for (int i = 0; i < kSamples; ++i) {
    const double t = i * 1e-4;
    record.time_s.push_back(t);
    record.torque_N_m.push_back(std::sin(t));
    record.channels[0].values.push_back(std::cos(t));
    record.channels[1].values.push_back(std::sin(3.0 * t));
  }
  const auto begin = std::chrono::steady_clock::now();
  const std::string text = format_time_record(record);
  const auto written = std::chrono::steady_clock::now();
  const TimeRecord read = parse_time_record(text, "r");
  const auto end = std::chrono::steady_clock::now();
  EXPECT_EQ(read, record);
  const std::chrono::duration<double> write_s = written - begin;
  const std::chrono::duration<double> read_s = end - written;
  RecordProperty("write_s", fmt::format("{:.3f}", write_s.count()));
  RecordProperty("read_s", fmt::format("{:.3f}", read_s.count()));
  // Each takes about a third of a second; the room is for sanitizers and a busy machine.
  constexpr double kMost_s = 30.0;
  EXPECT_LT(write_s.count() + read_s.count(), kMost_s);
}

TEST(TimeRecord, TimesRoundedToFourDecimalsAreEven) {
  std::string text = "time [s],torque [N m]\n";
  for (int i = 0; i < 1000; ++i) fmt::format_to(std::back_inserter(text), "{:.4f},0\n", i / 600.0);
  EXPECT_EQ(parse_time_record(text, "r").time_s.size(), 1000U);
}

TEST(TimeRecord, WhatCannotBeReadBackIsNotWritten) {
  EXPECT_THROW(format_time_record({{0.0, 1.0}, {0.0}, {}}), arm::InputError);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  try {
    format_time_record({{0.0, 1.0}, {0.0, 0.0}, {{kHubAngle, {0.0, nan}}}});
    FAIL() << "accepted";
  } catch (const arm::InputError& error) {
    EXPECT_STREQ(error.what(), "hub_angle = nan in sample 2: must be a finite number");
  }
}

TEST(TimeRecord, TheExampleOfTheFormatsDocumentIsRead) {
  const std::string text = measured::read_text_file(FLEXARM_SOURCE_DIR "/docs/formats.md", 1 << 20);
  const auto begin = text.find("time [s],torque [N m]", text.find("## Time record"));
  const TimeRecord record =
      parse_time_record(text.substr(begin, text.find("```", begin) - begin), "docs/formats.md");
  EXPECT_EQ(record.channels.size(), 4U);
}

TEST(TimeRecord, BytesAtRandomGiveARecordOrOneLine) {
  const std::string good =
      "time [s],torque [N m],\"strain@0.05 [1]\"\n0,1,2e-6\n# x\n0.5,\"1\",-3\n1,+1,4\n1.5,0,0\n";
  expect_result_or_one_line(good, [](const std::string& text) { parse_time_record(text, "r"); });
}

/// A record of 2 ms steps whose k-th time (from 0) `change` may move.
template <class Change>
std::string record_with(int samples, Change change) {
  std::string text = "time [s],torque [N m]\n";
  for (int k = 0; k < samples; ++k) {
    fmt::format_to(std::back_inserter(text), "{:.6g},0\n", change(k));
  }
  return text;
}

const std::string kTimeHead = "time [s],torque [N m],hub_angle [rad]\n";

const std::vector<Mistake> kTimeRecordMistakes = {
    {"Empty", "", "1: empty; the header is time [s],torque [N m],hub_angle [rad],..."},
    {"OnlyAHeader", kTimeHead, "1: only a header; needs at least two samples"},
    {"OneSample", kTimeHead + "0,0,0\n", "2: one sample; needs at least two"},
    {"SensorMisspelt", "time [s],torque [N m],hub_angel [rad]\n0,0,0\n",
     "1: column: sensor hub_angel: unknown (did you mean hub_angle?); allowed: hub_angle, "
     "hub_velocity, tip_acceleration, tip_displacement, tip_deflection, strain@X (X in metres from "
     "the hub); besides time, torque and reference"},
    {"TorqueMisspelt", "time [s],torqe [N m]\n", "1: column torqe: unknown (did you mean torque?)"},
    {"UnitMisspelt", "time [s],torque [N m],hub_angle [dge]\n",
     "1: column hub_angle: unit dge unknown (did you mean deg?); allowed: rad, deg"},
    {"UnitOfAnotherQuantity", "time [s],torque [V]\n",
     "1: column torque: unit V unknown; allowed: N m, N mm"},
    {"UnitMissing", "time [s],torque\n",
     "1: column torque: unit missing; write torque [N m]; allowed: N m, N mm"},
    {"TimeMissing", "torque [N m]\n",
     "1: column time: missing; the header is time [s],torque [N m],hub_angle [rad],..."},
    {"TorqueMissing", "time [s],hub_angle [rad]\n",
     "1: column torque: missing; the header is time [s],torque [N m],hub_angle [rad],..."},
    {"ColumnTwice", "time [s],torque [N m],hub_angle [rad],hub_angle [deg]\n",
     "1: column hub_angle: given twice"},
    {"StrainTwice", "time [s],torque [N m],strain@0.05 [1],strain@0.050 [ustrain]\n",
     "1: column strain@0.05: given twice"},
    {"HeaderMissing", "0,0,0\n0.002,0,0\n",
     "1: column: sensor 0: unknown; allowed: hub_angle, hub_velocity, tip_acceleration, "
     "tip_displacement, tip_deflection, strain@X (X in metres from the hub); besides time, torque "
     "and reference"},
    {"Semicolons", "time [s];torque [N m]\n",
     "1: cells must be separated by commas, and numbers have a decimal point"},
    {"DecimalComma", kTimeHead + "0,0,0\n0,002,0,0\n",
     "3: 4 cells; the header has 3 (numbers have a decimal point)"},
    {"QuoteNotClosed", kTimeHead + "0,0,0\n\"0.002,0,0\n",
     "3: a quote is not closed; end the cell with \""},
    {"NotANumber", kTimeHead + "0,0,0\n0.002,0,1.2.3\n",
     "3: hub_angle = 1.2.3 rad: must be a finite number"},
    {"Nan", kTimeHead + "0,0,0\n# lost\n0.002,NaN,0\n",
     "4: torque = NaN N m: must be a finite number"},
    {"Infinite", kTimeHead + "0,0,-inf\n", "2: hub_angle = -inf rad: must be a finite number"},
    {"TooLargeInSi", "time [s],torque [N m],tip_acceleration [g]\n0,0,1e308\n",
     "2: tip_acceleration = 1e308 g: must be a finite number"},
    {"CellEmpty", kTimeHead + "0,0,\n",
     "2: hub_angle = : must be a finite number; no cell may be empty"},
    {"TimeRepeated", kTimeHead + "0,0,0\n0.002,0,0\n0.002,0,0\n0.004,0,0\n",
     "4: time = 0.002 s: same as the previous sample; must be strictly increasing"},
    {"TimeBackward", kTimeHead + "0,0,0\n0.004,0,0\n0.002,0,0\n",
     "4: time = 0.002 s: below the previous sample at 0.004 s; must be strictly increasing"},
    {"OneSampleMissing", record_with(100, [](int k) { return 0.002 * (k < 50 ? k : k + 1); }),
     "52: gap: 1 sample is missing between 0.098 s and 0.102 s, where the step is 0.004 s and the "
     "period 0.002 s; split the record there, or fill it (flexarm import "
     "does)"},
    {"SamplesMissingTwice",
     record_with(100, [](int k) { return 0.002 * (k + (k >= 50 ? 7 : 0) + (k >= 80 ? 2 : 0)); }),
     "52: gap: 7 samples are missing between 0.098 s and 0.114 s, where the step is 0.016 s and "
     "the period 0.002 s, and 1 more gap; split the record there, or fill it (flexarm import "
     "does)"},
    {"GapAfterFewSamples", kTimeHead + "0,0,0\n0.002,0,0\n1e9,0,0\n",
     "4: gap: 499999999998 samples are missing between 0.002 s and 1000000000 s, where the step is "
     "1e+09 s and the period 0.002 s; split the record there, or fill it (flexarm import "
     "does)"},
    {"Jitter", record_with(101, [](int k) { return 0.002 * k + (k == 30 ? 0.0003 : 0.0); }),
     "32: time = 0.0603 s: jitter 0.15 of the sampling period 0.002 s; must be 0.05 or "
     "less: write more digits, or resample (flexarm import does)"},
    {"TimesRoundedTooFar", record_with(101, [](int k) { return std::round(1.5 * k) / 1000.0; }),
     "3: time = 0.002 s: jitter 0.33 of the sampling period 0.0015 s; must be 0.05 or "
     "less: write more digits, or resample (flexarm import does)"},
};

class TimeRecordMistake : public testing::TestWithParam<Mistake> {};

TEST_P(TimeRecordMistake, GivesOneLineWithPlaceReasonAndRemedy) {
  expect_line(GetParam(), "run.csv", parse_time_record);
}

INSTANTIATE_TEST_SUITE_P(, TimeRecordMistake, testing::ValuesIn(kTimeRecordMistakes),
                         name_of_mistake);

}  // namespace
}  // namespace flexarm::measured
