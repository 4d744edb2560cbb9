#include "measured/files/foreign_file.hpp"

#include "arm/input_error.hpp"
#include "measured/files/column_guess.hpp"
#include "measured/files/column_words.hpp"
#include "measured/files/record_constants.hpp"
#include "measured/files/record_export.hpp"
#include "measured/files/text_file.hpp"
#include "tests/measured/any_finite.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace flexarm::measured {
namespace {

using arm::Sensor;
using arm::SensorKind;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

TimeRecord random_time_record() {
  std::mt19937_64 random(20261130);
  TimeRecord record;
  record.channels = {{{SensorKind::hub_angle, 0.0}, {}},
                     {{SensorKind::strain, 0x1.999999999999ap-5}, {}},
                     {{SensorKind::tip_acceleration, 0.0}, {}}};
  for (int i = 0; i < 500; ++i) {
    record.time_s.push_back(0.1 + static_cast<double>(i) * std::numbers::pi * 1e-3);
    record.torque_N_m.push_back(any_finite(random));
    for (auto& channel : record.channels) channel.values.push_back(any_finite(random));
  }
  record.torque_N_m[3] = -0.0;
  return record;
}

FrequencyRecord random_frequency_record() {
  std::mt19937_64 random(20261131);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  FrequencyRecord record{{{{SensorKind::hub_velocity, 0.0}, {}, {}, {}},
                          {{SensorKind::strain, 0.05}, {}, {}, {}},
                          {{SensorKind::hub_angle, 0.0}, {}, {}, {}}}};
  for (auto& channel : record.channels) {
    double frequency_Hz = 0.0;
    for (int i = 0; i < 300; ++i) {
      channel.frequency_Hz.push_back(frequency_Hz += uniform(random) + 1e-6);
      const double real = any_finite(random);
      channel.response.emplace_back(real, any_finite(random));
      const bool is_unknown = &channel == &record.channels[1] || i % 7 == 0;
      channel.coherence.push_back(is_unknown ? kUnknown : 1.0 - uniform(random));
    }
  }
  record.channels[2].response[0] = {-0.0, 1.0};
  return record;
}

/// A folder of its own, removed afterwards.
class ForeignFileTest : public testing::Test {
 protected:
  ForeignFileTest() {
    std::string name = (std::filesystem::temp_directory_path() / "flexarm-test-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
  }
  ~ForeignFileTest() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path path(const char* name = "a") const { return folder_ / name; }
  void write(const std::string& bytes) const { std::ofstream(path(), std::ios::binary) << bytes; }
  ForeignFile read() const { return read_foreign_file(path()); }
  TimeRecord time_record() const { return time_record_of(read().table, {}, "a"); }
  FrequencyRecord frequency_record() const { return frequency_record_of(read(), {}, "a"); }

  std::filesystem::path folder_;
};

bool has_sign_of_zero(double value) {
  return value == 0.0 && std::signbit(value);
}

TEST_F(ForeignFileTest, TimeRecordsComeBackBitForBit) {
  const TimeRecord record = random_time_record();
  for (const bool binary : {false, true}) {
    write_universal_file(universal_functions(record), path(), {.binary = binary});
    EXPECT_EQ(time_record(), record) << binary;
    EXPECT_TRUE(has_sign_of_zero(time_record().torque_N_m[3])) << binary;
  }
  write_mat_file(mat_variables(record), path());
  EXPECT_EQ(time_record(), record);
  write_time_record(record, path());
  EXPECT_EQ(time_record(), record);
}

TEST_F(ForeignFileTest, FrequencyRecordsComeBackBitForBit) {
  const FrequencyRecord record = random_frequency_record();
  for (const bool binary : {false, true}) {
    write_universal_file(universal_functions(record), path(), {.binary = binary});
    EXPECT_EQ(frequency_record(), record) << binary;
    EXPECT_TRUE(has_sign_of_zero(frequency_record().channels[2].response[0].real())) << binary;
  }
  write_mat_file(mat_variables(record), path());
  EXPECT_EQ(frequency_record(), record);
}

TEST_F(ForeignFileTest, WhatIsNotFiniteIsNotWritten) {
  TimeRecord record = random_time_record();
  record.channels[0].values[7] = std::numeric_limits<double>::infinity();
  EXPECT_THROW(write_universal_file(universal_functions(record), path()), arm::InputError);
  EXPECT_FALSE(std::filesystem::exists(path()));
}

UniversalFunction response_of(const char* id, int direction, const char* unit, const char* per) {
  UniversalFunction function;
  function.id[0] = id;
  function.type = kUniversalFrequencyResponse;
  function.response = {"BEAM", 3, direction};
  function.abscissa_axis.units = "Hz";
  function.ordinate_axis.units = unit;
  function.denominator_axis.units = per;
  function.abscissa = {1.0, 2.0};
  function.real = {10.0, 20.0};
  function.imaginary = {1.0, 2.0};
  return function;
}

TEST_F(ForeignFileTest, ResponsesOfAnAnalyserAreMappedIntoSi) {
  write_universal_file({response_of("FRF", 3, "g", "Nmm"), response_of("FRF", -6, "deg", "V")},
                       path());
  const ForeignFile file = read();
  ASSERT_EQ(file.responses.size(), 2U);
  EXPECT_EQ(file.responses[0].name, "FRF, node 3 +z");
  EXPECT_EQ(file.responses[1].name, "FRF, node 3 -rz");
  EXPECT_EQ(file.responses[0].per, "N mm");
  const auto record =
      frequency_record_of(file, {{"tip_acceleration", {"FRF, node 3 +z", "g", 1.0}}}, "a");
  ASSERT_EQ(record.channels.size(), 1U);
  EXPECT_EQ(record.channels[0].response[0], std::complex<double>(10.0, 1.0) * (9.80665 * 1e3));
  EXPECT_TRUE(std::isnan(record.channels[0].coherence[0]));
  try {
    frequency_record_of(file, {{"hub_angle", {"FRF, node 3 -rz", "deg", 1.0}}}, "a");
    FAIL() << "accepted";
  } catch (const arm::InputError& error) {
    EXPECT_STREQ(error.what(),
                 "a: FRF, node 3 -rz: a response to V, not to a torque; state its scale in V per N "
                 "m, as in --column 'hub_angle=FRF, node 3 -rz:deg:SCALE'");
  }
}

TEST_F(ForeignFileTest, FrequenciesOfAUniversalFileHaveTheirUnit) {
  const auto read_with = [&](const char* unit) {
    auto function = response_of("FRF", 3, "rad", "Nm");
    function.abscissa_axis.units = unit;
    write_universal_file({function}, path());
    return read();
  };
  for (const auto& [unit, factor] :
       {std::pair{"Hz", 1.0}, std::pair{"kHz", 1e3}, std::pair{"RPM", 1.0 / 60.0},
        std::pair{"rad/s", 1.0 / (2.0 * std::numbers::pi)}}) {
    const ForeignFile file = read_with(unit);
    EXPECT_EQ(file.responses.at(0).frequency_Hz.at(1), 2.0 * factor) << unit;
    EXPECT_TRUE(file.table.assumptions.empty()) << unit;
  }
  EXPECT_THAT(read_with("NONE").table.assumptions,
              ElementsAre("unit of the frequencies of FRF not given; Hz assumed"));
  try {
    read_with("orders");
    FAIL() << "accepted";
  } catch (const arm::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("FRF: frequencies in orders; must be in Hz, kHz, rad/s"));
  }
}

TEST_F(ForeignFileTest, AResponseOfRealNumbersIsRefused) {
  auto function = response_of("FRF", 3, "rad", "Nm");
  function.imaginary.clear();
  write_universal_file({function}, path());
  try {
    read();
    FAIL() << "accepted";
  } catch (const arm::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("FRF: frequency response of real numbers, a magnitude"));
  }
}

