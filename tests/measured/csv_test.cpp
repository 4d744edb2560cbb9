#include "measured/files/csv.hpp"

#include "arm/input_error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace flexarm::measured {
namespace {

using testing::ElementsAre;

TEST(Csv, CellsAreTrimmedAndEmptyOnesKept) {
  const auto rows = parse_csv(" a ,b\tc,,\" d \"\n,\n", "f");
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_THAT(rows[0].cells, ElementsAre("a", "b\tc", "", " d "));
  EXPECT_THAT(rows[1].cells, ElementsAre("", ""));
}

TEST(Csv, QuotedCellsHoldCommasQuotesAndLineEnds) {
  const auto rows = parse_csv("\"a,b\",\"say \"\"x\"\"\",\"two\nlines\" ,c\nd\n", "f");
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_THAT(rows[0].cells, ElementsAre("a,b", "say \"x\"", "two\nlines", "c"));
  EXPECT_EQ(rows[1].line, 3);
}

TEST(Csv, BlankLinesCommentsAndTheByteOrderMarkAreNoRows) {
  const auto rows = parse_csv("\xef\xbb\xbf# bench\r\n\r\na,b\r\n  # c\r\n \t\r\n1,2", "f");
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_THAT(rows[0].cells, ElementsAre("a", "b"));
  EXPECT_EQ(rows[0].line, 3);
  EXPECT_THAT(rows[1].cells, ElementsAre("1", "2"));
  EXPECT_EQ(rows[1].line, 6);
  EXPECT_TRUE(parse_csv("", "f").empty());
}

TEST(Csv, LinesMayEndInCarriageReturnsAlone) {
  const auto rows = parse_csv("a\rb\r", "f");
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[1].line, 2);
}

TEST(Csv, QuotesThatDoNotMatchAreLocated) {
  const auto error_of = [](std::string_view text) -> std::string {
    try {
      parse_csv(text, "f.csv");
    } catch (const arm::InputError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_EQ(error_of("a\n\"b\nc\n"), "f.csv:2: a quote is not closed; end the cell with \"");
  EXPECT_EQ(error_of("a\nb,\"c\" d\n"),
            "f.csv:2: text after a closing quote; write a quote within quotes twice, as \"\"");
}

TEST(Csv, MoreColumnsThanATableHasAreRefusedWithTheirLine) {
  constexpr std::size_t kCells = 300000;  // of which each would be compared with all
  const std::string wide = "a,b\n" + std::string(kCells - 1, ',') + "\n";
  try {
    parse_csv(wide, "f.csv");
    FAIL() << "accepted";
  } catch (const arm::InputError& error) {
    EXPECT_STREQ(error.what(), "f.csv:2: more than 4096 cells; a table has at most 4096 columns");
  }
  EXPECT_EQ(parse_csv(std::string(4095, ','), "f.csv")[0].cells.size(), 4096U);
}

}  // namespace
}  // namespace flexarm::measured
