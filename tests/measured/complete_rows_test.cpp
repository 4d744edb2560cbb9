#include "measured/files/complete_rows.hpp"

#include "arm/input_error.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace flexarm::measured {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const ColumnMappings kMappings = {
    {"time", {"t", "s", 1.0}}, {"torque", {"u", "N m", 1.0}}, {"hub_angle", {"y", "rad", 1.0}}};

CompleteRows keep(ForeignTable& table, const OwnRates& rates = {},
                  const ColumnMapping* reference = nullptr,
                  const ColumnMappings& mappings = kMappings) {
  return keep_complete_rows(table, mappings, reference, rates);
}

std::string refused_rows(const std::string& text, const OwnRates& rates = {}) {
  try {
    auto table = parse_foreign_table(text, "log");
    keep(table, rates);
  } catch (const arm::InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(CompleteRows, ARowWithAnEmptyCellIsNone) {
  auto table = parse_foreign_table(
      "t,u,y,spare\n0,1,2,\n1,NaN,3,\n2,1,,\n,1,5,\n4,1,6,\n5,1,N/A,\n6,1,8,\n7,1,9,\n", "log");
  const auto kept = keep(table);
  EXPECT_THAT(kept.rows, ElementsAre(0, 4, 6, 7));
  EXPECT_EQ(kept.rows_in_file, 8U);
  EXPECT_FALSE(kept.is_driven_before);
  EXPECT_THAT(table.columns[2].values, ElementsAre(2.0, 6.0, 8.0, 9.0));
  EXPECT_THAT(table.line_of_row, ElementsAre(2, 6, 8, 9));
  EXPECT_THAT(kept.notes,
              ElementsAre("4 of 8 rows left out, as missing samples: a cell is empty or "
                          "no number (first of u in line 3)"));
}

TEST(CompleteRows, ColumnsThatAreNotUsedDoNotMatter) {
  auto table = parse_foreign_table("t,u,y,spare\n0,1,2,\n1,1,3,1\n2,1,4,\n", "log");
  EXPECT_EQ(keep(table).rows.size(), 3U);
}

TEST(CompleteRows, OverRangeIsNoNumber) {
  auto table = parse_foreign_table("t,u,y\n0,1,2\n1,9.9E+37,3\n2,1,-9.99999E37\n3,1,4\n", "log");
  const auto kept = keep(table);
  EXPECT_THAT(kept.rows, ElementsAre(0, 3));
  EXPECT_THAT(kept.notes, testing::Contains(HasSubstr("1 cell of column u with 9.9e+37, an")));
  auto large = parse_foreign_table("t,u,y\n0,1,2\n1,3e202,3\n2,1,4\n", "log");
  EXPECT_THAT(keep(large).rows, ElementsAre(0, 1, 2));
  auto beyond = parse_foreign_table("t,u,y\n0,1,2\n1,1,OVLD\n2,1,inf\n3,1,4\n4,1,5\n", "log");
  const auto kept_within = keep(beyond);
  EXPECT_THAT(kept_within.rows, ElementsAre(0, 3, 4));
  EXPECT_THAT(kept_within.notes, testing::Contains(HasSubstr("2 cells of column y with inf, an")));
  for (const char* largest :
       {"3.4028235e38", "-3.40282e+38", "1.7976931348623157e308", "-1.79769e+308"}) {
    auto of_a_type =
        parse_foreign_table(fmt::format("t,u,y\n0,1,2\n1,{},3\n2,1,4\n3,1,5\n", largest), "log");
    EXPECT_THAT(keep(of_a_type).rows, ElementsAre(0, 2, 3)) << largest;
  }
}

std::vector<std::string> warnings_of(const std::string& text) {
  auto table = parse_foreign_table(text, "log");
  return keep(table).warnings;
}

TEST(CompleteRows, SignsOfMissingSamplesFarOutsideAreDoubted) {
  EXPECT_THAT(warnings_of("t,u,y\n0,1,2\n1,-9999,3\n2,2,4\n3,-9999,5\n"),
              ElementsAre("torque: 2 cells of column u are -9999, the others lie from 1 to 2; if "
                          "-9999 stands for a missing sample, empty these cells"));
  EXPECT_THAT(warnings_of("t,u,y\n0,1,2\n1,1,-32768\n2,1,4\n"),
              ElementsAre(HasSubstr("hub_angle: 1 cell of column y is -32768")));
  EXPECT_THAT(warnings_of("t,u,y\n0,1,2\n1,1,-1e37\n2,1,1e37\n3,1,4\n"),
              ElementsAre(HasSubstr("column y is -1e+37, the others lie from 2 to 4"),
                          HasSubstr("column y is 1e+37, the others lie from 2 to 4")));
  EXPECT_THAT(warnings_of("t,u,y\n0,0.1,2\n1,8388607,3\n2,-0.1,4\n"),
              ElementsAre(HasSubstr("torque: 1 cell of column u is 8388607")));
  // Counts, and a column of one number.
  EXPECT_THAT(warnings_of("t,u,y\n0,1,0\n1,1,20000\n2,1,32767\n"), testing::IsEmpty());
  EXPECT_THAT(warnings_of("t,u,y\n0,999,0\n1,999,1\n2,999,0\n"), testing::IsEmpty());
}

TEST(CompleteRows, ATorqueBeforeTheFirstCompleteRowIsKnown) {
  auto at_rest = parse_foreign_table("t,u,y\n0,0,\n1,1,3\n2,1,4\n3,1,4\n", "log");
  EXPECT_FALSE(keep(at_rest).is_driven_before);
  auto driven = parse_foreign_table("t,u,y\n0,0.5,\n1,1,3\n2,1,4\n3,1,4\n", "log");
  EXPECT_TRUE(keep(driven).is_driven_before);
}

/// A torque in every fourth row.
std::string sparse_log(int rows) {
  std::string text = "t,u,y\n";
  for (int k = 0; k < rows; ++k) {
    text += fmt::format("{},{},{}\n", 0.25 * k, k % 4 == 0 ? fmt::format("{}", k) : "", k);
  }
  return text;
}

TEST(CompleteRows, AColumnOfItsOwnRateAsksForWhatStandsBetween) {
  EXPECT_EQ(refused_rows(sparse_log(20)),
            "torque: column u has a number in one of 4 rows alone, written at its own rate; state "
            "what stands between with --own-rate torque=hold (the number above), torque=linear, or "
            "torque=rows (only the rows that have all numbers)");
  auto held = parse_foreign_table(sparse_log(9), "log");
  EXPECT_EQ(keep(held, {{"torque", Between::hold}}).rows.size(), 9U);
  EXPECT_THAT(held.columns[1].values, ElementsAre(0, 0, 0, 0, 4, 4, 4, 4, 8));
  auto line = parse_foreign_table(sparse_log(10), "log");
  EXPECT_EQ(keep(line, {{"torque", Between::linear}}).rows.size(), 9U);  // none behind the last
  EXPECT_THAT(line.columns[1].values, ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 8));
  auto rows = parse_foreign_table(sparse_log(9), "log");
  EXPECT_THAT(keep(rows, {{"torque", Between::rows}}).rows, ElementsAre(0, 4, 8));
}

TEST(CompleteRows, TheEvenGridOfAllRowsIsKept) {
  const auto period_of = [](const char* text, const OwnRates& rates = {}) {
    auto table = parse_foreign_table(text, "log");
    return keep(table, rates).period;
  };
  const char* one_of_three = "t,u,y\n0,1,2\n2,1,2\n4,,2\n6,1,2\n8,1,2\n10,,2\n12,1,2\n";
  EXPECT_EQ(period_of(one_of_three), 2.0);
  EXPECT_EQ(period_of(one_of_three, {{"torque", Between::rows}}), std::nullopt);
  EXPECT_EQ(period_of("t,u,y\n0,1,2\n2,,2\n4,1,2\n6,1,2\n"), 2.0);
  // Other rows are of something else, or the clock is uneven.
  EXPECT_EQ(period_of("t,u,y\n0,1,2\n1,,\n2,1,3\n3,,\n4,1,\n5,,\n6,1,5\n"), 2.0);
  EXPECT_EQ(period_of("t,u,y\n0,1,2\n2,,2\n7,1,2\n8,1,2\n"), std::nullopt);
  EXPECT_EQ(period_of("t,u,y\n0,1,2\n2,1,2\n4,1,2\n"), std::nullopt);
}

/// All columns have their numbers in the same rows: other rows are of something else.
TEST(CompleteRows, RowsWithoutAnyNumberAreNoRate) {
  auto table = parse_foreign_table("t,u,y\n0,1,2\n1,,\n2,1,3\n3,,\n4,1,4\n5,,\n6,1,5\n", "log");
  EXPECT_THAT(keep(table).rows, ElementsAre(0, 2, 4, 6));
}

TEST(CompleteRows, AReferenceAndExpressionsTakeColumnsToo) {
  auto table = parse_foreign_table("t,u,y,r,v\n0,1,2,1,1\n1,1,3,,1\n2,1,4,1,\n3,1,5,1,1\n", "log");
  const ColumnMapping reference{"r", "rad", 1.0};
  auto mappings = kMappings;
  mappings["hub_velocity"] = {"", "rad/s", 1.0, "2*v"};
  EXPECT_THAT(keep(table, {}, &reference, mappings).rows, ElementsAre(0, 3));
}

TEST(CompleteRows, WhatHasNoNumberIsSaid) {
  EXPECT_EQ(refused_rows("t,u,y\n0,1,\n1,1,\n2,1,\n"),
            "hub_angle: column y has no number in any row; take another one");
  EXPECT_EQ(refused_rows("t,u,y\n0,1,\n1,,2\n2,1,\n3,,3\n",
                         {{"torque", Between::rows}, {"hub_angle", Between::rows}}),
            "no row has a number in each of the columns y, t, u");
  EXPECT_THAT(refused_rows("t,u,y\n0,1,1\n1,1,2\n", {{"tip_deflection", Between::hold}}),
              HasSubstr("--own-rate tip_deflection: no column of the file is this"));
}

}  // namespace
}  // namespace flexarm::measured