TEST_F(ForeignFileTest, ASignThatIsNotAppliedIsSaid) {
  auto both = response_of("both", -3, "rad", "Nm");
  both.reference = {"MOTOR", 1, -6};
  write_universal_file(
      {response_of("up", 3, "rad", "Nm"), response_of("down", -3, "rad", "Nm"), both}, path());
  EXPECT_THAT(read().table.assumptions,
              ElementsAre(HasSubstr("down: node 3 -z per node 0; the sign of a direction is not "
                                    "applied")));
}

TEST_F(ForeignFileTest, UnitsOfDataSet164AreSaidWhereASignalHasNone) {
  const auto read_with = [&](const std::string& units, const char* own) {
    const std::string text = "    -1\n   164\n" + units + "\n    -1\n" +
                             format_universal_file({response_of("tip", 3, own, "Nm")});
    std::ofstream(path()) << text;
    return read().table.assumptions;
  };
  const std::string millimetres = "         5mm (milli-newton)           2";
  EXPECT_THAT(read_with(millimetres, "NONE"),
              ElementsAre(HasSubstr("data set 164 has units, 5, mm (milli-newton), which are not "
                                    "applied; units not given: tip")));
  EXPECT_TRUE(read_with(millimetres, "mm").empty());
  EXPECT_TRUE(read_with("         1SI: Meter (newton)            2", "NONE").empty());
}

