#include "measured/files/frequency_record.hpp"

#include "arm/input_error.hpp"
#include "measured/files/record_constants.hpp"
#include "tests/measured/any_finite.hpp"
#include "tests/measured/mistake.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <random>
#include <stdexcept>

namespace flexarm::measured {
namespace {

using arm::Sensor;
using arm::SensorKind;

constexpr Sensor kHubAngle{SensorKind::hub_angle, 0.0};
constexpr Sensor kStrain{SensorKind::strain, 0.05};

const std::string kFrequencyHead = "frequency [Hz],sensor,re,im,coherence\n";

TEST(FrequencyRecord, EveryColumnReachesItsVector) {
  const auto record = parse_frequency_record(
      kFrequencyHead + "0.5,hub_angle,-2,+0.25,0.99\n1,hub_angle,-1,1e-3,\n0,strain@0.05,1,0,1\n",
      "f");
  ASSERT_EQ(record.channels.size(), 2U);
  EXPECT_EQ(
      record.channels[0],
      (FrequencyChannel{kHubAngle, {0.5, 1.0}, {{-2.0, 0.25}, {-1.0, 1e-3}}, {0.99, kUnknown}}));
  EXPECT_EQ(record.channels[1], (FrequencyChannel{kStrain, {0.0}, {{1.0, 0.0}}, {1.0}}));
}

TEST(FrequencyRecord, ColumnsAndRowsStandInAnyOrder) {
  const auto record = parse_frequency_record(
      "\xef\xbb\xbf# bench\r\nsensor,im,re,frequency [Hz]\r\nstrain@0.05,2,1,7\r\n"
      "hub_angle,4,3,6\r\nstrain@0.050,6,5,8\r\n",
      "f");
  ASSERT_EQ(record.channels.size(), 2U);
  EXPECT_EQ(
      record.channels[0],
      (FrequencyChannel{kStrain, {7.0, 8.0}, {{1.0, 2.0}, {5.0, 6.0}}, {kUnknown, kUnknown}}));
}

TEST(FrequencyRecord, AnInputIsTheMotionOfTheHub) {
  const std::string head = "frequency [Hz],sensor,re,im,coherence,input\n";
  const auto record = parse_frequency_record(
      head + "1,tip_deflection,1,2,,hub_angle\n2,tip_deflection,3,4,1,hub_angle\n", "f");
  EXPECT_EQ(record.input, kHubAngle);
  EXPECT_EQ(format_frequency_record(record),
            head + "1,tip_deflection,1,2,,hub_angle\n2,tip_deflection,3,4,1,hub_angle\n");
  EXPECT_EQ(parse_frequency_record(head + "1,hub_angle,1,2,,torque\n", "f").input, std::nullopt);
  const auto error_of = [&](const std::string& rows) -> std::string {
    try {
      parse_frequency_record(head + rows, "f");
    } catch (const arm::InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(error_of("1,hub_angle,1,2,,tip_deflection\n"),
            "f:2: input = tip_deflection: must be torque, hub_angle or hub_velocity");
  EXPECT_EQ(error_of("1,tip_deflection,1,2,,hub_angle\n2,tip_deflection,1,2,,torque\n"),
            "f:3: input = torque: must be that of the rows before");
  EXPECT_EQ(error_of("1,hub_angle,1,2,,hub_angle\n"),
            "f:2: hub_angle: is the input; must be another sensor");
}

TEST(FrequencyRecord, WhatIsUnknownIsEqualToWhatIsUnknownAlone) {
  const FrequencyChannel unknown{kHubAngle, {1.0}, {1.0}, {kUnknown}};
  const FrequencyChannel known{kHubAngle, {1.0}, {1.0}, {0.5}};
  EXPECT_EQ(unknown, unknown);
  EXPECT_FALSE(unknown == known);
}

TEST(FrequencyRecord, WhatIsWrittenReadsBackBitForBit) {
  std::mt19937_64 random(20261122);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  FrequencyRecord record{{{kHubAngle, {}, {}, {}}, {kStrain, {}, {}, {}}}};
  for (auto& channel : record.channels) {
    double frequency_Hz = 0.0;
    for (int i = 0; i < 2000; ++i) {
      channel.frequency_Hz.push_back(frequency_Hz += uniform(random) + 1e-9);
      const double real = any_finite(random);
      channel.response.emplace_back(real, any_finite(random));
      channel.coherence.push_back(random() % 3 == 0 ? kUnknown : 1.0 - uniform(random));
    }
  }
  record.channels[0].response[0] = {-0.0, 0.0};
  const auto read = parse_frequency_record(format_frequency_record(record), "f");
  EXPECT_EQ(read, record);
  EXPECT_TRUE(std::signbit(read.channels[0].response[0].real()));
}

TEST(FrequencyRecord, WhatCannotBeReadBackIsNotWritten) {
  const auto error_of = [](const FrequencyChannel& channel) -> std::string {
    try {
      format_frequency_record({{channel}});
    } catch (const arm::InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(error_of({kHubAngle, {1.0}, {{1.0, kUnknown}}, {1.0}}),
            "hub_angle = 1 + nan i at 1 Hz: must be finite numbers");
  EXPECT_EQ(error_of({kHubAngle, {-1.0}, {1.0}, {1.0}}),
            "frequency [Hz] = -1 of hub_angle: must be a finite number, 0 or more");
  EXPECT_EQ(error_of({kHubAngle, {1.0, 1.0}, {1.0, 1.0}, {1.0, 1.0}}),
            "frequency [Hz] = 1: again the one before of hub_angle; must be strictly increasing "
            "per sensor");
  EXPECT_EQ(error_of({kHubAngle, {1.0}, {1.0}, {1.5}}),
            "coherence = 1.5 of hub_angle at 1 Hz: must be above 0 and 1 or less, or unknown");
  EXPECT_THROW(format_frequency_record({}), arm::InputError);
  EXPECT_THROW(format_frequency_record({{{kHubAngle, {}, {}, {}}}}), arm::InputError);
  EXPECT_THROW(format_frequency_record({{{kHubAngle, {1.0}, {1.0}, {}}}}), arm::InputError);
  const FrequencyChannel channel{kHubAngle, {1.0}, {1.0}, {1.0}};
  EXPECT_THROW(format_frequency_record({{channel, channel}}), arm::InputError);
}

TEST(FrequencyRecord, BytesAtRandomGiveARecordOrOneLine) {
  const std::string good =
      kFrequencyHead +
      "0.5,hub_angle,-2,+0.25,0.99\n# x\n1,hub_angle,\"-1\",1e-3,\n0,strain@0.05,1,0,1\n";
  expect_result_or_one_line(good,
                            [](const std::string& text) { parse_frequency_record(text, "f"); });
}

const std::vector<Mistake> kFrequencyRecordMistakes = {
    {"Empty", "", "1: empty; the header is frequency [Hz],sensor,re,im,coherence"},
    {"OnlyAHeader", kFrequencyHead, "1: only a header; must have one row or more"},
    {"Semicolons", "frequency [Hz];sensor\n",
     "1: cells must be separated by commas, and numbers have a decimal point"},
    {"UnitMissing", "frequency,sensor,re,im\n",
     "1: column frequency: unknown (did you mean frequency [Hz]?); allowed: frequency [Hz], "
     "sensor, re, im, coherence, input"},
    {"ColumnMisspelt", "frequency [Hz],sensor,re,im,coherense\n",
     "1: column coherense: unknown (did you mean coherence?); allowed: frequency [Hz], sensor, re, "
     "im, coherence, input"},
    {"ColumnMissing", "frequency [Hz],sensor,re\n",
     "1: column im: missing; the header is frequency [Hz],sensor,re,im,coherence"},
    {"ColumnTwice", "re,re\n", "1: column re: given twice"},
    {"CellMissing", kFrequencyHead + "1,hub_angle,1,0\n",
     "2: 4 cells; the header has 5 (numbers have a decimal point)"},
    {"SensorMisspelt", kFrequencyHead + "1,hub_angel,1,0,1\n",
     "2: sensor hub_angel: unknown (did you mean hub_angle?); allowed: hub_angle, hub_velocity, "
     "tip_acceleration, tip_displacement, tip_deflection, strain@X (X in metres from the hub)"},
    {"FrequencyNegative", kFrequencyHead + "-1,hub_angle,1,0,1\n",
     "2: frequency [Hz] = -1: must be a finite number, 0 or more"},
    {"ResponseInfinite", kFrequencyHead + "1,hub_angle,1,inf,1\n",
     "2: im = inf: must be a finite number"},
    {"CoherenceZero", kFrequencyHead + "1,hub_angle,1,0,0\n",
     "2: coherence = 0: must be above 0 and 1 or less, or empty"},
    {"CoherenceAboveOne", kFrequencyHead + "1,hub_angle,1,0,1.01\n",
     "2: coherence = 1.01: must be above 0 and 1 or less, or empty"},
    {"FrequencyTwice",
     kFrequencyHead + "1,hub_angle,1,0,1\n1,strain@0.1,1,0,1\n1,hub_angle,2,0,1\n",
     "4: frequency [Hz] = 1: again the one before of hub_angle; must be strictly increasing per "
     "sensor"},
    {"FrequencyBelow", kFrequencyHead + "2,hub_angle,1,0,1\n1,hub_angle,2,0,1\n",
     "3: frequency [Hz] = 1: below the one before of hub_angle; must be strictly increasing per "
     "sensor"},
};

class FrequencyRecordMistake : public testing::TestWithParam<Mistake> {};

TEST_P(FrequencyRecordMistake, GivesOneLineWithPlaceReasonAndRemedy) {
  expect_line(GetParam(), "run.csv", parse_frequency_record);
}

INSTANTIATE_TEST_SUITE_P(, FrequencyRecordMistake, testing::ValuesIn(kFrequencyRecordMistakes),
                         name_of_mistake);

TEST(FrequencyRecord, MoreSensorsThanATableHasColumnsAreRefusedWithTheirLine) {
  std::string csv = "frequency [Hz],sensor,re,im\n";
  for (int i = 0; i < 4097; ++i) csv += fmt::format("1,strain@{},1,0\n", 1e-6 * i);
  try {
    parse_frequency_record(csv, "run.csv");
    FAIL() << "accepted";
  } catch (const arm::InputError& error) {
    EXPECT_STREQ(error.what(), "run.csv:4098: more than 4096 sensors");
  }
}

}  // namespace
}  // namespace flexarm::measured
