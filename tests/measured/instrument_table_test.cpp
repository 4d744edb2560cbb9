// Tables of oscilloscopes and recorders: heads that tell start and period, settings beside samples.
#include "arm/input_error.hpp"
#include "measured/files/column_guess.hpp"
#include "measured/files/foreign_table.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace flexarm::measured {
namespace {

using testing::Contains;
using testing::DoubleEq;
using testing::ElementsAre;
using testing::HasSubstr;

const ForeignColumn& column(const ForeignTable& table, const std::string& name) {
  return table.columns[find_column(table, name)];
}

/// A layout whose two signals are 1, 2, 3 and 4, 5, 6 at -0.1, -0.098 and -0.096 s.
struct Layout {
  const char* name;
  std::string text;
  const char* first;
  const char* second;
};

void PrintTo(const Layout& layout, std::ostream* out) {
  *out << layout.name;
}

class InstrumentTable : public testing::TestWithParam<Layout> {};

TEST_P(InstrumentTable, HasTimesAndSignals) {
  const ForeignTable table = parse_foreign_table(GetParam().text, "scope.csv");
  const auto guess = guess_columns(labels_of(table), {});
  ASSERT_TRUE(guess.mappings.contains("time"));
  const auto& time = column(table, guess.mappings.at("time").name);
  std::vector<double> times_s;
  for (const double value : time.values) {
    times_s.push_back(value * conversion_of("time", time.unit).value());
  }
  EXPECT_THAT(times_s, ElementsAre(DoubleEq(-0.1), DoubleEq(-0.098), DoubleEq(-0.096)));
  EXPECT_THAT(column(table, GetParam().first).values, ElementsAre(1.0, 2.0, 3.0));
  EXPECT_THAT(column(table, GetParam().second).values, ElementsAre(4.0, 5.0, 6.0));
}

INSTANTIATE_TEST_SUITE_P(
    , InstrumentTable,
    testing::Values(
        Layout{"RigolWithSequence",
               "X,CH1,CH2,Start,Increment,\nSequence,Volt,Volt,-1.0e-1,2.0e-03\n0,1,4,,\n1,2,5,,\n"
               "2,3,6,,\n",
               "CH1", "CH2"},
        Layout{
            "RigolWithShortRows",
            "X,CH1,CH2,Start,Increment\nSequence,Volt,Volt,-1.0e-1,2.0e-03\n0,1,4\n1,2,5\n2,3,6\n",
            "CH1", "CH2"},
        Layout{"RigolInOneLine", "CH1V,CH2V,t0 = -1.0e-01, tInc = 2.0e-03,\n1,4\n2,5\n3,6\n",
               "CH1V", "CH2V"},
        Layout{"RigolWithSeconds",
               "X,CH1,CH2\nSecond,Volt,Volt\n-0.1,1,4\n-0.098,2,5\n-0.096,3,6\n", "CH1", "CH2"},
        Layout{"Keysight", "x-axis,1,2\nsecond,Volt,Volt\n-0.1,1,4\n-0.098,2,5\n-0.096,3,6\n", "1",
               "2"},
        Layout{
            "Siglent",
            "Record Length,Analog:3\nSample Interval,Analog:2.0E-03\nVertical Units,CH1:V,CH2:V\n"
            "Horizontal Units,s\nModel Number,SDS1204X-E\nSource,CH1,CH2\nSecond,Volt,Volt\n"
            "-0.1,1,4\n-0.098,2,5\n-0.096,3,6\n",
            "CH1", "CH2"},
        Layout{"TektronixWithPreamble",
               "Model,MSO4034\nFirmware Version,2.48\n\nHorizontal Units,s\nSample Interval,2e-3\n"
               "Record Length,3\nVertical Units,V,V\nLabel,,\nTIME,CH1,CH2\n-0.1,1,4\n-0.098,2,5\n"
               "-0.096,3,6\n",
               "CH1", "CH2"},
        Layout{"PicoScope",
               "Time,Channel A,Channel B\n(ms),(V),(V)\n\n-100,1,4\n-98,2,5\n-96,3,6\n",
               "Channel A", "Channel B"},
        Layout{"YokogawaBesideKeys",
               "\"Header Size\",16\n\"ModelName\",\"DL850\"\n\"BlockNumber\",1\n"
               "\"TraceName\",\"CH1\",\"CH2\"\n\"BlockSize\",3,3\n\"VUnit\",\"V\",\"V\"\n"
               "\"SampleRate\",500,500\n\"HResolution\",2.0E-03,2.0E-03\n"
               "\"HOffset\",-1.0E-01,-1.0E-01\n\"HUnit\",\"s\",\"s\"\n"
               "\"Date\",\"2024/03/01\",\"2024/03/01\"\n\"Time\",\"12:00:00.00\",\"12:00:00.00\"\n"
               "\n,1,4\n,2,5\n,3,6\n",
               "CH1", "CH2"},
        Layout{"YokogawaBelowKeys",
               "TraceName,CH1,CH2\r\nHResolution,2\r\nHOffset,-100\r\nHUnit,ms\r\nVUnit,V,V\r\n"
               "Date,2024/03/01\r\nTime,12:00:00.00\r\n1,4,\r\n2,5,\r\n3,6,\r\n",
               "CH1", "CH2"},
        Layout{"YokogawaWithTimes",
               "\"TraceName\",\"CH1\",\"CH2\"\n\"HUnit\",\"ms\"\n\"Time\",\"12:00:00\"\n"
               "-100,1,4\n-98,2,5\n-96,3,6\n",
               "CH1", "CH2"},
        Layout{"Rohde", "in s,CH1 in V,CH2 in V\n-0.1,1,4\n-0.098,2,5\n-0.096,3,6\n", "CH1 in V",
               "CH2 in V"},
        Layout{"RateInThePreamble",
               "Recorder 7\nSampling rate: 500 Hz\nt0 = -0.1 s\ntorque;angle\n1;4\n2;5\n3;6\n",
               "torque", "angle"},
        Layout{"RateInAComment", "# X0 = -0.1\n# Delta t = 2 ms\n# torque angle\n1 4\n2 5\n3 6\n",
               "torque", "angle"}),
    [](const auto& layout) { return std::string(layout.param.name); });

/// Settings take more rows than are read as head.
std::string tektronix(bool second) {
  const std::vector<std::string> settings = {"Record Length,30,Points", "Sample Interval,0.002,s",
                                             "Trigger Point,0,Samples", "Source,CH1,",
                                             "Vertical Units,V,",       "Horizontal Units,s,"};
  std::string text;
  for (std::size_t k = 0; k < 30; ++k) {
    const std::string beside = k < settings.size() ? settings[k] : ",,";
    text += fmt::format("{},{:.6f},{:.5f},", beside, 0.002 * static_cast<double>(k),
                        0.1 * static_cast<double>(k));
    if (second) {
      std::string other = beside;
      if (other.starts_with("Source")) other = "Source,CH2,";
      text += fmt::format(",{},{:.6f},{:.5f},", other, 0.002 * static_cast<double>(k),
                          -0.1 * static_cast<double>(k));
    }
    text += "\n";
  }
  return text;
}

TEST(InstrumentHead, SettingsBesideSamplesAreNoSamples) {
  for (const bool second : {false, true}) {
    const ForeignTable table = parse_foreign_table(tektronix(second), "tek.csv");
    EXPECT_THAT(table.assumptions, Contains("the instrument recorded CH1 in V"));
    EXPECT_EQ(column(table, "#4").name, "time");
    EXPECT_EQ(column(table, "time").values.size(), 30U);
    EXPECT_DOUBLE_EQ(column(table, "time").values[29], 0.058);
    EXPECT_DOUBLE_EQ(column(table, "CH1").values[29], 2.9);
    if (second) {
      EXPECT_DOUBLE_EQ(column(table, "CH2").values[29], -2.9);
    }
    const auto guess = guess_columns(labels_of(table), {});
    EXPECT_EQ(guess.mappings.at("time").name, "time");
  }
}

TEST(InstrumentHead, KeysOfARecorderTellNamesAndUnits) {
  const auto text = [](const char* time_unit, const char* periods) {
    return fmt::format(
        "\"Model Name\",\"DL850E\"\n\"TraceName\",\"Torque\",\"Angle\"\n\"VUnit\",\"Nm\",\"deg\"\n"
        "\"HResolution\",{}\n\"HUnit\",\"{}\"\n\"Time\",\"12:00:00\",\"12:00:00\"\n"
        ",0.1,4\n,0.2,5\n,0.3,6\n",
        periods, time_unit);
  };
  const auto table = parse_foreign_table(text("s", "5e-3,5e-3"), "dl.csv");
  const auto guess = guess_columns(labels_of(table), {});
  EXPECT_EQ(guess.mappings.at("torque").name, "Torque");
  EXPECT_EQ(guess.mappings.at("torque").unit, "N m");
  EXPECT_EQ(guess.mappings.at("hub_angle").unit, "deg");
  EXPECT_THAT(column(table, "time [s]").values, ElementsAre(0.0, 0.005, 0.01));
  EXPECT_FALSE(guess_columns(labels_of(parse_foreign_table(text("Hz", "5e-3,5e-3"), "dl.csv")), {})
                   .mappings.contains("time"));
  try {
    parse_foreign_table(text("s", "5e-3,1e-3"), "dl.csv");
    FAIL() << "accepted";
  } catch (const arm::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("HResolution 5e-3 and 1e-3: signals of unlike sampling"));
  }
}

