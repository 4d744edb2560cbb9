// Units that MATLAB files tell of their signals and frequencies, in any letters.
#include "arm/input_error.hpp"
#include "measured/files/foreign_file.hpp"
#include "measured/files/text_encoding.hpp"
#include "tests/measured/mat_structures.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <matio.h>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace flexarm::measured {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class MatUnits : public MatSignals {};

/// Letters of one row as MATLAB keeps them, in UTF-16.
matvar_t* text16(std::u16string letters) {
  std::array<std::size_t, 2> size{1, letters.size()};
  return Mat_VarCreate(nullptr, MAT_C_CHAR, MAT_T_UINT16, 2, size.data(), letters.data(), 0);
}

/// Letters of one row, a byte each.
matvar_t* text_latin1(std::string bytes) {
  std::array<std::size_t, 2> size{1, bytes.size()};
  return Mat_VarCreate(nullptr, MAT_C_CHAR, MAT_T_UINT8, 2, size.data(), bytes.data(), 0);
}

TEST_F(MatUnits, AUnitBeyondAsciiIsRead) {
  for (const bool is_latin1 : {true, false}) {
    const auto degrees = [&] { return is_latin1 ? text_latin1("\xb0") : text16(u"\u00b0"); };
    const auto file = read(
        {{"rec",
          structures({{{"X", structures({{{"Name", text("Host")}, {"Data", column(times_s())}}})},
                       {"Y", structures({{{"Name", text("torque")},
                                          {"Unit", text16(u"N\u00b7m")},
                                          {"Data", column(torques_N_m())}},
                                         {{"Name", text16(u"\u03b8")},
                                          {"Unit", degrees()},
                                          {"Data", column(angles_rad())}}})}}})}});
    ASSERT_EQ(file.table.columns.size(), 3U);
    EXPECT_EQ(file.table.columns[1].unit, "N m");
    EXPECT_EQ(file.table.columns[2].unit, "deg");
    EXPECT_EQ(file.table.columns[2].name, "\xce\xb8");
  }
}

TEST_F(MatUnits, AUnitThatIsNotReadIsRefused) {
  std::array<std::size_t, 2> two_rows{2, 3};
  std::string letters = "ddeegg";
  try {
    read({{"a", structures({{{"t", column(times_s())},
                             {"theta", column(angles_rad())},
                             {"Unit", Mat_VarCreate(nullptr, MAT_C_CHAR, MAT_T_UINT8, 2,
                                                    two_rows.data(), letters.data(), 0)}}})}});
    FAIL() << "accepted";
  } catch (const arm::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("a.Unit: 2 units; must be as many as a matrix beside it"));
  }
}

TEST_F(MatUnits, HowASignalIsDrawnIsNoSignal) {
  const auto signal = [](const char* label, const std::vector<double>& values) {
    return structures({{{"values", column(values)},
                        {"dimensions", numbers({1.0, 1.0}, {1, 2})},
                        {"label", text(label)},
                        {"plotStyle", numbers({0.0, 0.0}, {1, 2})}}});
  };
  const auto scope = [&](const char* label, const std::vector<double>& values) {
    return structures({{{"time", column(times_s())}, {"signals", signal(label, values)}}});
  };
  const auto file =
      read({{"a", scope("torque", torques_N_m())}, {"b", scope("hub angle", angles_rad())}});
  expect_told(file);
  EXPECT_THAT(names_in(file), ElementsAre("a.time", "torque", "hub angle"));
}

matvar_t* complex_column(const std::vector<double>& real) {
  std::vector<double> re = real;
  std::vector<double> im(real.size(), 0.5);
  std::array<std::size_t, 2> size{real.size(), 1};
  mat_complex_split_t parts{re.data(), im.data()};
  return Mat_VarCreate(nullptr, MAT_C_DOUBLE, MAT_T_DOUBLE, 2, size.data(), &parts, MAT_F_COMPLEX);
}

