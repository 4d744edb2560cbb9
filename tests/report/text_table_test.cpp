#include "report/tables/text_table.hpp"

#include "report/utf8_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>

namespace flexarm::report {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

Table poles() {
  Table table{"Poles of the paper's arm", {{"pole"}, {"exact", "Hz"}, error_column("fem")}};
  table.add_row({1, 11.8618286444625395, 3.25e-11});
  table.add_row({2, 102.643324121179547, 0.0});
  table.add_row({10, 1.5, kNaN});
  return table;
}

TEST(TextTable, IsCaptionNamesUnitsRuleAndRowsAlignedOnTheDecimalPoint) {
  EXPECT_EQ(to_text(poles()),
            "Poles of the paper's arm\n"
            "pole      exact      fem\n"
            "           [Hz]\n"
            "------------------------\n"
            "   1   11.8618   3.2e-11\n"
            "   2  102.643    0\n"
            "  10    1.50000        -\n");
}

TEST(TextTable, TextIsLeftAlignedAndWithoutUnitsThereIsNoUnitLine) {
  Table table{"", {{"what"}, {"why"}}};
  table.add_row({"a", "long enough"});
  table.add_row({std::monostate{}, "b"});
  EXPECT_EQ(to_text(table),
            "what  why\n"
            "-----------------\n"
            "a     long enough\n"
            "-     b\n");
}

TEST(TextTable, WidthIsThatOfCharactersNotOfBytes) {
  EXPECT_EQ(display_width("plain"), 5U);
  EXPECT_EQ(display_width("λ² größer"), 9U);
  EXPECT_EQ(display_width("e\u0301"), 1U);
  EXPECT_EQ(display_width("梁"), 2U);
  EXPECT_EQ(display_width("\xff\xce"), 2U);  // not UTF-8, and a character cut short

  Table table{"", {{"Größe"}, {"λ"}}};
  table.add_row({"梁", 1.5});
  table.add_row({"beam", 2.5});
  EXPECT_EQ(to_text(table),
            "Größe        λ\n"
            "--------------\n"
            "梁     1.50000\n"
            "beam   2.50000\n");
}

TEST(TextTable, ColumnsThatDoNotFitGoBelowBehindTheKeyColumn) {
  Table table{"wide", {{"mode"}}};
  std::vector<Cell> row{1};
  for (int i = 0; i < 20; ++i) {
    table.columns.push_back({"quantity " + std::to_string(i), "Hz"});
    row.emplace_back(10.0 + i);
  }
  table.add_row(row);
  int blocks = 0;
  for (const std::string& line : lines_of(to_text(table))) {
    EXPECT_LE(display_width(line), TextOptions{}.max_width);
    blocks += line.starts_with("mode") ? 1 : 0;
  }
  EXPECT_EQ(blocks, 3);
  for (const Column& column : table.columns) {
    EXPECT_THAT(to_text(table), testing::HasSubstr(column.name));
  }
}

Table sensors() {
  Table table{"", {{"sensor"}, {"relative to signal", "%", 3}, {"whiteness"}}};
  table.add_row({"hub_angle", 0.498, "white"});
  table.add_row({"tip_acceleration", 12.0, "correlated with the torque of the past"});
  return table;
}

TEST(TextTable, NamesAreBrokenBeforeAnythingElse) {
  EXPECT_EQ(to_text(sensors(), {.max_width = 68}),
            "                  relative\n"
            "                        to\n"
            "sensor              signal  whiteness\n"
            "                       [%]\n"
            "------------------------------------------------------------------\n"
            "hub_angle            0.498  white\n"
            "tip_acceleration    12.0    correlated with the torque of the past\n");
}

TEST(TextTable, ThenTheWidestText) {
  EXPECT_EQ(to_text(sensors(), {.max_width = 52}),
            "                  relative\n"
            "                        to\n"
            "sensor              signal  whiteness\n"
            "                       [%]\n"
            "----------------------------------------------------\n"
            "hub_angle            0.498  white\n"
            "tip_acceleration    12.0    correlated with the\n"
            "                            torque of the past\n");
}

TEST(TextTable, WithoutRoomForColumnsEachCellHasALine) {
  EXPECT_EQ(to_text(sensors(), {.max_width = 24}),
            "sensor: hub_angle\n"
            "relative to signal [%]:\n"
            "  0.498\n"
            "whiteness: white\n"
            "\n"
            "sensor: tip_acceleration\n"
            "relative to signal [%]:\n"
            "  12.0\n"
            "whiteness: correlated\n"
            "  with the torque of the\n"
            "  past\n");
}

/// A table of a key and `columns` more, each six characters wide.
Table numbered(int columns) {
  Table table{"", {{"no."}}};
  std::vector<Cell> row{1};
  for (int i = 0; i < columns; ++i) {
    table.columns.push_back({"col" + std::to_string(100 + i)});
    row.emplace_back(i);
  }
  table.add_row(row);
  return table;
}

/// The numbers of columns in the blocks of a table, behind its key.
std::vector<int> columns_of_blocks(const Table& table, std::size_t max_width) {
  std::vector<int> counts;
  for (const std::string& line : lines_of(to_text(table, {.max_width = max_width}))) {
    if (!line.starts_with("no.")) continue;
    counts.push_back(0);
    for (auto at = line.find("col"); at != std::string::npos; at = line.find("col", at + 1)) {
      ++counts.back();
    }
  }
  return counts;
}

TEST(TextTable, NoColumnStandsAloneWhereItNeedNot) {
  // Beside the key there is room for four.
  constexpr std::size_t kFour = 3 + 4 * 8;
  EXPECT_EQ(columns_of_blocks(numbered(4), kFour), (std::vector<int>{4}));
  EXPECT_EQ(columns_of_blocks(numbered(5), kFour), (std::vector<int>{3, 2}));
  EXPECT_EQ(columns_of_blocks(numbered(6), kFour), (std::vector<int>{3, 3}));
  EXPECT_EQ(columns_of_blocks(numbered(9), kFour), (std::vector<int>{3, 3, 3}));
  EXPECT_EQ(columns_of_blocks(numbered(3), 3 + 2 * 8), (std::vector<int>{2, 1}));
}

TEST(TextTable, WhatQualifiesAColumnStaysBesideIt) {
  Table table = numbered(6);
  // Pairs and a single one: 0 1 | 2 3 | 4 5.
  for (const std::size_t i : {2U, 4U, 6U}) table.columns[i].joined = true;
  EXPECT_EQ(columns_of_blocks(table, 3 + 5 * 8), (std::vector<int>{4, 2}));
}

TEST(TextTable, FitsInEveryWidth) {
  Table table = sensors();
  table.caption = "A caption that is longer than a narrow terminal";
  for (int i = 0; i < 8; ++i) {
    table.columns.push_back({"a quantity", "Hz"});
    for (auto& row : table.rows) row.emplace_back(1.5 * i);
  }
  for (std::size_t width = kLeastWidth; width < 140; ++width) {
    for (const std::string& line : lines_of(to_text(table, {.max_width = width}))) {
      EXPECT_LE(display_width(line), width) << line;
    }
  }
}

TEST(TextTable, FirstRowsKeepsCaptionAndColumns) {
  const Table two = first_rows(poles(), 2);
  EXPECT_EQ(two.caption, poles().caption);
  EXPECT_EQ(two.rows.size(), 2U);
  EXPECT_EQ(to_text(first_rows(poles(), 9)), to_text(poles()));
}

TEST(TextTable, NumbersKeepTheDigitsAskedFor) {
  EXPECT_EQ(format_number(12.0, 6, Notation::general), "12.0000");
  EXPECT_EQ(format_number(123456.0, 6, Notation::general), "123456");
  EXPECT_EQ(format_number(3e7, 1, Notation::general), "3e+07");
  EXPECT_EQ(format_number(-2.0 / 3.0, 3, Notation::general), "-0.667");
  EXPECT_EQ(format_number(1.26e-13, 2, Notation::scientific), "1.3e-13");
  EXPECT_EQ(format_number(4e-9, 1, Notation::scientific), "4e-09");
  EXPECT_EQ(format_number(0.0, 2, Notation::scientific), "0");
  EXPECT_EQ(format_number(kNaN, 2, Notation::general), "-");
  EXPECT_EQ(format_number(-std::numeric_limits<double>::infinity(), 2, Notation::general), "-inf");
}

TEST(TextTable, AnEmptyTableStillShowsItsColumns) {
  EXPECT_EQ(to_text({"none found", {{"zero", "Hz"}}, {}}), "none found\nzero\n[Hz]\n----\n");
  EXPECT_EQ(to_text({"nothing", {}, {}}), "nothing\n");
}

TEST(TextTable, ARowOfTheWrongLengthIsRefused) {
  Table table{"", {{"a"}, {"b"}}};
  EXPECT_THROW(table.add_row({1}), std::invalid_argument);
}

TEST(Paragraph, BreaksAtBlanksAndIndentsWhatFollows) {
  EXPECT_EQ(to_paragraph("one two three four", 2, 9), "one two\n  three\n  four\n");
  EXPECT_EQ(to_paragraph("one two", 2, 7), "one two\n");
  EXPECT_EQ(to_paragraph("one  two\nthree", 0, 80), "one two three\n");
}

TEST(Paragraph, LeadingBlanksIndentTheFirstLine) {
  EXPECT_EQ(to_paragraph("  one two three", 4, 9), "  one two\n    three\n");
}

TEST(Paragraph, AWordThatIsTooLongStandsAlone) {
  EXPECT_EQ(to_paragraph("a abcdefgh b", 1, 4), "a\n abcdefgh\n b\n");
  EXPECT_EQ(to_paragraph("", 2, 4), "\n");
}

}  // namespace
}  // namespace flexarm::report