TEST(InstrumentHead, ATimeThatIsMadeIsSaid) {
  const auto table = parse_foreign_table("Sample Interval,5,ms\nu,y\n1,2\n2,3\n3,4\n", "log");
  EXPECT_THAT(column(table, "time [s]").values, ElementsAre(0.0, 0.005, 0.01));
  EXPECT_THAT(table.assumptions,
              Contains("times begin at 0 s and are 0.005 s apart, as line 1 tells"));
}

/// Columns of a machine that are called so, with numbers in each row.
TEST(InstrumentHead, ColumnsOfThatNameAreNoHead) {
  const auto table = parse_foreign_table("t,u,Start,Increment\n0,1,2,3\n1,2,3,4\n2,3,4,5\n", "log");
  EXPECT_THAT(column(table, "Increment").values, ElementsAre(3.0, 4.0, 5.0));
  EXPECT_EQ(table.columns.size(), 4U);
}

/// The first rows may have empty cells; no sample is lost.
TEST(InstrumentHead, IncompleteRowsAtTheBeginningAreRows) {
  for (const auto* text :
       {"t,u,y\n0,,\n1,2,3\n2,,\n3,4,5\n4,5,6\n", "t;u;y\n0;;NaN\n1;-;3\n2;2;3\n3;4;5\n4;5;6\n"}) {
    const auto table = parse_foreign_table(text, "log");
    EXPECT_EQ(table.columns[0].name, "t");
    EXPECT_THAT(table.columns[0].values, ElementsAre(0.0, 1.0, 2.0, 3.0, 4.0)) << text;
  }
}