TEST_F(MatUnits, TheUnitOfFrequenciesIsThatBesideThemOrSaidToBeAssumed) {
  constexpr double kTurn_rad = 6.283185307179586;
  const auto frd = [](std::vector<Field> units) {
    std::vector<Field> fields = {{"ResponseData", complex_column({1.0, 2.0, 3.0})},
                                 {"Frequency", column({1.0, 2.0, 3.0})}};
    fields.insert(fields.end(), units.begin(), units.end());
    return structures({fields});
  };
  const auto second_Hz = [&](std::vector<Field> units) {
    return read({{"G", frd(std::move(units))}}).responses.at(0).frequency_Hz.at(1);
  };
  EXPECT_NEAR(second_Hz({{"FrequencyUnit", text("rad/s")}}), 2.0 / kTurn_rad, 1e-15);
  EXPECT_NEAR(second_Hz({{"FrequencyUnit", text("rad/TimeUnit")}, {"TimeUnit", text("seconds")}}),
              2.0 / kTurn_rad, 1e-15);
  EXPECT_EQ(second_Hz({{"FrequencyUnit", text("kHz")}}), 2000.0);
  EXPECT_THROW(second_Hz({{"FrequencyUnit", text("rad/TimeUnit")}, {"TimeUnit", text("hours")}}),
               arm::InputError);
  EXPECT_THROW(second_Hz({{"Units", text("rad/s")}}), arm::InputError);  // of which of the two?
  EXPECT_THAT(read({{"G", frd({})}}).table.assumptions,
              ElementsAre("unit of G.Frequency not given; Hz assumed"));
  const auto named = read(
      {{"f_kHz", column({1.0, 2.0, 3.0})}, {"hub_angle_deg", complex_column({1.0, 2.0, 3.0})}});
  ASSERT_EQ(named.responses.size(), 1U);
  EXPECT_EQ(named.responses[0].frequency_Hz[1], 2000.0);
  EXPECT_EQ(named.responses[0].unit, "deg");
  EXPECT_THAT(named.table.assumptions, ElementsAre("f_kHz holds frequencies in kHz"));
}

/// Torque and angle in columns, or times in front of them.
matvar_t* matrix(bool with_times) {
  std::vector<double> values = with_times ? times_s() : std::vector<double>{};
  for (const auto& more : {torques_N_m(), angles_rad()}) {
    values.insert(values.end(), more.begin(), more.end());
  }
  return numbers(values, {kSamples, values.size() / kSamples});
}

TEST_F(MatUnits, AListOfUnitsBesideAListOfNamesIsTheirs) {
  const auto expect_units = [](const ForeignFile& file) {
    expect_told(file);
    for (const auto& [name, unit] : {std::pair{"tau", "N m"}, std::pair{"theta", "deg"}}) {
      const auto& signal = file.table.columns[find_column(file.table, name)];
      EXPECT_EQ(signal.unit, unit);
    }
  };
  const auto names = [] { return cells(1, 2, {text("tau"), text("theta")}); };
  const auto units = [] { return cells(1, 2, {text("Nm"), text("deg")}); };
  for (const auto* called : {"units", "Unit", "channel_units", "Einheiten"}) {
    expect_units(read({{"t", column(times_s())},
                       {"names", names()},
                       {called, units()},
                       {"data", matrix(false)}}));
  }
  expect_units(read({{"units", cells(3, 1, {text("s"), text("N*m"), text("degrees")})},
                     {"labels", cells(3, 1, {text("t"), text("tau"), text("theta")})},
                     {"data", matrix(true)}}));
  expect_units(read({{"log", structures({{{"t", column(times_s())},
                                          {"names", names()},
                                          {"units", units()},
                                          {"data", matrix(false)}}})}}));
  expect_units(read({{"t", column(times_s())},
                     {"names", names()},
                     {"units", units()},
                     {"log", cells(1, 2, {column(torques_N_m()), column(angles_rad())})}}));
  expect_units(read(
      {{"log", cells(3, 3,
                     {text("t"), text("s"), column(times_s()), text("tau"), text("Nm"),
                      column(torques_N_m()), text("theta"), text("deg"), column(angles_rad())})}}));
}

