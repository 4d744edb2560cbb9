#include "arm/decimal_comma.hpp"

#include "arm/input_error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace flexarm::arm {
namespace {

using testing::ElementsAre;

std::string refusal_of_list(const std::string& text) {
  try {
    number_list(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(NumberList, SeparatesAtCommas) {
  EXPECT_THAT(number_list("0.05"), ElementsAre(0.05));
  EXPECT_THAT(number_list("0,0.05,0.2"), ElementsAre(0.0, 0.05, 0.2));
  EXPECT_THAT(number_list("0,5,10"), ElementsAre(0.0, 5.0, 10.0));
  EXPECT_THAT(number_list("0.0,5.0"), ElementsAre(0.0, 5.0));
  EXPECT_THAT(number_list("0.3,1"), ElementsAre(0.3, 1.0));
  EXPECT_THAT(number_list("1e-3,2e-3"), ElementsAre(1e-3, 2e-3));
  EXPECT_THAT(number_list("-1,-5"), ElementsAre(-1.0, -5.0));
}

TEST(NumberList, RefusesWhatMayBeADecimalComma) {
  EXPECT_EQ(refusal_of_list("0,05"), "0,05: one number, or two? Write 0.05 or 0.0,5.0");
  EXPECT_EQ(refusal_of_list("1,5"), "1,5: one number, or two? Write 1.5 or 1.0,5.0");
  EXPECT_EQ(refusal_of_list("-0,5"), "-0,5: one number, or two? Write -0.5 or -0.0,5.0");
  EXPECT_EQ(refusal_of_list("0,1e-3"), "0,1e-3: one number, or two? Write 0.1e-3 or 0.0,0.001");
  EXPECT_EQ(refusal_of_list("0,05,0,2"),
            "0,05,0,2: 0,05 is 0.05, or two numbers of the list? Write a decimal point, or 5 for "
            "05");
  // A thousands separator is refused by the same rule.
  EXPECT_EQ(refusal_of_list("1,000"), "1,000: one number, or two? Write 1.000 or 1.0,0.0");
}

/// What the line says to write is read as it says.
TEST(NumberList, TakesBothReadingsAsTheRefusalWritesThem) {
  EXPECT_THAT(number_list("1.5"), ElementsAre(1.5));
  EXPECT_THAT(number_list("1.0,5.0"), ElementsAre(1.0, 5.0));
}

TEST(NumberList, RefusesWhatIsNoNumber) {
  for (const char* text : {"", "1,,2", "1,x", "0,05;0,2", "nan", "inf,1"}) {
    EXPECT_NE(refusal_of_list(text), "none") << text;
  }
  EXPECT_EQ(refusal_of_list("1,x,2"),
            "1,x,2: x is not a number; give numbers with a decimal point, separated by commas");
}

TEST(ListItems, AreWordsUnlessANumberGoesOn) {
  EXPECT_THAT(list_items("strain@0.05,hub_angle"), ElementsAre("strain@0.05", "hub_angle"));
  EXPECT_THAT(list_items("run-1,2"), ElementsAre("run-1", "2"));
  for (const auto& [typed, meant] : std::vector<std::pair<std::string, std::string>>{
           {"strain@0,05", "strain@0.05"}, {"hub_angle=0,001", "hub_angle=0.001"}}) {
    try {
      list_items(typed + ",tip_acceleration");
      FAIL() << typed;
    } catch (const InputError& error) {
      EXPECT_EQ(error.what(),
                typed + ": the comma separates items; numbers have a decimal point: " + meant);
    }
  }
}

TEST(DecimalCommaHint, StandsBesideADecimalCommaOnly) {
  EXPECT_EQ(decimal_comma_hint("8,925"), "; numbers have a decimal point: 8.925");
  EXPECT_EQ(decimal_comma_hint("a,b"), "");
  EXPECT_EQ(decimal_comma_hint("8.925"), "");
}

}  // namespace
}  // namespace flexarm::arm
