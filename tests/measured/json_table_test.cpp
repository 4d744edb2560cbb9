#include "measured/files/json_table.hpp"

#include "arm/input_error.hpp"
#include "measured/files/column_guess.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace flexarm::measured {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsNan;

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
  const std::string rows = R"({"time": 0, "torque [N m]": 1}, {"time": 0.1, "torque [N m]": 2}, )"
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
  expect_time_and_torque(R"({"columns": ["time", "torque [N m]"], "index": [0, 1, 2], )"
                         R"("data": [[0, 1], [0.1, 2], [0.2, 3]]})");
  expect_time_and_torque(
      R"({"time": {"0": 0, "1": 0.1, "2": 0.2}, "torque [N m]": {"0": 1, "1": 2, "2": 3}})");
  expect_time_and_torque(
      R"({"0": {"time": 0, "torque [N m]": 1}, "1": {"time": 0.1, "torque [N m]": 2}, )"
      R"("2": {"time": 0.2, "torque [N m]": 3}})");
  expect_time_and_torque(R"([["time", "torque [N m]"], [0, 1], [0.1, 2], [0.2, 3]])");
}

std::vector<std::string> units_of(const std::string& json) {
  std::vector<std::string> units;
  for (const auto& column : parse_json_table(json, "f").table.columns) units.push_back(column.unit);
  return units;
}

std::string refusal_of(const std::string& json) {
  try {
    parse_json_table(json, "a.json");
  } catch (const arm::InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(JsonTableTest, NamedSignalsAreColumns) {
  for (const auto* json :
       {R"([{"name": "time", "unit": "s", "data": [0, 0.1, 0.2]},
            {"name": "tau", "unit": "N m", "data": [1, 2, 3]},
            {"name": "theta", "unit": "deg", "data": [4, 5, 6]}])",
        R"([{"name": "tau", "units": "Nm", "values": [1, 2, 3], "dt": 0.1},
            {"name": "theta", "units": "degrees", "values": [4, 5, 6], "dt": 0.1}])",
        R"({"rig": 3, "signals": [{"label": "tau", "y": [1, 2, 3], "y_unit": "N m"},
            {"label": "theta", "y": [4, 5, 6], "y_unit": "deg"}], "fs": 10})",
        R"([{"name": "tau", "unit": "N m", "time": [0, 0.1, 0.2], "samples": [1, 2, 3]},
            {"name": "theta", "unit": "deg", "time": [0, 0.1, 0.2], "samples": [4, 5, 6]}])",
        R"({"log": {"channels": [
            {"Name": "tau [N m]", "Data": [1, 2, 3], "fs": 10, "fs_unit": "Hz"},
            {"Name": "theta", "Unit": "deg", "Data": [4, 5, 6], "fs": 10, "fs_unit": "Hz"}]}})",
        R"([{"channel": "tau", "unit": "N m", "value": [1, 2, 3], "dt": 100, "dt_unit": "ms"},
            {"channel": "theta", "unit": "deg", "value": [4, 5, 6], "sample_rate_Hz": 10}])",
        R"({"dt": 0.1, "tau": [1, 2, 3], "theta": {"unit": "deg", "values": [4, 5, 6]}})"}) {
    const auto table = parse_json_table(json, "s.json").table;
    const auto guess = guess_columns(labels_of(table), {});
    ASSERT_TRUE(guess.mappings.contains("time")) << json;
    ASSERT_TRUE(guess.mappings.contains("torque")) << json;
    ASSERT_TRUE(guess.mappings.contains("hub_angle")) << json;
    const auto values = [&](const char* quantity) {
      return table.columns[find_column(table, guess.mappings.at(quantity).name)].values;
    };
    EXPECT_THAT(values("time"), ElementsAre(0.0, 0.1, 0.2)) << json;
    EXPECT_THAT(values("torque"), ElementsAre(1.0, 2.0, 3.0)) << json;
    EXPECT_THAT(values("hub_angle"), ElementsAre(4.0, 5.0, 6.0)) << json;
    EXPECT_EQ(guess.mappings.at("hub_angle").unit, "deg") << json;
    EXPECT_EQ(table.columns.size(), 3U) << json;
  }
  const auto in_ms = parse_json_table(
      R"([{"name": "tau", "x": [0, 100], "x_unit": "ms", "y": [1, 2], "unit": "N m"},
          {"name": "theta", "x": [0, 100], "x_unit": "ms", "y": [3, 4], "unit": "rad"}])",
      "s.json");
  ASSERT_EQ(in_ms.table.columns.size(), 3U);
  const auto& time = in_ms.table.columns[find_column(in_ms.table, "time")];
  EXPECT_THAT(time.values, ElementsAre(0.0, 100.0));
  EXPECT_EQ(time.unit, "ms");
}

