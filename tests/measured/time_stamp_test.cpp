#include "measured/files/time_stamp.hpp"

#include "measured/files/foreign_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace flexarm::measured {
namespace {

using testing::Contains;
using testing::DoubleEq;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<double> seconds(const std::vector<std::string>& texts) {
  std::vector<std::optional<TimeStamp>> stamps;
  for (const auto& text : texts) stamps.push_back(parse_time_stamp(text));
  return stamped_times(stamps).seconds;
}

/// Each pair is 2.5 s apart.
TEST(TimeStamp, UsualSpellingsAreRead) {
  for (const auto& [first, second] : std::vector<std::pair<std::string, std::string>>{
           {"12:00:00", "12:00:02.5"},
           {"11:59:59.000", "12:00:01,500"},
           {"20240301T120000Z", "20240301T120002.5Z"},
           {"20240229T235959.000+0100", "20240229T230001,500"},
           {"0 days 00:00:00.002", "0 days 00:00:02.502"},
           {"23:59:59", "1 day, 0:00:01.5"},
           {"2024-03-01T12:00:00Z", "2024-03-01T12:00:02.5Z"},
           {"2024-03-01T12:00:00+01:00", "2024-03-01T12:00:02.5+0100"},
           {"2024-10-27T02:59:59+02:00", "2024-10-27T02:00:01.5+01:00"},
           {"2024/02/29 23:59:59.000", "2024/03/01 00:00:01.500"},
           {"01.03.2024 12:00:00,000", "01.03.2024 12:00:02,500"},
           {"31/03/2024 23:59:59", "01/04/2024 00:00:01.5"},
           {"03/31/2024 23:59:59", "04/01/2024 00:00:01.5"},
           {"3/1/24 11:59:59 AM", "3/1/24 12:00:01.5 PM"},
           {"12:59:59 PM", "1:00:01.5 p.m."},
           {"01-Mar-2024 12:00:00", "01-Mar-2024 12:00:02.5"},
           {"Mar 1, 2024 12:00:00", "Mar 1, 2024 12:00:02.5"},
           {"1. M\xc3\xa4rz 2024 12:00:00", "1. M\xc3\xa4rz 2024 12:00:02.5"},
           {"12:00:00:000", "12:00:02:500"},
           {"00:02.5", "00:05.0"},
           {"23:59:59.5", "00:00:02.0"},
           {"59:58.0", "00:00.5"},
           {"2024-03-01 12:00:00 UTC", "2024-03-01 12:00:02.5 UTC"}}) {
    EXPECT_THAT(seconds({first, second}), ElementsAre(0.0, 2.5)) << first;
  }
}

TEST(TimeStamp, DecimalsAreNotLost) {
  EXPECT_THAT(seconds({"2024-03-01T12:00:00.000Z", "2024-03-01T12:00:00.002Z",
                       "2024-03-01T12:00:00.123456789Z"}),
              ElementsAre(0.0, 0.002, 0.123456789));
}

TEST(TimeStamp, OtherTextsAreNone) {
  for (const auto* text : {"",
                           "12",
                           "12.5",
                           "1,234",
                           "12:30",
                           "12:00:99",
                           "99:99:99:9",
                           "2024-13-45",
                           "31.02.2024",
                           "14 May",
                           "v1.2",
                           "12:00:00 XM",
                           "OK",
                           "1e-3",
                           "a:b:c",
                           "20240301",
                           "20240301T1200",
                           "20241301T120000",
                           "20240301120000",
                           "3 dogs 12:00:00"}) {
    EXPECT_FALSE(parse_time_stamp(text).has_value()) << text;
  }
}

TEST(TimeStamp, AColumnOfClockTimesHasSeconds) {
  const auto table = parse_foreign_table(
      "Timestamp,torque [N m],hub_angle "
      "[rad]\n12:00:00.000,1,2\n12:00:00.002,,2\n\"12:00:00,004\",1,3\n",
      "log");
  EXPECT_THAT(table.columns[0].values, ElementsAre(0.0, 0.002, 0.004));
  EXPECT_EQ(table.columns[0].unit, "s");
  EXPECT_TRUE(std::isnan(table.columns[1].values[1]));
  EXPECT_THAT(table.assumptions, Contains("Timestamp is the time since 12:00:00.000"));
}

TEST(TimeStamp, ADateBesideAClockCompletesIt) {
  for (const auto* text :
       {"Date,Time,u,y\n01/03/2024,23:59:59.9,1,2\n02/03/2024,00:00:00.1,1,2\n",
        "Date Time u y\n2024-03-01 23:59:59.9 1 2\n2024-03-02 00:00:00.1 1 2\n",
        "Date Time u y\n3/1/2024 11:59:59.9 PM 1 2\n3/2/2024 12:00:00.1 AM 1 2\n"}) {
    const auto table = parse_foreign_table(text, "log");
    const auto time = std::ranges::find_if(table.columns, &ForeignColumn::is_stamp);
    ASSERT_NE(time, table.columns.end()) << text;
    EXPECT_THAT(time->values, ElementsAre(0.0, DoubleEq(0.2))) << text;
    EXPECT_THAT(table.columns.back().values, ElementsAre(2.0, 2.0)) << text;
  }
}

TEST(TimeStamp, SecondsBehindADecimalCommaAreNoColumnOfTheirOwn) {
  try {
    parse_foreign_table("Timestamp,u,y\n12:00:00,002,1,2\n12:00:00,004,1,2\n", "log");
    FAIL() << "accepted";
  } catch (const std::exception& error) {
    EXPECT_THAT(error.what(), HasSubstr("log:2: 12:00:00: time stamps with a decimal comma"));
  }
}

}  // namespace
}  // namespace flexarm::measured
