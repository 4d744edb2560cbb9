#include "measured/files/labview_text.hpp"

#include "measured/files/foreign_table.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace flexarm::measured {
namespace {

using testing::Contains;
using testing::DoubleEq;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsNan;

std::string file_head(const std::string& x_columns, const std::string& more = "") {
  return "LabVIEW Measurement\t\nWriter_Version\t2\nReader_Version\t2\nSeparator\tTab\n" + more +
         "Multi_Headings\tYes\nX_Columns\t" + x_columns +
         "\nTime_Pref\tAbsolute\nDate\t2024/03/01\nTime\t12:00:00,5\n***End_of_Header***\t\n\t\n";
}

std::string segment_head(const std::string& clock, const std::string& delta = "0.250000") {
  return fmt::format(
      "Channels\t2\t\t\nSamples\t3\t3\t\nDate\t2024/03/01\t2024/03/01\t\nTime\t{0}\t{0}\t\n"
      "Y_Unit_Label\tNewton Meters\tdeg\t\nX_Dimension\tTime\tTime\t\nX0\t0.0E+0\t0.0E+0\t\n"
      "Delta_X\t{1}\t{1}\t\n***End_of_Header***\t\t\t\n",
      clock, delta);
}

const std::string kNames = "X_Value\ttorque\thub_angle\tComment\n";

std::vector<double> values(const ForeignTable& table, const std::string& name) {
  return table.columns[find_column(table, name)].values;
}

TEST(LabviewText, WithoutXValuesTimesAreThoseOfTheHead) {
  const auto table = parse_foreign_table(file_head("No", "Decimal_Separator\t,\n") +
                                             segment_head("12:00:01,5", "0,250000") + kNames +
                                             "\t0,5\t1,5\n\t1,5\t2,5\tnoted\n\t2,5\t3,5\n",
                                         "a.lvm");
  EXPECT_THAT(values(table, "X_Value"), ElementsAre(0.0, 0.25, 0.5));
  EXPECT_THAT(values(table, "torque"), ElementsAre(0.5, 1.5, 2.5));
  EXPECT_THAT(values(table, "hub_angle"), ElementsAre(1.5, 2.5, 3.5));
  EXPECT_EQ(table.columns[2].unit, "deg");
  EXPECT_EQ(table.line_of_row.front(), 23);
}

TEST(LabviewText, NumbersMayHaveAPointWhereTheClockHasAComma) {
  const auto table = parse_foreign_table(file_head("One") + segment_head("12:00:01,5") + kNames +
                                             "0.000000\t0.5\t1.5\n0.250000\t1.5\t2.5\n",
                                         "a.lvm");
  EXPECT_THAT(values(table, "torque"), ElementsAre(0.5, 1.5));
}

TEST(LabviewText, EachChannelMayHaveItsXValues) {
  const std::string head =
      "Channels\t2\t\t\t\nSamples\t3\t\t3\t\nDate\t2024/03/01\t\t2024/03/01\t\nTime\t12:00:01\t\t"
      "12:00:01\t\nY_Unit_Label\tN*m\t\trad\t\nX_Dimension\tTime\t\tTime\t\nX0\t0.0\t\t0.0\t\n"
      "Delta_X\t0.25\t\t0.25\t\n***End_of_Header***\t\t\t\t\n";
  const std::string names = "X_Value\ttorque\tX_Value\thub_angle\tComment\n";
  const auto alike = parse_foreign_table(
      file_head("Multi") + head + names + "0\t1\t0\t4\n0.25\t2\t0.25\t5\n0.5\t3\t0.5\t6\n",
      "a.lvm");
  ASSERT_EQ(alike.columns.size(), 3U);
  EXPECT_THAT(values(alike, "X_Value"), ElementsAre(0.0, 0.25, 0.5));
  EXPECT_THAT(values(alike, "hub_angle"), ElementsAre(4.0, 5.0, 6.0));
  EXPECT_EQ(alike.columns[1].unit, "N m");
  EXPECT_EQ(alike.columns[2].unit, "rad");
  const auto unlike = parse_foreign_table(
      file_head("Multi") + head + names + "0\t1\t0\t4\n0.5\t2\t0.25\t5\n\t\t0.5\t6\n", "a.lvm");
  EXPECT_THAT(values(unlike, "X_Value"), ElementsAre(0.0, 0.25, 0.5));
  EXPECT_THAT(values(unlike, "torque"), ElementsAre(1.0, IsNan(), 2.0));
  EXPECT_THAT(values(unlike, "hub_angle"), ElementsAre(4.0, 5.0, 6.0));
}

TEST(LabviewText, SegmentsFollowByTheirClock) {
  const std::string rows = "\t0\t1\n\t0\t2\n\t0\t3\n\n";
  const auto table = parse_foreign_table(file_head("No") + segment_head("12:00:01.0") + kNames +
                                             rows + segment_head("12:00:01.76") + kNames + rows +
                                             segment_head("12:00:09.0") + kNames + rows,
                                         "a.lvm");
  EXPECT_THAT(values(table, "X_Value"), ElementsAre(0.0, 0.25, 0.5, DoubleEq(0.75), DoubleEq(1.0),
                                                    DoubleEq(1.25), 8.0, 8.25, 8.5));
  EXPECT_THAT(table.assumptions, Contains("LabVIEW measurement file, 3 segments"));
  // Of one clock, they begin anew.
  const auto anew = parse_foreign_table(file_head("No") + segment_head("12:00:01.0") + kNames +
                                            rows + segment_head("12:00:01.0") + kNames + rows,
                                        "a.lvm");
  EXPECT_THAT(values(anew, "X_Value"), ElementsAre(0.0, 0.25, 0.5, 0.0, 0.25, 0.5));
}

TEST(LabviewText, ASecondFileHeadAndSpecialBlocksAreHeads) {
  const std::string special = "***Start_Special***\nGain\t3\n1\t2\t3\n***End_Special***\n";
  const std::string rows = "0\t0\t1\n0.25\t0\t2\n";
  const auto table =
      parse_foreign_table(file_head("One", special) + segment_head("12:00:01") + kNames + rows +
                              file_head("One") + segment_head("12:00:02") + special + kNames + rows,
                          "a.lvm");
  EXPECT_THAT(values(table, "hub_angle"), ElementsAre(1.0, 2.0, 1.0, 2.0));
  EXPECT_THAT(values(table, "X_Value"), ElementsAre(0.0, 0.25, 1.0, 1.25));
}

TEST(LabviewText, EmptyChannelsAndShortRowsAreEmptyCells) {
  const auto table = parse_foreign_table(file_head("One") + segment_head("12:00:01") +
                                             "X_Value\ttorque\thub_angle\tUntitled\tComment\n" +
                                             "0.00\t1\t4\t\n0.25\t2\t\t\n0.50\t3\t6\t\tlast\n",
                                         "a.lvm");
  EXPECT_THAT(values(table, "hub_angle"), ElementsAre(4.0, IsNan(), 6.0));
  EXPECT_TRUE(table.columns[find_column(table, "Untitled")].holds_nothing());
}

TEST(LabviewText, TheSeparatorInFrontMayBeMissing) {
  const auto table = parse_foreign_table(file_head("No") + segment_head("12:00:01") + kNames +
                                             "1\t4\tnoted\n2\t5\t15:49:24:.546\n3\t6\t\n",
                                         "a.lvm");
  EXPECT_THAT(values(table, "X_Value"), ElementsAre(0.0, 0.25, 0.5));
  EXPECT_THAT(values(table, "torque"), ElementsAre(1.0, 2.0, 3.0));
  EXPECT_THAT(values(table, "hub_angle"), ElementsAre(4.0, 5.0, 6.0));
}

TEST(LabviewText, CommasMaySeparate) {
  std::string text =
      file_head("One") + segment_head("12:00:01.5") + kNames + "0.0\t1.5\t4\n0.25\t2\t5\n";
  text.replace(text.find("Separator\tTab"), 13, "Separator\tComma");
  std::ranges::replace(text, '\t', ',');
  text.replace(text.find("12:00:00,5"), 10, "12:00:00.5");
  const auto table = parse_foreign_table(text, "a.lvm");
  EXPECT_THAT(values(table, "torque"), ElementsAre(1.5, 2.0));
}

TEST(LabviewText, MoreRowsThanTheHeadTellsAndARoundedPeriodAreSaid) {
  const auto table = parse_foreign_table(file_head("No") + segment_head("12:00:01", "0.000977") +
                                             kNames + "\t0\t1\n\t0\t2\n\t0\t3\n\t0\t4\n",
                                         "a.lvm");
  EXPECT_THAT(table.assumptions, Contains(HasSubstr("the head tells 3 samples, 4 rows follow")));
  EXPECT_THAT(table.assumptions, Contains(HasSubstr("may be a rounded 1/1024 s")));
}

/// The head of a segment whose X is in `unit`.
std::string head_in(const std::string& unit, const std::string& clock, const std::string& delta) {
  return fmt::format("X_Unit_Label\t{0}\t{0}\t\n", unit) + segment_head(clock, delta);
}

TEST(LabviewText, XIsInTheUnitOfItsLabel) {
  const auto table = parse_foreign_table(
      file_head("No") + head_in("ms", "12:00:01.0", "0.100000") + kNames + "\t0\t1\n\t0\t2\n" +
          head_in("ms", "12:00:02.0", "0.100000") + kNames + "\t0\t3\n\t0\t4\n",
      "a.lvm");
  EXPECT_EQ(table.columns[0].unit, "ms");
  EXPECT_THAT(values(table, "X_Value"),
              ElementsAre(0.0, DoubleEq(0.1), DoubleEq(1000.0), DoubleEq(1000.1)));
  EXPECT_THAT(table.assumptions, Contains(HasSubstr("those of X0 and Delta_X, 0.1 ms")));
  const auto of_label = [](const std::string& label) {
    return parse_foreign_table(
        file_head("One") + head_in(label, "12:00:01.0", "0.25") + kNames + "0\t0\t1\n0.25\t0\t2\n",
        "a.lvm");
  };
  EXPECT_EQ(of_label("Seconds").columns[0].unit, "s");
  const auto unknown = of_label("ticks");
  EXPECT_EQ(unknown.columns[0].unit, "s");
  EXPECT_THAT(unknown.assumptions, Contains("X_Unit_Label = ticks is no unit of time; s assumed"));
}

TEST(LabviewText, WhatCannotBeReadIsOneLine) {
  const auto refusal = [](const std::string& text) -> std::string {
    try {
      parse_foreign_table(text, "a.lvm");
    } catch (const std::exception& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(refusal(file_head("One")),
            "a.lvm:11: LabVIEW measurement file without a row of samples behind its heads");
  EXPECT_EQ(refusal(file_head("One") + segment_head("12:00:01") + kNames + "0\tabc\t1\n1\t2\t3\n"),
            "a.lvm:22: column torque = abc: must be a number");
  EXPECT_THAT(refusal(file_head("No") + kNames + "\t1\t2\n\t3\t4\n"),
              HasSubstr("no X_Value and no Delta_X above 0 to tell the times"));
}

}  // namespace
}  // namespace flexarm::measured