TEST_F(MatUnits, RowsOfAMatrixOfLettersAreAList) {
  const auto rows_of = [](std::string letters) {  // of two rows, column by column
    std::array<std::size_t, 2> size{2, letters.size() / 2};
    return Mat_VarCreate(nullptr, MAT_C_CHAR, MAT_T_UINT8, 2, size.data(), letters.data(), 0);
  };
  const auto file = read({{"t", column(times_s())},
                          {"names", rows_of("ttahue t a")},
                          {"units", rows_of("Nd emg")},
                          {"data", matrix(false)}});
  EXPECT_THAT(names_in(file), ElementsAre("t", "tau", "theta"));
  EXPECT_EQ(file.table.columns[1].unit, "N m");
  EXPECT_EQ(file.table.columns[2].unit, "deg");
}

TEST_F(MatUnits, TwoListsOfTheSameNamesAreOne) {
  const auto names = [] { return cells(1, 2, {text("torque [N m]"), text("theta [deg]")}); };
  const auto file = read(
      {{"A",
        structures({{{"data", matrix(false)}, {"textdata", names()}, {"colheaders", names()}}})}});
  EXPECT_THAT(names_in(file), ElementsAre("torque [N m]", "theta [deg]"));
  EXPECT_EQ(file.table.columns[1].unit, "deg");
}

