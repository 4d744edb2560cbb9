#include "measured/files/foreign_table.hpp"

#include "arm/input_error.hpp"
#include "measured/files/column_name.hpp"
#include "measured/files/unit_spelling.hpp"
#include "tests/measured/mistake.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <iterator>
#include <string>
#include <vector>

namespace flexarm::measured {
namespace {

using testing::Contains;
using testing::ElementsAre;

std::vector<std::string> names_of(const ForeignTable& table) {
  std::vector<std::string> names;
  for (const auto& column : table.columns) names.push_back(column.name);
  return names;
}

std::vector<std::string> units_of(const ForeignTable& table) {
  std::vector<std::string> units;
  for (const auto& column : table.columns) units.push_back(column.unit);
  return units;
}

/// A log in one of the ways that logs are written; each holds 0, 0.5, -1.25e-3 and 0.01, 1, 2.
struct Log {
  const char* name;
  std::string text;
  std::string separator;
  std::string decimal;
};

void PrintTo(const Log& log, std::ostream* out) {
  *out << log.name;
}

class ForeignLog : public testing::TestWithParam<Log> {};

TEST_P(ForeignLog, HasTheSameNumbers) {
  const ForeignTable table = parse_foreign_table(GetParam().text, "log");
  ASSERT_EQ(table.columns.size(), 3U);
  EXPECT_THAT(table.columns[0].values, ElementsAre(0.0, 0.01));
  EXPECT_THAT(table.columns[1].values, ElementsAre(0.5, 1.0));
  EXPECT_THAT(table.columns[2].values, ElementsAre(-1.25e-3, 2.0));
  EXPECT_THAT(table.assumptions, Contains("cells are separated by " + GetParam().separator));
  EXPECT_THAT(table.assumptions, Contains("numbers have a decimal " + GetParam().decimal));
}

INSTANTIATE_TEST_SUITE_P(
    , ForeignLog,
    testing::Values(
        Log{"Commas", "t,u,y\n0,0.5,-1.25e-3\n0.01,1,2\n", "commas", "point"},
        Log{"Semicolons", "t;u;y\n0;0.5;-1.25e-3\n0.01;1;2\n", "semicolons", "point"},
        Log{"Tabs", "t\tu\ty\n0\t0.5\t-1.25e-3\n0.01\t1\t2\n", "tabs", "point"},
        Log{"Blanks", "t u y\n  0   0.5 -1.25e-3\n 0.01 1    2  \n", "blanks", "point"},
        Log{"DecimalComma", "t;u;y\n0;0,5;-1,25e-3\n0,01;1;2\n", "semicolons", "comma"},
        Log{"TabsWithDecimalComma", "t\tu\ty\n0\t0,5\t-1,25E-3\n0,01\t1\t2\n", "tabs", "comma"},
        Log{"BlanksWithDecimalComma", "t u y\n0 0,5 -1,25e-3\n0,01 1 2\n", "blanks", "comma"},
        Log{"CarriageReturns", "t,u,y\r\n0,0.5,-1.25e-3\r\n0.01,1,2\r\n", "commas", "point"},
        Log{"OldMacintosh", "t,u,y\r0,0.5,-1.25e-3\r0.01,1,2\r", "commas", "point"},
        Log{"ByteOrderMark", "\xef\xbb\xbft,u,y\n0,0.5,-1.25e-3\n0.01,1,2", "commas", "point"},
        Log{"Preamble", "Recorder 4.1\nbench; 3 channels\n\nt,u,y\n0,0.5,-1.25e-3\n0.01,1,2\n",
            "commas", "point"},
        Log{"CommentedHeader", "# made by x\n# t u y\n0 0.5 -1.25e-3\n0.01 1 2\n", "blanks",
            "point"},
        Log{"PercentComments", "% t,u,y\n0,0.5,-1.25e-3\n% pause\n0.01,1,2\n", "commas", "point"},
        Log{"SeparatorsAtTheEnds", "t;u;y;\n0;0.5;-1.25e-3;\n0.01;1;2;\n", "semicolons", "point"},
        Log{"SeparatorsAtTheEndsOfRows", "t;u;y\n0;0.5;-1.25e-3;\n0.01;1;2;\n", "semicolons",
            "point"},
        Log{"Quotes", "\"t\",\"u, in volts\",\"y\"\n\"0\",\"0.5\",\"-1.25e-3\"\n\"0.01\",1,2\n",
            "commas", "point"},
        Log{"QuotedDecimalComma", "t,u,y\n0,\"0,5\",\"-1,25e-3\"\n\"0,01\",1,2\n", "commas",
            "comma"},
        Log{"NoHeader", "0,+0.5,-1.25e-3\n0.01,1,2\n", "commas", "point"},
        Log{"BlankLines", "t,u,y\n\n0,0.5,-1.25e-3\n\n0.01,1,2\n\n", "commas", "point"},
        Log{"LastLineCutOff", "t,u,y\n0,0.5,-1.25e-3\n0.01,1,2\n0.02,3", "commas", "point"}),
    [](const auto& log) { return std::string(log.param.name); });

std::string utf16(const std::string& ascii, bool big_endian) {
  std::string out = big_endian ? "\xfe\xff" : "\xff\xfe";
  for (const char c : ascii) {
    if (big_endian) out += '\0';
    out += c;
    if (!big_endian) out += '\0';
  }
  return out;
}

TEST(ForeignTable, Utf16IsReadInBothByteOrders) {
  for (const bool big_endian : {false, true}) {
    const auto table = parse_foreign_table(utf16("t;u\r\n0;1,5\r\n1;2\r\n", big_endian), "log");
    EXPECT_THAT(table.columns[1].values, ElementsAre(1.5, 2.0));
    EXPECT_THAT(table.assumptions, Contains("the text is UTF-16"));
  }
}

TEST(ForeignTable, NamesAndUnitsComeFromTheHeader) {
  const auto table = parse_foreign_table(
      "Time (ms);torque [N m];hub1_deg;u / V;plain\n0;1;2;3;4\n1;1;2;3;4\n", "log");
  EXPECT_THAT(names_of(table),
              ElementsAre("Time (ms)", "torque [N m]", "hub1_deg", "u / V", "plain"));
  EXPECT_THAT(units_of(table), ElementsAre("ms", "N m", "deg", "V", ""));
  EXPECT_THAT(table.assumptions, Contains("names are in line 1"));
  EXPECT_THAT(table.line_of_row, ElementsAre(2, 3));
}

TEST(ForeignTable, ASecondHeaderLineHoldsUnits) {
  const auto table = parse_foreign_table("bench\nt;u;y\n[sec];(V);\xb0/s\n0;1;2\n1;1;2\n", "log");
  EXPECT_THAT(names_of(table), ElementsAre("t", "u", "y"));
  EXPECT_THAT(units_of(table), ElementsAre("s", "V", "deg/s"));
  EXPECT_THAT(table.assumptions, Contains("units are in line 3"));
  EXPECT_THAT(table.assumptions, Contains("1 line skipped at the beginning"));
  EXPECT_THAT(table.assumptions, Contains("the text is Latin-1"));
}

TEST(ForeignTable, BetweenBlanksBracketsBelongToTheNameInFront) {
  const auto table = parse_foreign_table("Time (ms) Vm [N m]\n0 1\n1 1\n", "log");
  EXPECT_THAT(names_of(table), ElementsAre("Time (ms)", "Vm [N m]"));
}

TEST(ForeignTable, WithoutAHeaderColumnsAreCounted) {
  const auto table = parse_foreign_table("0\t1\n1\t1\n", "log");
  EXPECT_THAT(names_of(table), ElementsAre("column 1", "column 2"));
  EXPECT_THAT(table.assumptions, Contains("no header line; columns named column 1, column 2, ..."));
}

/// A header with fewer names than the rows have cells, and separators that end lines in any number.
TEST(ForeignTable, ColumnsAtTheEndNeedNoNames) {
  const auto table = parse_foreign_table("t\tu\ty\n0\t1\t2\t0\t0\t\n1\t1\t2\t0\t0\t\n", "log");
  EXPECT_THAT(names_of(table), ElementsAre("t", "u", "y", "column 4", "column 5"));
  const auto trailing = parse_foreign_table("t;u;y;;;\n0;1;2;;;\n1;1;2;;;\n", "log");
  EXPECT_THAT(names_of(trailing), ElementsAre("t", "u", "y"));
}

TEST(ForeignTable, TextAndEmptyCellsAreKeptAsSuch) {
  const auto table =
      parse_foreign_table("date,t,u,y\n14 May,0,1,\n14 May,1,2,3\n14 May,2,3,4\n", "log");
  ASSERT_EQ(table.columns.size(), 4U);
  EXPECT_THAT(table.columns[0].texts, ElementsAre("14 May", "14 May", "14 May"));
  EXPECT_TRUE(std::isnan(table.columns[3].values[0]));
  EXPECT_EQ(table.columns[3].values[1], 3.0);
}

TEST(ForeignTable, ALastLineThatIsCutOffIsSaid) {
  const auto table = parse_foreign_table("t,u,y\n0,1,2\n1,1,2\n2,1", "log");
  EXPECT_THAT(table.assumptions, Contains("last line 4 incomplete and ignored"));
}

TEST(ForeignTable, ColumnsAreFoundByName) {
  const auto table = parse_foreign_table("t,Vm\n0,1\n1,1\n", "log");
  EXPECT_EQ(find_column(table, "Vm"), 1U);
  try {
    find_column(table, "Vmm");
    FAIL() << "found";
  } catch (const arm::InputError& error) {
    EXPECT_STREQ(error.what(), "column Vmm: not in the file (did you mean Vm?); it has t, Vm");
  }
}

TEST(ColumnName, UnitsHaveOneSpelling) {
  for (const auto* unit : {"Nm", "N*m", "N-m", " N m ", "[N m]", "(N.m)", "N\xc2\xb7m"}) {
    EXPECT_EQ(canonical_unit(unit), "N m") << unit;
  }
  EXPECT_EQ(canonical_unit("mNm"), "N mm");
  EXPECT_EQ(canonical_unit("Sec"), "s");
  EXPECT_EQ(canonical_unit("\xc2\xb5s"), "us");
  EXPECT_EQ(canonical_unit("m/s\xc2\xb2"), "m/s^2");
  EXPECT_EQ(canonical_unit("furlong"), "furlong");
  EXPECT_TRUE(is_canonical_unit("V"));
  EXPECT_FALSE(is_canonical_unit("S"));
}

TEST(ColumnName, HeadersAreTakenApart) {
  const auto expect = [](const char* header, const char* base, const char* unit) {
    const ColumnName name = split_column_name(header);
    EXPECT_EQ(name.base, base) << header;
    EXPECT_EQ(name.unit, unit) << header;
  };
  expect("Time (ms)", "Time", "ms");
  expect("strain@0.05 [1]", "strain@0.05", "1");
  expect("strain(1)", "strain(1)", "");
  expect("effort[2]", "effort[2]", "");
  expect("t_s", "t", "s");
  expect("t/s", "t", "s");
  expect("hub1_deg", "hub1", "deg");
  expect("tip_acc_m_s2", "tip_acc", "m/s^2");
  expect("hub_velocity_rad_per_s", "hub_velocity", "rad/s");
  expect("i1_meas_A", "i1_meas", "A");
  expect("tip_acceleration", "tip_acceleration", "");
  expect("Vm", "Vm", "");
  expect("", "", "");
}

TEST(ForeignTable, BytesAtRandomGiveATableOrOneLine) {
  const std::string good = "bench\nTime (ms);\"u\"\n0;1,5\n1;2,5\n2;-3e-1\n";
  expect_result_or_one_line(good, [](const std::string& text) { parse_foreign_table(text, "r"); });
  expect_result_or_one_line(utf16(good, false),
                            [](const std::string& text) { parse_foreign_table(text, "r"); });
}

const std::vector<Mistake> kForeignTableMistakes = {
    {"Empty", "", "1: empty"},
    {"Prose", "Dear all,\nthe data follow.\n",
     "1: no two rows of two numbers or more; must be rows of numbers between commas, semicolons, "
     "tabs or blanks, without thousands separators"},
    {"OneColumn", "t\n0\n1\n",
     "1: no two rows of two numbers or more; must be rows of numbers between commas, semicolons, "
     "tabs or blanks, without thousands separators"},
    {"RowTooShort", "t,u,y\n0,1,2\n1,1\n2,1,2\n",
     "3: 2 cells; the rows above have 3, separated by commas"},
    {"RowTooLong", "t,u,y\n0,1,2\n1,1,2\n2,1,2,5\n",
     "4: 4 cells; the rows above have 3, separated by commas"},
    {"NoNumber", "t,u\n0,1\n1,1\n2,fault\n",
     "4: column u = fault: must be a number with a decimal point, as in the rows above"},
    {"ThousandsSeparators", "t;u\n0;1.5\n1;999.5\n2;1,000.5\n",
     "4: column u = 1,000.5: has thousands separators; write the number without them"},
    {"ThousandsSeparatorsFromTheFirstRow", "t;u;y\n0;1.000,5;0,5\n1;1.001,5;0,5\n2;1,5;0,5\n",
     "2: column u = 1.000,5: has thousands separators; write the number without them"},
    {"ThousandsApostrophes", "t;u;v\n0;1'000.5;1\n1;1'001.5;1\n",
     "2: column u = 1'000.5: has thousands separators; write the number without them"},
    {"ThousandsOfWholeNumbers", "t\tu\n0\t-512\n2\t987\n4\t-1,032\n6\t1,040\n",
     "4: column u = -1,032: has thousands separators; write the number without them"},
    {"ThousandsOfWholeNumbersWithPoints", "t;u\n0;0\n2;987\n4;1.032\n6;12.040\n",
     "4: column u = 1.032: has thousands separators; write the number without them"},
    {"QuotedThousands", "t,u,y\n0,1,5\n2,1,\"1,030\"\n4,1,\"1,042\"\n",
     "3: column y = 1,030: has thousands separators; write the number without them"},
    {"ThousandsInEachColumn", "t\tu\n0\t0\n2,000\t60,000\n4,000\t-60,000\n",
     "3: column t = 2,000: has thousands separators; write the number without them"},
    {"UnitsThatDiffer", "time,torque [N m]\ns,mNm\n0,1\n1,1\n",
     "2: column torque [N m]: in N m by its name, in N mm by the line of units; must be the same"},
    {"UnitsThatDifferAboveTheNames", "s,deg\nt_s,angle_rad\n0,1\n1,1\n",
     "1: column angle_rad: in rad by its name, in deg by the line of units; must be the same"},
    {"CommaAsSeparatorAndDecimalMark", "t,tau,theta\n0,20,0,0600,0,0065\n0,22,-0,0600,0,0070\n",
     "2: 6 cells below 3 names: the comma is both separator and decimal mark; save with "
     "semicolons, or with decimal points"},
    {"CommaAsSeparatorAndDecimalMarkOfTwoColumns", "t,u\n0,05,0,5\n0,10,-0,5\n",
     "2: 4 cells below 2 names: the comma is both separator and decimal mark; save with "
     "semicolons, or with decimal points"},
    {"TimeWithoutAName", "torque [N m],hub_angle [rad],\n0,0.1,0\n0.002,0.1,0\n0.004,0.2,0\n",
     "2: column torque [N m] increases evenly, as a time does, and the last column has no name; "
     "the header must name each column"},
    {"ThousandsOrDecimals", "t;u\n0;1,234\n1;2,345\n2;1,250\n",
     "2: column u = 1,234: may be 1234 with a thousands separator or a decimal; write 1234 or "
     "1,2340 (all such numbers of the column)"},
};

class ForeignTableMistake : public testing::TestWithParam<Mistake> {};

TEST_P(ForeignTableMistake, GivesOneLineWithPlaceReasonAndRemedy) {
  expect_line(GetParam(), "log.txt", parse_foreign_table);
}

INSTANTIATE_TEST_SUITE_P(, ForeignTableMistake, testing::ValuesIn(kForeignTableMistakes),
                         name_of_mistake);

/// Tables as R writes them have a name for each column but the first, which numbers the rows.
TEST(ForeignTable, NamesOfOneFewerThanColumnsBelongToTheLastWhereTheFirstNumbersRows) {
  for (const char* text : {"\"time\" \"u\" \"y\"\n\"1\" 0 0.5 7\n\"2\" 2 1.5 8\n\"3\" 4 0.5 9\n",
                           "time\tu\ty\n1\t0\t0.5\t7\n2\t2\t1.5\t8\n3\t4\t0.5\t9\n",
                           "time [ms],u,y\n1,0,0.5,7\n2,2,1.5,8\n3,4,0.5,9\n",
                           "time u y\n0 0 0.5 7\n1 2 1.5 8\n2 4 0.5 9\n"}) {
    const auto table = parse_foreign_table(text, "log");
    ASSERT_EQ(table.columns.size(), 4U) << text;
    EXPECT_EQ(table.columns[0].name, "column 1") << text;
    EXPECT_TRUE(is_time_column(table.columns[1])) << text;
    EXPECT_THAT(table.columns[1].values, ElementsAre(0.0, 2.0, 4.0)) << text;
    EXPECT_THAT(table.columns[3].values, ElementsAre(7.0, 8.0, 9.0)) << text;
    EXPECT_THAT(table.assumptions,
                Contains("names are those of the last columns; the first numbers the rows"));
  }
  for (const char* text : {"n,u,y\n1,0.1,0.5,7\n2,0.2,1.5,8\n3,0.4,0.5,9\n",
                           "time,u,y\n0,1,0.5,7\n0.1,2,1.5,8\n0.2,4,0.5,9\n",
                           "time,u,y,\n1,0.1,0.5,7\n2,0.2,1.5,8\n3,0.4,0.5,9\n"}) {
    EXPECT_EQ(parse_foreign_table(text, "log").columns[3].name, "column 4") << text;
  }
}

TEST(ForeignTable, QuotedNamesOfRowsAreNoFileOfOneSignal) {
  std::string text = "\"time\" \"u\" \"y\"\n";
  for (int row = 1; row <= 20; ++row) {
    text += fmt::format("\"{}\" {} 0.5 {}\n", row, 0.002 * row, row % 3);
  }
  EXPECT_EQ(parse_foreign_table(text, "log").columns.size(), 4U);
}

TEST(ForeignTable, ALineOfUnitsMayStandAboveTheNames) {
  const auto table =
      parse_foreign_table("bench\ns,mNm,deg\ntime,torque,angle\n0,1,2\n1,1,2\n", "log");
  EXPECT_THAT(names_of(table), ElementsAre("time", "torque", "angle"));
  EXPECT_THAT(units_of(table), ElementsAre("s", "N mm", "deg"));
  EXPECT_THAT(table.assumptions, Contains("units are in line 2"));
  EXPECT_THAT(table.assumptions, Contains("names are in line 3"));
  EXPECT_THAT(table.assumptions, Contains("1 line skipped at the beginning"));
}

TEST(ForeignTable, AnEmptyCellInTheLineOfUnitsLeavesTheUnitInTheName) {
  const auto table = parse_foreign_table("t;u [mNm];Channel A\ns;;V\n0;1;2\n1;1;2\n", "log");
  EXPECT_THAT(units_of(table), ElementsAre("s", "N mm", "V"));
}

/// Three decimals everywhere are no thousands where a number below 1, another count of decimals, or
/// a whole number from 1000 on says so; nor are points between commas.
TEST(ForeignTable, NumbersOfThreeDecimalsAreNoThousands) {
  for (const char* text : {"t;u\n0,000;1,234\n1,000;1,250\n", "t;u\n0;0,123\n1;1,250\n2;12,000\n",
                           "t;u\n0;1,250\n0,5;12,000\n", "t;u\n998;1,250\n1000;2\n1002;1,500e0\n",
                           "t,u\n1,1.250\n2,3\n"}) {
    const auto table = parse_foreign_table(text, "log");
    EXPECT_THAT(table.columns[1].values, Contains(testing::AnyOf(1.25, 1.234))) << text;
  }
  const auto table = parse_foreign_table("t;u\n0;998\n1;1000\n2;1,250\n", "log");
  EXPECT_THAT(table.columns[1].values, ElementsAre(998.0, 1000.0, 1.25));
}

TEST(ForeignTable, WhatIsNoTextIsRefused) {
  for (const std::string& bytes : {std::string("t,u\n0,1\0\n1,2\n", 13),
                                   std::string("\x7f"
                                               "ELF"),
                                   std::string("\xff\xfet\0u", 5)}) {
    try {
      parse_foreign_table(bytes, "log");
      FAIL() << "accepted";
    } catch (const arm::InputError& error) {
      EXPECT_THAT(error.what(), testing::StartsWith("log: not text: "));
    }
  }
}

TEST(ForeignTable, MoreColumnsThanATableHasAreRefusedWithTheirLine) {
  constexpr std::size_t kCells = 300000;  // of which each would be compared with all
  std::string row;
  for (std::size_t i = 0; i < kCells; ++i) row += "1;";
  row.back() = '\n';
  try {
    parse_foreign_table("bench\n" + row + row, "log.txt");
    FAIL() << "accepted";
  } catch (const arm::InputError& error) {
    EXPECT_STREQ(error.what(), "log.txt:2: 300000 cells; a table has at most 4096 columns");
  }
}

TEST(ForeignTable, AnotherNameForAColumnIsShownWithoutControlCharacters) {
  const auto table = parse_foreign_table("time\xc2\x9b,u\n0,1\n1,2\n", "log.txt");
  try {
    find_column(table, "time\xc2\x9c");
    FAIL() << "found";
  } catch (const arm::InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("did you mean time\\xc2\\x9b?"));
  }
}

TEST(ForeignTable, SignsOfAMissingNumberMayBeFirst) {
  for (const char* sign :
       {"#NUM!", "None", "-1.#IND00", "1.#QNAN0", "#DIV/0!", "<NA>", "NaT", "k.A.", ".", "\\N",
        "nil", "(null)", "Missing", "invalid", "No Data", "****"}) {
    const auto table = parse_foreign_table(
        std::string("t;u;y\n0;1;") + sign + "\n1;1;3\n2;1;" + sign + "\n", "log");
    ASSERT_FALSE(table.columns[2].is_text()) << sign;
    EXPECT_TRUE(std::isnan(table.columns[2].values[0])) << sign;
    EXPECT_EQ(table.columns[2].values[1], 3.0) << sign;
    EXPECT_TRUE(stray_texts(table).empty());
  }
}

TEST(ForeignTable, SignsOfANumberBeyondTheRangeAreInfinite) {
  for (const char* sign : {"OVLD", "OL", "-OL", "Overflow", "Overrange", "+OVR", "1.#INF",
                           "-1.#INF00", "\xe2\x88\x9e", "inf", "-Inf"}) {
    const auto table = parse_foreign_table(
        std::string("t;u;y\n0;1;") + sign + "\n1;1;3\n2;1;" + sign + "\n", "log");
    ASSERT_FALSE(table.columns[2].is_text()) << sign;
    EXPECT_TRUE(std::isinf(table.columns[2].values[0])) << sign;
    EXPECT_EQ(table.columns[2].values[1], 3.0) << sign;
  }
}

/// Durations as MATLAB writes them in tables.
TEST(ForeignTable, CellsMayHaveTheUnitOfTheirColumn) {
  const auto table = parse_foreign_table(
      "Time,torque [N m],y,z,gear\n0 sec,0.5 Nm,1,1,2 up\n0.002 sec,,2,1,3 V\n0.004 "
      "sec,1.5Nm,3,1,4\n",
      "log");
  EXPECT_THAT(table.columns[0].values, ElementsAre(0.0, 0.002, 0.004));
  EXPECT_EQ(table.columns[0].unit, "s");
  EXPECT_THAT(table.columns[1].values, ElementsAre(0.5, testing::IsNan(), 1.5));
  EXPECT_EQ(table.columns[1].unit, "N m");
  EXPECT_TRUE(table.columns[4].is_text());
  EXPECT_THAT(table.assumptions, Contains("cells of Time have the unit s"));
  const auto other = parse_foreign_table("t,torque [N m],y\n0,6%,1\n1,5%,2\n", "log");
  EXPECT_TRUE(other.columns[1].is_text());
}

TEST(ForeignTable, TextsInAColumnOfAQuantityAreNamed) {
  const auto table = parse_foreign_table(
      "t;torque [N m];angle;note\n0;0,000;1.5;run 1\n1;0,0600;1.5;run 2\n", "log");
  EXPECT_THAT(stray_texts(table),
              ElementsAre("torque [N m] = 0,000 in line 2: no number, nor are other cells of the "
                          "column; write them as numbers, with the decimal mark of the other "
                          "columns"));
}

TEST(ForeignTable, ATextAmongNumbersIsNamed) {
  const auto table =
      parse_foreign_table("t,u,y,mode\n0,1,fault,up\n1,1,3,3\n2,1,fault,down\n", "log");
  EXPECT_THAT(stray_texts(table),
              testing::ElementsAre("y = fault in line 2: no number, as its other cells are; write "
                                   "the number, or leave the cell empty for a missing sample"));
}

}  // namespace
}  // namespace flexarm::measured
