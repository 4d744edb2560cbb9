// Tables with a row for each value of a signal.
#include "measured/files/long_table.hpp"

#include "arm/input_error.hpp"
#include "measured/files/column_guess.hpp"
#include "measured/files/json_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace flexarm::measured {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsNan;

ForeignTable table_of(const std::string& text) {
  return without_long_form(is_json(text) ? parse_json_table(text, "long.json").table
                                         : parse_foreign_table(text, "long.csv"));
}

TEST(LongTable, EachSignalBecomesAColumn) {
  for (const std::string text :
       {"time "
        "[s],signal,value\n0,tau,1\n0,theta,4\n0.1,tau,2\n0.1,theta,5\n0.2,tau,3\n0.2,theta,6\n",
        "t,name,y,comment\n0,tau,1,a\n0.1,tau,2,a\n0.2,tau,3,b\n0.2,theta,6,b\n0.1,theta,5,b\n"
        "0,theta,4,b\n",
        "t;channel;value;unit\n0;tau;1;N m\n0;theta;4;rad\n0,1;tau;2;N m\n0,1;theta;5;rad\n"
        "0,2;tau;3;N m\n0,2;theta;6;rad\n",
        "_time,_field,_value\n2024-03-01T12:00:00.0Z,tau,1\n2024-03-01T12:00:00.1Z,tau,2\n"
        "2024-03-01T12:00:00.2Z,tau,3\n2024-03-01T12:00:00.0Z,theta,4\n"
        "2024-03-01T12:00:00.1Z,theta,5\n2024-03-01T12:00:00.2Z,theta,6\n",
        R"([{"time": 0, "signal": "tau", "value": 1}, {"time": 0, "signal": "theta", "value": 4},
            {"time": 0.1, "signal": "tau", "value": 2}, {"time": 0.1, "signal": "theta", "value": 5},
            {"time": 0.2, "signal": "tau", "value": 3},
            {"time": 0.2, "signal": "theta", "value": 6}])",
        R"({"samples": [{"t": 0, "channel": "tau", "value": 1, "unit": "N m"},
            {"t": 0, "channel": "theta", "value": 4, "unit": "rad"},
            {"t": 0.1, "channel": "tau", "value": 2, "unit": "N m"},
            {"t": 0.1, "channel": "theta", "value": 5, "unit": "rad"},
            {"t": 0.2, "channel": "tau", "value": 3, "unit": "N m"},
            {"t": 0.2, "channel": "theta", "value": 6, "unit": "rad"}]})"}) {
    const ForeignTable table = table_of(text);
    ASSERT_EQ(table.columns.size(), 3U) << text;
    const auto guess = guess_columns(labels_of(table), {});
    EXPECT_EQ(guess.mappings.at("time").name, table.columns[0].name) << text;
    EXPECT_EQ(guess.mappings.at("torque").name, "tau") << text;
    EXPECT_EQ(guess.mappings.at("hub_angle").name, "theta") << text;
    EXPECT_THAT(table.columns[0].values, ElementsAre(0.0, 0.1, 0.2)) << text;
    EXPECT_THAT(table.columns[1].values, ElementsAre(1.0, 2.0, 3.0)) << text;
    EXPECT_THAT(table.columns[2].values, ElementsAre(4.0, 5.0, 6.0)) << text;
    EXPECT_THAT(table.assumptions.back(), HasSubstr("are taken as columns: tau, theta"));
  }
}

TEST(LongTable, ASignalWithoutAValueHasAnEmptyCell) {
  const auto table = table_of(
      "t,signal,value,unit\n0,tau,1,N m\n0,theta,4,deg\n1,tau,2,N m\n2,tau,,N m\n2,theta,6,deg\n");
  EXPECT_THAT(table.columns[0].values, ElementsAre(0.0, 1.0, 2.0));
  EXPECT_THAT(table.columns[1].values, ElementsAre(1.0, 2.0, IsNan()));
  EXPECT_THAT(table.columns[2].values, ElementsAre(4.0, IsNan(), 6.0));
  EXPECT_EQ(table.columns[1].unit, "N m");
  EXPECT_EQ(table.columns[2].unit, "deg");
  EXPECT_THAT(table.line_of_row, ElementsAre(2, 4, 5));
  const auto named =
      table_of("t,signal,value\n0,tau [Nm],1\n1,tau [Nm],2\n0,a (deg),3\n1,a (deg),4\n");
  EXPECT_EQ(named.columns[1].unit, "N m");
  EXPECT_EQ(named.columns[2].unit, "deg");
  const auto of_values = table_of("t,signal,value [deg]\n0,a,1\n0,b,1\n1,a,2\n1,b,2\n");
  EXPECT_EQ(of_values.columns[1].unit, "deg");
}

TEST(LongTable, NumbersOfChannelsAreNames) {
  for (const std::string text :
       {"t,channel,value\n0,1,1\n0,12,4\n1,1,2\n1,12,5\n2,1,3\n2,12,6\n",
        R"({"a": [{"t": 0, "channel": 1, "value": 1}, {"t": 0, "channel": 12, "value": 4},
                  {"t": 1, "channel": 1, "value": 2}, {"t": 1, "channel": 12, "value": 5}]})"}) {
    const auto table = table_of(text);
    ASSERT_EQ(table.columns.size(), 3U) << text;
    EXPECT_EQ(table.columns[1].name, "channel 1");
    EXPECT_EQ(table.columns[2].name, "channel 12");
    EXPECT_EQ(table.columns[2].values[1], 5.0);
  }
}

TEST(LongTable, WhatContradictsItselfIsRefused) {
  const auto refusal = [](const std::string& text) {
    try {
      table_of(text);
    } catch (const arm::InputError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_EQ(refusal("t,signal,value\n0,a,1\n0,b,1\n1,a,2\n1,a,3\n1,b,2\n"),
            "a: a second value at t = 1 in line 5; must have one at a time");
  EXPECT_EQ(refusal("t,signal,value,unit\n0,a,1,rad\n0,b,1,m\n1,a,2,deg\n1,b,2,m\n"),
            "a: in rad, and in deg in line 4; must be in one unit");
}

TEST(LongTable, OtherTablesStayAsTheyAre) {
  for (const auto* text :
       {"t,tau,theta\n0,1,2\n1,1,2\n", "t,mode,value\n0,up,1\n1,down,2\n2,down,2\n",
        "t,channel,value\n0,1,1\n1,2,2\n2,2,2\n", "t,name,value\n0,a,1\n1,b,2\n2,c,2\n",
        "x,signal,value\n0,a,1\n1,a,2\n0,b,2\n1,b,2\n",
        "sensor,feature,order,frequency [Hz]\nhub_angle,pole,1,2\nhub_angle,zero,1,3\n"}) {
    const auto table = parse_foreign_table(text, "log");
    const auto same = without_long_form(table);
    EXPECT_EQ(same.columns.size(), table.columns.size()) << text;
    EXPECT_EQ(same.columns[0].values, table.columns[0].values) << text;
  }
}

}  // namespace
}  // namespace flexarm::measured