TEST(InstrumentHead, AMinusSignOfASpreadsheetIsRead) {
  const auto table = parse_foreign_table(
      "t,u\n0,\xe2\x88\x92"
      "1.5\n1,2\n",
      "log");
  EXPECT_THAT(table.columns[1].values, ElementsAre(-1.5, 2.0));
}

TEST(InstrumentHead, ExponentsOfFortranAreNumbers) {
  const auto table = parse_foreign_table(
      "t u y\n 0.000D+00 1.8000D-03 -1.0d+00\n 1.000D+00 1.9000D-03 2.5D0\n", "log");
  EXPECT_THAT(table.columns[1].values, ElementsAre(1.8e-3, 1.9e-3));
  EXPECT_THAT(table.columns[2].values, ElementsAre(-1.0, 2.5));
}

TEST(InstrumentHead, SettingsOfTwoChannelsAreNoRows) {
  const auto tektronix = parse_foreign_table(
      "Horizontal Scale,0.04,0.04\nSample Interval,2e-3,2e-3\nRecord Length,3,3\nVertical "
      "Units,V,V\n"
      "Vertical Offset,0,0\nVertical Scale,1,0.5\n,,\nLabel,,\nTIME,CH1,CH2\n0.000,0.1,0.2\n"
      "0.002,0.3,0.4\n0.004,0.5,0.6\n",
      "tek.csv");
  EXPECT_THAT(column(tektronix, "TIME").values, ElementsAre(0.0, 0.002, 0.004));
  EXPECT_THAT(column(tektronix, "CH2").values, ElementsAre(0.2, 0.4, 0.6));
  const auto adjacent = parse_foreign_table(
      "Vertical Offset,0,0\nVertical Scale,1,0.5\nTIME,CH1,CH2\n0.000,0.1,0.2\n0.002,0.3,0.4\n",
      "a");
  EXPECT_THAT(column(adjacent, "CH1").values, ElementsAre(0.1, 0.3));
  const auto instek = parse_foreign_table(
      "Format,1.0B\nMemory Length,400,Memory Length,400,\nTrigger Level,0,Trigger Level,0,\n"
      "Vertical Units,V,Vertical Units,V,\nSampling Period,2e-3,Sampling Period,2e-3,\n"
      "Waveform Data,,Waveform Data,,\n0.000,0.1,0.000,0.2,\n0.002,0.3,0.002,0.4,\n",
      "gw.csv");
  EXPECT_THAT(column(instek, "#2").values, ElementsAre(0.1, 0.3));
  EXPECT_THAT(column(instek, "#4").values, ElementsAre(0.2, 0.4));
  const auto yokogawa = parse_foreign_table(
      "\"BlockNumber \",1,1\n\"TraceName   \",\"CH1\",\"CH2\"\n\"HResolution "
      "\",2e-3,2e-3\n\"HOffset\",-0.1,-0.1\n"
      "\"Date\",\"2024/03/01\",\"2024/03/01\"\n\"Time\",\"12:00:00.00\",\"12:00:00.00\"\n"
      ",0.1,0.2\n,0.3,0.4\n,0.5,0.6\n",
      "dl.csv");
  EXPECT_THAT(column(yokogawa, "#2").values, ElementsAre(0.1, 0.3, 0.5));
  EXPECT_THAT(column(yokogawa, "time [s]").values,
              ElementsAre(DoubleEq(-0.1), DoubleEq(-0.098), DoubleEq(-0.096)));
}

