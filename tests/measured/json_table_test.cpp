#include "measured/files/json_table.hpp"

#include "arm/input_error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace flexarm::measured {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// Whether the file has the time 0, 0.1, 0.2 and the torque 1, 2, 3.
void expect_time_and_torque(const std::string& json, const std::string& path = "") {
  const JsonTable read = parse_json_table(json, "log.json");
  ASSERT_EQ(read.table.columns.size(), 2U) << json;
  EXPECT_EQ(read.table.columns[0].name, path + "time");
  EXPECT_THAT(read.table.columns[0].values, ElementsAre(0.0, 0.1, 0.2)) << json;
  EXPECT_EQ(read.table.columns[1].name, path + "torque [N m]");
  EXPECT_EQ(read.table.columns[1].unit, "N m");
  EXPECT_THAT(read.table.columns[1].values, ElementsAre(1.0, 2.0, 3.0)) << json;
}

TEST(JsonTableTest, EveryLayoutGivesTheSameColumns) {
  const std::string rows =
      R"({"time": 0, "torque [N m]": 1}, {"time": 0.1, "torque [N m]": 2}, )"
      R"({"time": 0.2, "torque [N m]": 3})";
  expect_time_and_torque("[" + rows + "]");
  expect_time_and_torque("{\"samples\": [" + rows + "]}", "samples.");
  std::string lines = rows;
  for (auto at = lines.find("}, "); at != std::string::npos; at = lines.find("}, ")) {
    lines.replace(at, 3, "}\r\n");
  }
  expect_time_and_torque(lines + "\n{\"time\": 0.3, \"tor");
  expect_time_and_torque(R"({"time": [0, 0.1, 0.2], "torque [N m]": [1, 2, 3]})");
  expect_time_and_torque(R"({"time": ["0", "0.1", "0.2"], "torque [N m]": ["1", "2", "3"]})");
  expect_time_and_torque(
      R"({"columns": ["time", "torque [N m]"], "index": [0, 1, 2], )"
      R"("data": [[0, 1], [0.1, 2], [0.2, 3]]})");
  expect_time_and_torque(
      R"({"time": {"0": 0, "1": 0.1, "2": 0.2}, "torque [N m]": {"0": 1, "1": 2, "2": 3}})");
  expect_time_and_torque(
      R"({"0": {"time": 0, "torque [N m]": 1}, "1": {"time": 0.1, "torque [N m]": 2}, )"
      R"("2": {"time": 0.2, "torque [N m]": 3}})");
  expect_time_and_torque(R"([["time", "torque [N m]"], [0, 1], [0.1, 2], [0.2, 3]])");
}

TEST(JsonTableTest, WhatASampleLacksIsAnEmptyCell) {
    const auto read =
        parse_json_table(R"([{"t": 0, "a": NaN}, {"t": 1}, {"t": 2, "a": 5, "b": null}])", "f");
    ASSERT_EQ(read.table.columns.size(), 3U);
    const auto& a = read.table.columns[1].values;
    ASSERT_EQ(a.size(), 3U);
    EXPECT_TRUE(std::isnan(a[0]));
    EXPECT_TRUE(std::isnan(a[1]));
    EXPECT_EQ(a[2], 5.0);
    EXPECT_EQ(read.table.columns[2].values.size(), 3U);
  }

  TEST(JsonTableTest, ObjectsWithinObjectsHaveTheirPathAndTextIsNoNumber) {
    const auto read = parse_json_table(
        R"({"fs": 250, "log": {"t": [0, 1], "hub": {"theta": [3, 4]}, "mode": ["up", "down"]}})",
        "f");
    ASSERT_EQ(read.table.columns.size(), 3U);
    EXPECT_EQ(read.table.columns[1].name, "log.hub.theta");
    EXPECT_TRUE(read.table.columns[2].is_text());
    EXPECT_THAT(read.left_out, ElementsAre("fs: a single value"));
  }

  TEST(JsonTableTest, NaNWithinATextStays) {
    const auto read = parse_json_table(R"([{"t": 0, "s": "NaN \" NaN"}, {"t": 1, "s": "b"}])", "f");
    EXPECT_EQ(read.table.columns[1].texts[0], "NaN \" NaN");
  }

  TEST(JsonTableTest, WhatIsNoTableIsRefusedInOneLine) {
    const auto refusal = [](const char* json) {
      try {
        parse_json_table(json, "a.json");
      } catch (const arm::InputError& error) {
        return std::string(error.what());
      }
      return std::string();
    };
    EXPECT_THAT(refusal("{\"a\": [1, 2}"), HasSubstr("a.json: not JSON"));
    EXPECT_THAT(refusal("{\"a\": 1}"), HasSubstr("a.json: JSON without lists of numbers"));
    EXPECT_THAT(refusal("[1e999, 1]"), HasSubstr("a.json: JSON with a number above 1e308"));
  }

  TEST(JsonTableTest, IsToldFromTomlAndLinesOfUnits) {
    EXPECT_TRUE(is_json(" [[1, 2], [3, 4]]"));
    EXPECT_TRUE(is_json("{\"a\": [1]}"));
    EXPECT_FALSE(is_json("[[run]]\nid = \"a\""));
    EXPECT_FALSE(is_json("[beam]\nlength = 1"));
    EXPECT_FALSE(is_json("[s];[Nm]\n0;1"));
  }

  }  // namespace
  }  // namespace flexarm::measured