TEST(JsonTableTest, SignalsThatDoNotBelongTogetherAreRefused) {
  EXPECT_THAT(refusal_of(R"([{"name": "a", "t": [0, 1], "y": [1, 2]},
                             {"name": "b", "t": [0, 2], "y": [1, 2]}])"),
              HasSubstr("a.json: signals a and b: times of their own that differ; save each in a "
                        "file of its own and join them with --join"));
  EXPECT_THAT(refusal_of(R"([{"name": "a", "data": [1, 2]}, {"name": "a", "data": [1, 2]}])"),
              HasSubstr("a.json: signal a: given twice"));
  const auto several = parse_json_table(R"([{"name": "a", "data": [1, 2], "dt": 0.1},
                                            {"name": "b", "data": [1, 2], "dt": 0.2}])",
                                        "f");
  EXPECT_EQ(several.table.columns.size(), 2U);
  EXPECT_THAT(several.table.assumptions,
              Contains("sampling periods of 0.1 s and 0.2 s are told; state one with --period"));
  // The rate of the instrument beside a frequency response makes no times.
  const auto response =
      parse_json_table(R"({"fs": 1000, "f": [1, 2], "mag": [1, 2], "phase": [3, 4]})", "f");
  EXPECT_EQ(response.table.columns.size(), 3U);
}

TEST(JsonTableTest, UnitsBesideListsAreThoseOfTheLists) {
  const auto ms_and_deg = ElementsAre("ms", "deg");
  EXPECT_THAT(units_of(R"({"t": {"unit": "ms", "values": [0, 1]},
                          "hub_angle": {"values": [3, 4], "Units": "degrees"}})"),
              ms_and_deg);
  EXPECT_THAT(units_of(R"({"units": {"t": "ms", "hub_angle": "deg"}, "t": [0, 1],
                          "hub_angle": [3, 4]})"),
              ms_and_deg);
  EXPECT_THAT(units_of(R"({"meta": {"units": {"t": "ms", "hub": {"angle": "deg"}}},
                          "data": {"t": [0, 1], "hub": {"angle": [3, 4]}}})"),
              ms_and_deg);
  EXPECT_THAT(units_of(R"({"units": ["ms", "deg"], "t": [0, 1], "hub_angle": [3, 4]})"),
              ms_and_deg);
  EXPECT_THAT(units_of(R"({"columns": ["t", "hub_angle"], "units": ["ms", "deg"],
                          "data": [[0, 3], [1, 4]]})"),
              ms_and_deg);
  EXPECT_THAT(units_of(R"({"t": [0, 1], "t_unit": "ms", "hubAngle": [3, 4],
                          "hubAngleUnit": "deg"})"),
              ms_and_deg);
  EXPECT_THAT(units_of(R"({"units": {"t": "ms", "hub_angle": "deg"},
                          "samples": [{"t": 0, "hub_angle": 3}, {"t": 1, "hub_angle": 4}]})"),
              ms_and_deg);
  EXPECT_THAT(units_of(R"([{"t [ms]": 0, "hub_angle": {"value": 3, "unit": "deg"}},
                          {"t [ms]": 1, "hub_angle": {"value": 4, "unit": "deg"}}])"),
              ms_and_deg);
}

