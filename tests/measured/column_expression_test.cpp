#include "measured/files/column_expression.hpp"

#include "arm/input_error.hpp"
#include "measured/files/column_mapping.hpp"
#include "measured/files/measurement.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace flexarm::measured {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

ForeignTable log_table() {
  return parse_foreign_table(
      "t,V,omega,Output Voltage (V),\"data(:,1)\",Hub Angle [rad],s.f\n"
      "0,1,2,3,4,5,6\n0.5,2,-1,0.5,8,7,1\n1.5,0,0.25,-3,2,1,1\n",
      "log");
}

std::vector<double> value_of(const std::string& expression) {
  const ForeignTable table = log_table();
  return evaluate_expression(expression, table, table.columns[0].values);
}

TEST(ColumnExpression, TakesColumnsByBareNamesBracketsAndNumbers) {
  EXPECT_THAT(value_of("0.1574*(V - 0.518*omega)"),
              ElementsAre(0.1574 * (1.0 - 0.518 * 2.0), 0.1574 * (2.0 + 0.518),
                          0.1574 * (0.0 - 0.518 * 0.25)));
  EXPECT_THAT(value_of("[Output Voltage (V)] + [data(:,1)]"), ElementsAre(7.0, 8.5, -1.0));
  EXPECT_THAT(value_of("[ Hub Angle [rad] ]"), ElementsAre(5.0, 7.0, 1.0));
  EXPECT_THAT(value_of("[Output Voltage]*s.f"), ElementsAre(18.0, 0.5, -3.0));
  EXPECT_THAT(value_of("[#3] - [3]"), ElementsAre(0.0, 0.0, 0.0));
}

TEST(ColumnExpression, HasTheOrdinaryRulesOfArithmetic) {
  EXPECT_THAT(value_of("-V^2 + 1e-1*2.5e+1"), ElementsAre(1.5, -1.5, 2.5));
  EXPECT_THAT(value_of("V > 0 ? sin(pi/2) : -abs(omega)"), ElementsAre(1.0, 1.0, -0.25));
  EXPECT_THAT(value_of("max(V, omega) >= 2"), ElementsAre(1.0, 1.0, 0.0));
  EXPECT_THAT(value_of("3"), ElementsAre(3.0, 3.0, 3.0));
}

/// Central differences are exact for a parabola on an even grid, and one-sided at the ends.
TEST(ColumnExpression, TheRateIsThatOfCentralDifferences) {
  const auto table = parse_foreign_table("t,x\n0,0\n2,4\n4,16\n6,36\n", "log");
  EXPECT_THAT(evaluate_expression("ddt(x)", table, table.columns[0].values),
              ElementsAre(2.0, 4.0, 8.0, 10.0));
  EXPECT_THAT(evaluate_expression("x - ddt( [#2] )", table, table.columns[0].values),
              ElementsAre(-2.0, 0.0, 8.0, 26.0));
}

TEST(ColumnExpression, AnEmptyCellGivesNoNumber) {
  const auto table = parse_foreign_table("t,x,y\n0,0,1\n1,,1\n2,1,1\n", "log");
  EXPECT_TRUE(std::isnan(evaluate_expression("2*x", table, {})[1]));
}

TEST(ColumnExpression, NamesTheColumnsThatItTakes) {
  const std::vector<std::string> names = {"t", "V", "omega (rad/s)"};
  EXPECT_THAT(columns_in("omega*V + V", names), ElementsAre(1U, 2U));
  EXPECT_THAT(columns_in("ddt(omega)", names), ElementsAre(2U));
}

std::string refusal(const std::string& expression) {
  try {
    value_of(expression);
  } catch (const arm::InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(ColumnExpression, WhatCannotBeReadIsOneLine) {
  EXPECT_EQ(refusal("0.5*(V - omega"), "expression = 0.5*(V - omega: a parenthesis is not closed");
  EXPECT_EQ(refusal("V *"),
            "expression = V *: ends where a number, a column or a function must follow");
  EXPECT_EQ(refusal("V = 3"),
            "expression = V = 3: = at character 3: an expression assigns nothing; equality is ==");
  EXPECT_EQ(refusal("V, omega"), "expression = V, omega: has several values between commas");
  EXPECT_EQ(refusal("[V"), "expression = [V: bracket [ at character 1 is not closed");
  EXPECT_EQ(refusal("sin(V, 2, 3)"),
            "expression = sin(V, 2, 3): a function has too many arguments");
  EXPECT_EQ(refusal("omga*2"),
            "expression = omga*2: column omga: not in the file (did you mean omega?); it has t, V, "
            "omega, Output Voltage (V), data(:,1), Hub Angle [rad], s.f");
  EXPECT_THAT(refusal("[#9]"), HasSubstr("column #9: not in the file; it has t, V"));
  EXPECT_THAT(refusal("sni(V)"), HasSubstr("sni: no function (did you mean sin?); functions are "));
  EXPECT_THAT(refusal("data(:,1)"), HasSubstr("brackets, as in [data(:,1)]"));
  EXPECT_THAT(refusal("'V'"), HasSubstr("character 1 = ': not allowed"));
  EXPECT_THAT(refusal("ddt(2*V)"), HasSubstr("ddt at character 1 takes one column"));
  EXPECT_THAT(refusal("2 V"), HasSubstr("cannot be read"));
  EXPECT_NE(refusal(""), "accepted");
}

TEST(ColumnExpression, AQuantityOfARunMayBeComputed) {
  const ColumnMappings mappings = {
      {"time", {"t", "s", 1.0}},
      {"torque", {"", "N mm", 2.0, "V*omega"}},
      {"hub_velocity", {"", "deg/s", 1.0, "ddt([Hub Angle])"}},
  };
  const TimeRecord record = uneven_record_of(log_table(), mappings, "log");
  EXPECT_THAT(record.torque_N_m, ElementsAre(0.004, -0.004, 0.0));
  ASSERT_EQ(record.channels.size(), 1U);
  EXPECT_EQ(record.channels[0].values[0], 4.0 * std::numbers::pi / 180.0);
}

}  // namespace
}  // namespace flexarm::measured
