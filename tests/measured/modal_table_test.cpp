#include "measured/files/modal_table.hpp"

#include "arm/input_error.hpp"
#include "measured/files/text_file.hpp"
#include "tests/measured/mistake.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <limits>
#include <random>

namespace flexarm::measured {
namespace {

using arm::SensorKind;

const std::string kHeader =
    "sensor,feature,order,frequency [Hz],frequency_std [Hz],damping_ratio,damping_ratio_std";

TEST(ModalTable, EveryColumnReachesItsMember) {
  const ModalTable table = parse_modal_table(
      kHeader + "\nhub_angle,pole,1,11.9,0.02,0.006,0.001\nstrain@0.05,zero,2,+18,,-1e-2,\n", "m");
  ASSERT_EQ(table.size(), 2U);
  EXPECT_EQ(table[0], (ModalEntry{arm::Sensor{SensorKind::hub_angle, 0.0}, Feature::pole, 1, 11.9,
                                  0.02, 0.006, 0.001}));
  EXPECT_EQ(
      table[1],
      (ModalEntry{arm::Sensor{SensorKind::strain, 0.05}, Feature::zero, 2, 18.0, {}, -0.01, {}}));
}

TEST(ModalTable, ColumnsMayStandInAnyOrderAndUnknownOnesBeLeftOut) {
  const ModalTable table = parse_modal_table(
      "\xef\xbb\xbf# bench, 14 May\r\n\r\norder,\"frequency [Hz]\", feature ,sensor\r\n"
      "1,11.9,pole,\r\n2,,pole,\r\n",
      "m");
  ASSERT_EQ(table.size(), 2U);
  EXPECT_EQ(table[0], (ModalEntry{{}, Feature::pole, 1, 11.9, {}, {}, {}}));
  EXPECT_EQ(table[1].frequency_Hz, std::nullopt);
}

TEST(ModalTable, MayStateNoOrders) {
  const ModalTable some = parse_modal_table(
      "sensor,feature,order,frequency [Hz]\nhub_angle,pole,,11.9\nhub_angle,pole,2,32\n"
      "hub_angle,pole,,58\n",
      "m");
  ASSERT_EQ(some.size(), 3U);
  EXPECT_FALSE(some[0].order);
  EXPECT_EQ(some[1].order, 2);
  EXPECT_EQ(parse_modal_table(format_modal_table(some), "m"), some);
  const ModalTable none = parse_modal_table(
      "sensor,feature,frequency [Hz]\nhub_angle,pole,11.9\nhub_angle,pole,32\n", "m");
  EXPECT_FALSE(none.at(1).order);
}

TEST(ModalTable, WhatIsWrittenReadsBackEqual) {
  std::mt19937_64 random(20261120);
  const auto chance = [&] { return random() % 2 == 0; };
  /// Any double above 0 up to `most`.
  const auto positive = [&](double most) -> std::optional<double> {
    if (chance()) return std::nullopt;
    return std::bit_cast<double>(1 + random() % std::bit_cast<std::uint64_t>(most));
  };
  constexpr double kLargest = std::numeric_limits<double>::max();
  ModalTable table;
  for (int order = 1; order <= 500; ++order) {
    ModalEntry entry;
    entry.feature = chance() ? Feature::pole : Feature::zero;
    if (entry.feature == Feature::zero || chance()) {
      entry.sensor = {SensorKind::strain, static_cast<double>(random()) * 0x1p-64};
    }
    entry.order = order;
    entry.frequency_Hz = positive(1e6);
    entry.frequency_std_Hz = positive(kLargest);
    if (chance()) entry.damping_ratio = static_cast<double>(random()) * 0x1p-63 - 1.0;
    entry.damping_ratio_std = positive(kLargest);
    table.push_back(entry);
  }
  EXPECT_EQ(parse_modal_table(format_modal_table(table), "m"), table);
  EXPECT_EQ(parse_modal_table(format_modal_table({}), "m"), ModalTable{});
}

TEST(ModalTable, HoldsModeShapesInColumnsThatMostTablesDoNotHave) {
  const ModalTable shapes = parse_modal_table(
      "sensor,feature,order,frequency [Hz],shape_re,shape_im\nstrain@0.1,pole,1,11.9,1,\n"
      "strain@0.2,pole,1,,0.7,-0.02\nhub_angle,zero,1,2.9,,\n",
      "m");
  ASSERT_EQ(shapes.size(), 3U);
  EXPECT_EQ(shapes[0].shape_re, 1.0);
  EXPECT_FALSE(shapes[0].shape_im);
  EXPECT_EQ(shapes[1].shape_im, -0.02);
  EXPECT_EQ(parse_modal_table(format_modal_table(shapes), "m"), shapes);
  ModalTable plain = shapes;
  for (auto& entry : plain) entry.shape_re = entry.shape_im = std::nullopt;
  EXPECT_TRUE(format_modal_table(plain).starts_with(kHeader + "\n"))
      << "older versions of the program read a table without shapes";
}

TEST(ModalTable, TheExampleOfTheFormatsDocumentIsRead) {
  const std::string text = measured::read_text_file(FLEXARM_SOURCE_DIR "/docs/formats.md", 1 << 20);
  const auto begin = text.find('\n', text.find("```", text.find("## Modal table"))) + 1;
  const ModalTable table =
      parse_modal_table(text.substr(begin, text.find("```", begin) - begin), "docs/formats.md");
  ASSERT_EQ(table.size(), 2U);
  EXPECT_EQ(table[0].damping_ratio, 0.006);
  EXPECT_EQ(table[1].frequency_std_Hz, std::nullopt);
}

TEST(ModalTable, BytesAtRandomGiveATableOrOneLine) {
  const std::string good =
      kHeader + "\n\"strain@0.05\",zero,1,2.87,0.01,0.006,0.001\n# x\nhub_angle,pole,1,11.86,,,\n";
  expect_result_or_one_line(good, [](const std::string& text) { parse_modal_table(text, "m"); });
}

const std::string kAllowed =
    "; allowed: sensor, feature, order, frequency [Hz], frequency_std [Hz], damping_ratio, "
    "damping_ratio_std, shape_re, shape_im";

const std::vector<Mistake> kModalTableMistakes = {
    {"Empty", "\n", "1: empty; the header is " + kHeader},
    {"ColumnMisspelt", "sensor,featrue,order,frequency [Hz]\n",
     "1: column featrue: unknown (did you mean feature?)" + kAllowed},
    {"ColumnWithoutUnit", "sensor,feature,order,frequency\n",
     "1: column frequency: unknown (did you mean frequency [Hz]?)" + kAllowed},
    {"ColumnInAnotherUnit", "sensor,feature,order,frequency [rad/s]\n",
     "1: column frequency [rad/s]: unknown (did you mean frequency [Hz]?)" + kAllowed},
    {"ColumnMissing", "# bench\nsensor,feature,order\n",
     "2: column frequency [Hz]: missing; the header is " + kHeader},
    {"ColumnTwice", "sensor,feature,order,order\n", "1: column order: given twice"},
    {"HeaderMissing", "hub_angle,pole,1,11.9\n", "1: column hub_angle: unknown" + kAllowed},
    {"Semicolons", "sensor;feature;order;frequency [Hz]\n",
     "1: cells must be separated by commas, and numbers have a decimal point"},
    {"DecimalComma", "sensor,feature,order,frequency [Hz]\nhub_angle,pole,1,11,9\n",
     "2: 5 cells; the header has 4 (numbers have a decimal point)"},
    {"CellsMissing", kHeader + "\n\nhub_angle,pole,1\n",
     "3: 3 cells; the header has 7 (numbers have a decimal point)"},
    {"NotANumber", kHeader + "\nhub_angle,pole,1,11.9 Hz,,,\n",
     "2: frequency [Hz] = 11.9 Hz: must be a finite number above 0, or empty"},
    {"Nan", kHeader + "\nhub_angle,pole,1,nan,,,\n",
     "2: frequency [Hz] = nan: must be a finite number above 0, or empty"},
    {"TooLarge", kHeader + "\nhub_angle,pole,1,1e999,,,\n",
     "2: frequency [Hz] = 1e999: must be a finite number above 0, or empty"},
    {"FrequencyNegative", kHeader + "\nhub_angle,pole,1,-11.9,,,\n",
     "2: frequency [Hz] = -11.9: must be a finite number above 0, or empty"},
    {"DeviationNegative", kHeader + "\nhub_angle,pole,1,11.9,-0.1,,\n",
     "2: frequency_std [Hz] = -0.1: must be a finite number, 0 or more, or empty"},
    {"DampingInPercent", kHeader + "\nhub_angle,pole,1,11.9,,1.2,\n",
     "2: damping_ratio = 1.2: must be from -1 to 1, a fraction of critical damping, not in "
     "percent, or empty"},
    {"SensorMisspelt", kHeader + "\nhub_angel,pole,1,11.9,,,\n",
     "2: sensor hub_angel: unknown (did you mean hub_angle?); allowed: hub_angle, hub_velocity, "
     "tip_acceleration, tip_displacement, tip_deflection, strain@X (X in metres from the hub)"},
    {"SensorOfAZeroMissing", kHeader + "\n,zero,1,11.9,,,\n",
     "2: sensor: missing; a zero belongs to one sensor"},
    {"FeatureMisspelt", kHeader + "\nhub_angle,ploe,1,11.9,,,\n",
     "2: feature = ploe: must be pole or zero (did you mean pole?)"},
    {"FeatureEmpty", kHeader + "\nhub_angle,,1,11.9,,,\n", "2: feature = : must be pole or zero"},
    {"OrderZero", kHeader + "\nhub_angle,pole,0,11.9,,,\n",
     "2: order = 0: must be a whole number from 1 to 1000, or empty"},
    {"OrderFractional", kHeader + "\nhub_angle,pole,1.5,11.9,,,\n",
     "2: order = 1.5: must be a whole number from 1 to 1000, or empty"},
    {"OrderTooLarge", kHeader + "\nhub_angle,pole,99999999999,11.9,,,\n",
     "2: order = 99999999999: must be a whole number from 1 to 1000, or empty"},
    {"FrequencyTooLarge", kHeader + "\nhub_angle,pole,1,2147483648,,,\n",
     "2: frequency [Hz] = 2147483648: must be at most 1e+06 Hz"},
    {"Twice",
     kHeader + "\nhub_angle,pole,1,11.9,,,\nhub_angle,zero,1,2,,,\nhub_angle,pole,1,12,,,\n",
     "4: hub_angle pole 1: given twice; first on line 2"},
    {"ShapeOfAZero", "sensor,feature,frequency [Hz],shape_re\nhub_angle,zero,2,1\n",
     "2: shape_re: only for a pole with a sensor; it is the mode shape at that sensor"},
    {"ShapeWithoutASensor", "sensor,feature,frequency [Hz],shape_re\n,pole,2,1\n",
     "2: shape_re: only for a pole with a sensor; it is the mode shape at that sensor"},
    {"ImaginaryShapeAlone", "sensor,feature,frequency [Hz],shape_im\nhub_angle,pole,2,1\n",
     "2: shape_im: given without shape_re"},
    {"ControlCharacter", kHeader + "\nhub_angle,pole,\"1\n\",11.9,,,\n",
     "2: order = 1\\x0a: must be a whole number from 1 to 1000, or empty"},
};

class ModalTableMistake : public testing::TestWithParam<Mistake> {};

TEST_P(ModalTableMistake, GivesOneLineWithPlaceReasonAndRemedy) {
  expect_line(GetParam(), "modal.csv", parse_modal_table);
}

INSTANTIATE_TEST_SUITE_P(, ModalTableMistake, testing::ValuesIn(kModalTableMistakes),
                         name_of_mistake);

}  // namespace
}  // namespace flexarm::measured