TEST(JsonTableTest, AKeyGivenTwiceIsRefused) {
  const std::string refusal = "a.json: t: given twice in one object; must be given once";
  EXPECT_EQ(refusal_of(R"({"t": [0, 1], "y": [3, 4], "t": [0, 2]})"), refusal);
  EXPECT_EQ(refusal_of(R"([{"t": 0, "y": 3}, {"t": 1, "y": 4, "t": 2}])"), refusal);
  EXPECT_EQ(refusal_of("{\"t\": 0, \"y\": 3}\n{\"t\": 1, \"t\": 4}\n"), refusal);
  EXPECT_EQ(refusal_of(R"({"t": {"values": [0, 1]}, "y": {"values": [3, 4]}})"), "accepted");
}

TEST(JsonTableTest, ARateMayBeATextWithItsUnit) {
  const auto read = parse_json_table(
      R"({"sample_rate": "0.5 kHz", "start": "12:00:00", "tau": [1, 2], "theta": [3, 4]})",
      "a.json");
  ASSERT_EQ(read.table.columns.size(), 3U);
  EXPECT_THAT(read.table.columns[2].values, ElementsAre(0.0, 0.002));
  EXPECT_THAT(read.left_out, ElementsAre("start: a single value"));
}

TEST(JsonTableTest, AScaleBesideAListIsSaidToBeUnapplied) {
  const auto read = parse_json_table(
      R"({"tau": {"value": [1, 2], "scale": 2, "offset": 0}, "gain": 3})", "a.json");
  EXPECT_THAT(read.table.assumptions,
              ElementsAre("tau.scale = 2 is not applied to the signal beside it; if the numbers "
                          "lack it, state it as SCALE in --column"));
}

TEST(JsonTableTest, AUnitThatHasNoPlaceIsRefused) {
  EXPECT_THAT(refusal_of(R"({"unit": "deg", "hub_angle": [1, 2], "strain@0": [1, 2]})"),
              HasSubstr("a.json: unit = deg: stands beside several lists"));
  EXPECT_THAT(refusal_of(R"({"units": {"angle": "deg"}, "hub_angle": [1, 2]})"),
              HasSubstr("a.json: units.angle = deg: no list has this name"));
  EXPECT_THAT(refusal_of(R"({"hub_angle [rad]": [1, 2], "units": ["deg"]})"),
              HasSubstr("the unit of hub_angle [rad] is rad already"));
  EXPECT_THAT(refusal_of(R"({"units": ["s"], "t": [1, 2], "hub_angle": [1, 2]})"),
              HasSubstr("units: 1 units; must be one for each of the 2 lists"));
  // The unit of a single value, the name of a machine, and a machine of that key.
  EXPECT_EQ(refusal_of(R"({"units": {"length": "m"}, "length": 1, "t": [1, 2]})"), "accepted");
  EXPECT_EQ(refusal_of(R"({"unit": "B-17", "t": [1, 2], "hub_angle": [1, 2]})"), "accepted");
  EXPECT_THAT(units_of(R"({"unit": {"t": [1, 2], "hub_angle": [1, 2]}})"), ElementsAre("", ""));
}

TEST(JsonTableTest, TextsAreReadAsCellsOfATable) {
  const auto read = parse_json_table(
      R"([{"time": "2024-03-01T12:00:00.000Z", "hub_angle": 1, "torque": "+1.5"},
          {"time": "2024-03-01T12:00:00.250Z", "hub_angle": "n/a", "torque": "1.8D-03"}])",
      "f");
  EXPECT_THAT(read.table.columns[0].values, ElementsAre(0.0, 0.25));
  EXPECT_TRUE(read.table.columns[0].is_stamp);
  EXPECT_THAT(read.table.columns[1].values, ElementsAre(1.0, IsNan()));
  EXPECT_THAT(read.table.columns[2].values, ElementsAre(1.5, 1.8e-3));
  EXPECT_THAT(read.table.assumptions, Contains(HasSubstr("time is the time since")));
  EXPECT_THAT(refusal_of(R"([{"time": 0, "torque": 1}, {"time": 1, "torque": "1,234.5"}])"),
              HasSubstr("a.json: sample 2: column torque = 1,234.5: has thousands separators"));
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