TEST_F(ForeignFileTest, SignalsOfAUniversalFileAreColumns) {
  std::vector<UniversalFunction> functions = universal_functions(random_time_record());
  functions[1].id[0] = "NONE";
  functions[1].response.entity = "ENC 1";
  functions[2].abscissa.front() -= 1.0;
  write_universal_file(functions, path());
  const ForeignFile file = read();
  ASSERT_EQ(file.table.columns.size(), 4U);
  EXPECT_EQ(file.table.columns[0].name, "time [s]");
  EXPECT_EQ(file.table.columns[2].name, "ENC 1");
  EXPECT_EQ(file.table.columns[2].unit, "rad");
  EXPECT_THAT(file.left_out, ElementsAre(HasSubstr("time axis differs from that of torque [N m]")));
}

TEST_F(ForeignFileTest, VariablesOfAMatlabFileAreSignalsAndResponses) {
  const MatMatrix column{3, 1, {0.0, 1.0, 2.0}};
  write_mat_file({{"t", column},
                  {"y_deg", MatMatrix{3, 2, {1.0, 2.0, 3.0, 4.0, 5.0, 6.0}}},
                  {"gain", MatMatrix{1, 1, {2.0}}},
                  {"note", std::string("bench")},
                  {"omega", MatMatrix{1, 2, {1.0, 2.0}}},
                  {"H", MatComplexMatrix{2, 1, {{1.0, 2.0}, {3.0, 4.0}}}},
                  {"odd", MatComplexMatrix{4, 1, {1.0, 1.0, 1.0, 1.0}}}},
                 path());
  const ForeignFile file = read();
  std::vector<std::string> names;
  for (const auto& entry : file.table.columns) names.push_back(entry.name);
  EXPECT_THAT(names, ElementsAre("t", "y_deg(:,1)", "y_deg(:,2)", "omega"));
  EXPECT_THAT(file.table.columns[2].values, ElementsAre(4.0, 5.0, 6.0));
  ASSERT_EQ(file.responses.size(), 1U);
  EXPECT_EQ(file.responses[0].frequency_Hz[1], 2.0 * (1.0 / (2.0 * std::numbers::pi)));
  EXPECT_THAT(file.left_out, Contains("gain: no vector of numbers"));
  EXPECT_THAT(file.left_out, Contains(HasSubstr("odd: complex")));
}

TEST(ColumnGuess, NamesAndUnitsTellQuantities) {
  const std::vector<ColumnLabel> columns = {
      {"Time (ms)", "ms"}, {"tau [N m]", "N m"},     {"theta", ""}, {"gyro_dps", "deg/s"},
      {"Acc 1 (g)", "g"},  {"strain@0.05 [1]", "1"}, {"i_A", "A"},  {"data.tip_deflection", "mm"}};
  const ColumnGuess guess = guess_columns(columns, {{"hub_velocity", {"gyro_dps", "deg/s", 1.0}}});
  EXPECT_EQ(guess.mappings,
            (ColumnMappings{{"time", {"Time (ms)", "ms", 1.0}},
                            {"torque", {"tau [N m]", "N m", 1.0}},
                            {"hub_angle", {"theta", "rad", 1.0}},
                            {"hub_velocity", {"gyro_dps", "deg/s", 1.0}},
                            {"tip_acceleration", {"Acc 1 (g)", "g", 1.0}},
                            {"strain@0.05", {"strain@0.05 [1]", "1", 1.0}},
                            {"tip_deflection", {"data.tip_deflection", "mm", 1.0}}}));
  EXPECT_THAT(guess.notes, ElementsAre("unit of theta not given; rad assumed"));
}