TEST_F(MatUnits, AListOfUnitsThatDoesNotFitIsRefused) {
  const auto refusal = [&](const std::vector<Field>& variables) {
    try {
      read(variables);
    } catch (const arm::InputError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_THAT(refusal({{"t", column(times_s())},
                       {"names", cells(1, 2, {text("tau"), text("theta")})},
                       {"units", cells(1, 3, {text("s"), text("Nm"), text("deg")})},
                       {"data", matrix(false)}}),
              HasSubstr("log.mat: a list of 3 units beside one of 2 names, tau, theta; must be one "
                        "for each"));
  EXPECT_THAT(refusal({{"t", column(times_s())},
                       {"names", cells(1, 2, {text("tau"), text("theta [rad]")})},
                       {"units", cells(1, 2, {text("Nm"), text("deg")})},
                       {"data", matrix(false)}}),
              HasSubstr("theta [rad]: in rad by its name, in deg by the list of units; must be the "
                        "same"));
}

TEST_F(MatUnits, AUnitToldByTheNameOfASignalIsRead) {
  const auto units_told = [&](const std::vector<Field>& variables) {
    std::vector<std::string> units;
    const auto file = read(variables);
    for (const auto& one : file.table.columns) units.push_back(one.unit);
    EXPECT_THAT(file.left_out, testing::IsEmpty());
    return units;
  };
  const auto units = [] { return structures({{{"tau", text("mNm")}, {"t", text("ms")}}}); };
  const auto signals = [](const std::vector<Field>& more) {
    std::vector<Field> fields = {{"t", column(times_s())}, {"tau", column(torques_N_m())}};
    fields.insert(fields.end(), more.begin(), more.end());
    return fields;
  };
  const auto both = ElementsAre("ms", "N mm");
  EXPECT_THAT(units_told(signals({{"units", units()}})), both);
  EXPECT_THAT(units_told({{"s", structures({signals({{"units", units()}})})}}), both);
  EXPECT_THAT(units_told({{"s", structures({signals({})})}, {"Units", units()}}), both);
  EXPECT_THAT(units_told(signals({{"tau_unit", text("mNm")}, {"tUnits", text("ms")}})), both);
  EXPECT_THAT(
      units_told(
          {{"s", structures({signals({{"tau_Unit", text("mNm")}, {"t_units", text("ms")}})})}}),
      both);
  EXPECT_THAT(units_told({{"tau", structures({{{"value", column(torques_N_m())}}})},
                          {"tau_units", text("mNm")}}),
              ElementsAre("N mm"));
}

TEST_F(MatUnits, AUnitToldByANameThatDoesNotFitIsRefused) {
  const auto refusal = [&](const std::vector<Field>& variables) {
    try {
      read(variables);
    } catch (const arm::InputError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_THAT(
      refusal({{"tau_Nm", column(torques_N_m())}, {"tau_Nm_unit", text("mNm")}}),
      HasSubstr("tau_Nm: in N m by its name, in N mm by the unit beside it; must be the same"));
  EXPECT_THAT(
      refusal({{"theta", column(angles_rad())}, {"units", structures({{{"angle", text("deg")}}})}}),
      HasSubstr("units.angle = deg: no signal has this name; must be one of theta"));
  EXPECT_THAT(refusal({{"theta", column(angles_rad())},
                       {"units", structures({{{"theta", text("deg")}}})},
                       {"theta_unit", text("rad")}}),
              HasSubstr("has another unit; must be the same"));
  EXPECT_EQ(refusal({{"theta", column(angles_rad())},
                     {"length", column({1.0})},
                     {"units", structures({{{"length", text("m")}, {"rig", text("B-17")}}})}}),
            "accepted");
}

TEST_F(MatUnits, AScaleBesideASignalIsSaidToBeUnapplied) {
  const auto file = read({{"tau", structures({{{"value", column(torques_N_m())},
                                               {"scale", column({2.0})},
                                               {"gain", column({1.0})},
                                               {"offset", column({0.1})}}})}});
  EXPECT_THAT(file.table.assumptions,
              ElementsAre("tau.scale = 2 is not applied to the signal beside it; if the numbers "
                          "lack it, state it as SCALE in --column",
                          "tau.offset = 0.1 is not applied to the signal beside it; if the numbers "
                          "lack it, add it in the file"));
}

TEST_F(MatUnits, ARateOrPeriodWithoutTimesMakesThem) {
  using Setting = std::tuple<const char*, double, const char*>;
  for (const auto& [name, value, unit] : {Setting{"fs", 250.0, ""}, Setting{"Ts", 0.004, ""},
                                          Setting{"dt", 4.0, "ms"}, Setting{"Fs", 0.25, "kHz"}}) {
    std::vector<Field> variables = {{"tau", column(torques_N_m())}, {name, column({value})}};
    const std::string name_of_unit = std::string(name) + "_unit";
    if (*unit != '\0') variables.emplace_back(name_of_unit.c_str(), text(unit));
    const auto file = read(variables);
    ASSERT_EQ(file.table.columns.size(), 2U) << name;
    EXPECT_TRUE(file.table.columns[1].is_made) << name;
    EXPECT_NEAR(file.table.columns[1].values[2], 0.008, 1e-15) << name;
    EXPECT_THAT(file.left_out, testing::IsEmpty()) << name;
  }
}

TEST_F(MatUnits, BesideTimesTheUnitOfWIsThatOfAVelocity) {
  const auto file = read({{"s", structures({{{"t", column(times_s())},
                                             {"w", column(angles_rad())},
                                             {"unit", text("deg/s")}}})}});
  ASSERT_EQ(file.table.columns.size(), 2U);
  EXPECT_EQ(file.table.columns[1].unit, "deg/s");
}

TEST(MatText, CodeUnitsBecomeUtf8) {
  using Units = std::vector<double>;
  EXPECT_EQ(text_of_units(Units{'d', 0xb0}), "d\xc2\xb0");
  EXPECT_EQ(text_of_units(Units{0xd835, 0xdf03}), "\xf0\x9d\x9c\x83");
  EXPECT_EQ(text_of_units(Units{}), "");
  for (const Units& none : {Units{0xd835}, Units{0xdf03, 'a'}, Units{'\n'}, Units{65.5},
                            Units{-1.0}, Units{65536.0}, Units{0x7f}}) {
    EXPECT_EQ(text_of_units(none), std::nullopt) << none.front();
  }
}

TEST(MatLevel73, AUnitBeyondAsciiIsRead) {
  const auto file = read_foreign_file(file_of_level73("units.mat"));
  EXPECT_THAT(names_in(file), ElementsAre("time", "torque", "theta"));
  EXPECT_EQ(file.table.columns[1].unit, "N m");
  EXPECT_EQ(file.table.columns[2].unit, "deg");
}

}  // namespace
}  // namespace flexarm::measured