/// Rows in front of the first sound one are rows, and no sample is lost without a word.
TEST(InstrumentHead, ARowWithATextInItIsNoHead) {
  std::string rows;
  for (int k = 2; k < 40; ++k) rows += fmt::format("{},{},{}\n", k, k, k);
  const auto faulty = parse_foreign_table("t,u,y\n0,1,fault\n\n1,1,fault\n" + rows, "log");
  EXPECT_EQ(faulty.columns[0].name, "t");
  EXPECT_EQ(faulty.columns[0].values.size(), 40U);
  EXPECT_EQ(faulty.columns[2].stray, "fault");
  const auto noted = parse_foreign_table("note,t,u\nbegin,0,1\n,1,2\n,2,3\n,3,4\n", "log");
  EXPECT_THAT(column(noted, "t").values, ElementsAre(0.0, 1.0, 2.0, 3.0));
}

TEST(InstrumentHead, ARateMayBeInSamplesPerSecond) {
  for (const char* rate : {"500,Samples/s", "0.5,kSps", "500 S/s", "0.5,kHz"}) {
    const auto table =
        parse_foreign_table(fmt::format("Sample Rate,{}\nu,y\n1,2\n2,3\n3,4\n", rate), "log");
    EXPECT_THAT(column(table, "time [s]").values, ElementsAre(0.0, 0.002, 0.004)) << rate;
  }
}

}  // namespace
}  // namespace flexarm::measured