TEST(ColumnGuess, WhatSeveralColumnsMayBeIsLeftOutAndNoted) {
  const ColumnGuess guess = guess_columns(
      std::vector<ColumnLabel>{{"t_s", "s"}, {"hub1_deg", "deg"}, {"hub2_deg", "deg"}}, {});
  EXPECT_EQ(guess.mappings, (ColumnMappings{{"time", {"t_s", "s", 1.0}}}));
  EXPECT_THAT(guess.notes,
              ElementsAre("hub_angle: ambiguous (hub1_deg or hub2_deg); choose with --column "
                          "hub_angle=NAME"));
}

TEST(ColumnGuess, ALaterNumberInANameIsWarnedOf) {
  using Labels = std::vector<ColumnLabel>;
  const auto second = guess_columns(Labels{{"t_s", "s"}, {"angle 2", "deg"}}, {});
  EXPECT_EQ(second.mappings.at("hub_angle").name, "angle 2");
  EXPECT_THAT(second.warnings,
              ElementsAre("angle 2 is taken as hub_angle, but its name has the number 2; state "
                          "hub_angle with --column 'hub_angle=angle 2', if this is it, or another "
                          "column"));
  EXPECT_TRUE(guess_columns(Labels{{"t_s", "s"}, {"angle1", "deg"}}, {}).warnings.empty());
  for (const char* other : {"angle", "position"}) {
    const auto two = guess_columns(Labels{{other, "deg"}, {"angle 2", "deg"}}, {});
    EXPECT_THAT(two.ambiguous.at("hub_angle"), ElementsAre(other, "angle 2"));
  }
}

TEST(ColumnGuess, TheStandardNameGoesFirstAndTheUnitMustFit) {
  const ColumnGuess guess = guess_columns(
      std::vector<ColumnLabel>{{"hub_angle", "rad"}, {"theta", "rad"}, {"torque", "V"}}, {});
  EXPECT_EQ(guess.mappings, (ColumnMappings{{"hub_angle", {"hub_angle", "rad", 1.0}}}));
}

TEST(ColumnGuess, APositionIsTheHubAngleInAUnitOfAnAngleAlone) {
  const auto guess_of = [](const ColumnLabel& position) {
    return guess_columns(std::vector<ColumnLabel>{{"time", "s"}, {"torque", "N m"}, position}, {});
  };
  EXPECT_EQ(guess_of({"position [deg]", "deg"}).mappings.at("hub_angle").name, "position [deg]");
  EXPECT_EQ(guess_of({"joint.position(1)", "rad"}).mappings.at("hub_angle").unit, "rad");
  for (const char* unit : {"", "mm"}) {
    const auto guess = guess_of({"position", unit});
    EXPECT_FALSE(guess.mappings.contains("hub_angle"));
    ASSERT_EQ(guess.questions.size(), 1U);
    EXPECT_THAT(guess.questions[0].sentence, HasSubstr("--column 'hub_angle=position:rad'"));
  }
  // Beside a column that says what it is, it is nothing.
  const auto beside =
      guess_columns(std::vector<ColumnLabel>{{"theta", "rad"}, {"position [rad]", "rad"}}, {});
  EXPECT_EQ(beside.mappings.at("hub_angle").name, "theta");
}

/// No word is two quantities, and each is as `plain_letters` has it; one that needs a unit is asked
/// about without.
TEST(ColumnWords, AreSpelledPlainlyAndStandOnce) {
  std::vector<std::string> all;
  for (const auto& [quantity, words, needs_unit] : quantity_words()) {
    if (!needs_unit) all.insert(all.end(), words.begin(), words.end());
  }
  for (const auto& open : open_words()) all.insert(all.end(), open.words.begin(), open.words.end());
  for (const auto& word : all) {
    EXPECT_EQ(plain_letters(word), word);
    EXPECT_EQ(std::ranges::count(all, word), 1) << word;
  }
}

TEST(ColumnWords, LoseCaseAccentsAndWhatIsNoLetter) {
  EXPECT_EQ(plain_letters("Pr\xc3\xbc"
                          "fl\xc3\xa4nge 2"),
            "prueflaenge");
  EXPECT_EQ(plain_letters("D\xc3\xa9"
                          "formation"),
            "deformation");
  EXPECT_EQ(plain_letters("\xcf\x84"), "tau");
}

}  // namespace
}  // namespace flexarm::measured
