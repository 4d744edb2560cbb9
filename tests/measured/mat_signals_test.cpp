// Signals in the shapes in which Simulink, dSPACE and scripts save them, of every level.
#include "arm/input_error.hpp"
#include "measured/files/column_guess.hpp"
#include "measured/files/foreign_file.hpp"
#include "measured/files/mat_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <matio.h>
#include <memory>
#include <string>
#include <vector>

namespace flexarm::measured {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::size_t kSamples = 12;
/// Sines below 0.1 of another library, by their last digit.
constexpr double kOtherSine = 0x1p-56;

std::vector<double> times_s() {
  std::vector<double> values;
  for (std::size_t k = 0; k < kSamples; ++k) values.push_back(0.004 * static_cast<double>(k));
  return values;
}

std::vector<double> torques_N_m() {
  std::vector<double> values;
  for (const double time_s : times_s()) values.push_back(0.1 * std::sin(9.0 * time_s));
  return values;
}

std::vector<double> angles_rad() {
  std::vector<double> values;
  for (const double time_s : times_s()) values.push_back(0.05 * std::sin(8.0 * time_s));
  return values;
}

matvar_t* numbers(const std::vector<double>& values, std::vector<std::size_t> size) {
  std::vector<double> copy = values;
  return Mat_VarCreate(nullptr, MAT_C_DOUBLE, MAT_T_DOUBLE, static_cast<int>(size.size()),
                       size.data(), copy.data(), 0);
}

matvar_t* column(const std::vector<double>& values) {
  return numbers(values, {values.size(), 1});
}

matvar_t* text(std::string letters) {
  std::array<std::size_t, 2> size{letters.empty() ? 0U : 1U, letters.size()};
  return Mat_VarCreate(nullptr, MAT_C_CHAR, MAT_T_UINT8, 2, size.data(), letters.data(), 0);
}

using Field = std::pair<const char*, matvar_t*>;

/// Structures, each with the same fields.
matvar_t* structures(const std::vector<std::vector<Field>>& elements) {
  std::array<std::size_t, 2> size{1, elements.size()};
  std::vector<const char*> names;
  for (const auto& [name, value] : elements.front()) names.push_back(name);
  matvar_t* made = Mat_VarCreateStruct(nullptr, 2, size.data(), names.data(),
                                       static_cast<unsigned>(names.size()));
  for (std::size_t k = 0; k < elements.size(); ++k) {
    for (const auto& [name, value] : elements[k]) Mat_VarSetStructFieldByName(made, name, k, value);
  }
  return made;
}

matvar_t* cells(std::size_t rows, std::size_t columns, const std::vector<matvar_t*>& values) {
  std::array<std::size_t, 2> size{rows, columns};
  matvar_t* made = Mat_VarCreate(nullptr, MAT_C_CELL, MAT_T_CELL, 2, size.data(), nullptr, 0);
  for (std::size_t k = 0; k < values.size(); ++k) {
    Mat_VarSetCell(made, static_cast<int>(k), values[k]);
  }
  return made;
}

class MatSignals : public testing::Test {
 protected:
  MatSignals() {
    std::string name = (std::filesystem::temp_directory_path() / "flexarm-test-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
  }
  ~MatSignals() override { std::filesystem::remove_all(folder_); }

  ForeignFile read(const std::vector<Field>& variables) const {
    const auto path = folder_ / "log.mat";
    {
      const std::unique_ptr<mat_t, int (*)(mat_t*)> file(
          Mat_CreateVer(path.c_str(), nullptr, MAT_FT_MAT5), Mat_Close);
      for (const auto& [name, value] : variables) {
        value->name = ::strdup(name);
        Mat_VarWrite(file.get(), value, MAT_COMPRESSION_NONE);
        Mat_VarFree(value);
      }
    }
    return read_foreign_file(path);
  }

  std::filesystem::path folder_;
};

/// A file of level 7.3 among the seeds of the fuzzers, which matlab_73_file.py beside them makes.
std::filesystem::path file_of_level73(const char* name) {
  return std::filesystem::path(FLEXARM_SOURCE_DIR "/tests/fuzz/seeds/matlab_73_file") / name;
}

/// The values of the columns that are taken for time, torque and hub angle.
void expect_told(const ForeignFile& file, double tolerance = 0.0) {
  std::vector<ColumnLabel> labels;
  for (const auto& column : file.table.columns) {
    labels.push_back({column.name, column.unit, column.is_text(), column.is_stamp, column.path});
  }
  const auto guess = guess_columns(labels, {});
  const std::array expected{std::pair{"time", times_s()}, std::pair{"torque", torques_N_m()},
                            std::pair{"hub_angle", angles_rad()}};
  for (const auto& [quantity, values] : expected) {
    const auto mapping = guess.mappings.find(quantity);
    ASSERT_NE(mapping, guess.mappings.end()) << quantity;
    const auto& read = file.table.columns[find_column(file.table, mapping->second.name)].values;
    ASSERT_EQ(read.size(), values.size()) << quantity;
    for (std::size_t k = 0; k < values.size(); ++k) {
      EXPECT_NEAR(read[k], values[k], tolerance) << quantity;
    }
  }
}

std::vector<std::string> names_in(const ForeignFile& file) {
  std::vector<std::string> names;
  for (const auto& column : file.table.columns) names.push_back(column.name);
  return names;
}

TEST_F(MatSignals, AStructureWithTimeOfSeveralSignalsHasTheirLabels) {
  const auto file =
      read({{"ScopeData",
             structures(
                 {{{"time", column(times_s())},
                   {"signals",
                    structures({{{"values", column(torques_N_m())}, {"label", text("torque")}},
                                {{"values", column(angles_rad())}, {"label", text("hub angle")}}})},
                   {"blockName", text("rig/Scope")}}})}});
  expect_told(file);
  EXPECT_EQ(file.table.columns[1].path, "ScopeData.signals(1).values");
  EXPECT_TRUE(file.left_out.empty());
}

TEST_F(MatSignals, WithoutLabelsThePathsAreTheNames) {
  const auto signal = [&](const std::vector<double>& values) {
    return std::vector<Field>{{"values", column(values)}, {"label", text("")}};
  };
  const auto file = read(
      {{"S",
        structures({{{"time", column(times_s())},
                     {"signals", structures({signal(torques_N_m()), signal(angles_rad())})}}})}});
  EXPECT_THAT(names_in(file), ElementsAre("S.time", "S.signals(1).values", "S.signals(2).values"));
}

TEST_F(MatSignals, StructuresNamedByTheirVariableShareATime) {
  const auto with_time = [&](const std::vector<double>& values) {
    return structures(
        {{{"time", column(times_s())},
          {"signals", structures({{{"values", column(values)}, {"label", text("")}}})}}});
  };
  const auto file =
      read({{"torque", with_time(torques_N_m())}, {"theta", with_time(angles_rad())}});
  expect_told(file);
  EXPECT_THAT(file.left_out, ElementsAre("theta.time: the same times as torque.time"));
}

TEST_F(MatSignals, StructArraysOfARecorderHaveTheNamesOfTheirBlocks) {
  const auto row = [](const std::vector<double>& values) {
    return numbers(values, {1, values.size()});
  };
  const auto file = read(
      {{"rec1",
        structures({{{"X", structures({{{"Name", text("HostService")}, {"Data", row(times_s())}}})},
                     {"Y", structures({{{"Name", text("\"Model Root\"/\"torque\"/\"Out1\"")},
                                        {"Unit", text("Nm")},
                                        {"Data", row(torques_N_m())}},
                                       {{"Name", text("Platform()://Model Root/hub angle/Value")},
                                        {"Unit", text("rad")},
                                        {"Data", row(angles_rad())}},
                                       {{"Name", text("Model Root/spare")},
                                        {"Unit", text("")},
                                        {"Data", row(angles_rad())}}})}}})}});
  expect_told(file);
  EXPECT_THAT(names_in(file), ElementsAre("time", "torque", "hub angle", "spare"));
  EXPECT_EQ(file.table.columns[1].unit, "N m");
}

TEST_F(MatSignals, CellsAreSignalsWithTheNamesAboveThem) {
  const auto bare = read(
      {{"log", cells(1, 3, {column(times_s()), column(torques_N_m()), column(angles_rad())})}});
  EXPECT_THAT(names_in(bare), ElementsAre("log{1}", "log{2}", "log{3}"));
  expect_told(read({{"log", cells(2, 3,
                                  {text("t"), column(times_s()), text("torque"),
                                   column(torques_N_m()), text("theta"), column(angles_rad())})}}));
}

TEST_F(MatSignals, ADatasetSavedAsStructuresIsRead) {
  const auto element = [](const char* name, const std::vector<double>& values, const char* unit) {
    return structures(
        {{{"Name", text(name)},
          {"Values", structures({{{"Time", column(times_s())},
                                  {"Data", column(values)},
                                  {"DataInfo", structures({{{"Units", text(unit)}}})}}})}}});
  };
  const auto file = read({{"logsout", cells(2, 1,
                                            {element("torque", torques_N_m(), "N m"),
                                             element("theta", angles_rad(), "rad")})}});
  expect_told(file);
  EXPECT_THAT(file.left_out, Contains(HasSubstr("logsout{2}.Values.Time: the same times")));
}

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

TEST_F(MatSignals, AUnitBeyondAsciiIsRead) {
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

TEST_F(MatSignals, AUnitThatIsNotReadIsRefused) {
  std::array<std::size_t, 2> two_rows{2, 3};
  std::string letters = "ddeegg";
  try {
    read({{"a", structures({{{"t", column(times_s())},
                             {"theta", column(angles_rad())},
                             {"Unit", Mat_VarCreate(nullptr, MAT_C_CHAR, MAT_T_UINT8, 2,
                                                    two_rows.data(), letters.data(), 0)}}})}});
    FAIL() << "accepted";
  } catch (const arm::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("a.Unit: a text of several rows"));
    EXPECT_THAT(error.what(), HasSubstr("must be a text of one row"));
  }
}

TEST_F(MatSignals, HowASignalIsDrawnIsNoSignal) {
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

TEST_F(MatSignals, TheUnitOfFrequenciesIsThatBesideThemOrSaidToBeAssumed) {
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

TEST_F(MatSignals, BesideTimesTheUnitOfWIsThatOfAVelocity) {
  const auto file = read({{"s", structures({{{"t", column(times_s())},
                                             {"w", column(angles_rad())},
                                             {"unit", text("deg/s")}}})}});
  ASSERT_EQ(file.table.columns.size(), 2U);
  EXPECT_EQ(file.table.columns[1].unit, "deg/s");
}

TEST_F(MatSignals, ValuesBehindTwoOnesAndLinesOfArraysAreVectors) {
  std::vector<double> both;
  for (std::size_t k = 0; k < kSamples; ++k) {
    both.push_back(angles_rad()[k]);
    both.push_back(2.0 * angles_rad()[k]);
  }
  const auto file = read({{"t", column(times_s())},
                          {"torque", numbers(torques_N_m(), {1, 1, kSamples})},
                          {"theta", numbers(angles_rad(), {1, 1, kSamples})},
                          {"both", numbers(both, {2, 1, kSamples})}});
  expect_told(file);
  EXPECT_THAT(names_in(file), ElementsAre("t", "torque", "theta", "both(1,1,:)", "both(2,1,:)"));
  EXPECT_EQ(file.table.columns[3].values, angles_rad());
}

TEST_F(MatSignals, RowsOfAMatrixAreSignals) {
  std::vector<double> rows;
  for (std::size_t k = 0; k < kSamples; ++k) {
    for (const auto& values : {times_s(), torques_N_m(), angles_rad()}) rows.push_back(values[k]);
  }
  const auto bare = read({{"data", numbers(rows, {3, kSamples})}});
  EXPECT_THAT(names_in(bare), ElementsAre("data(1,:)", "data(2,:)", "data(3,:)"));
  EXPECT_EQ(bare.table.columns[2].values, angles_rad());
  expect_told(read({{"data", numbers(rows, {3, kSamples})},
                    {"names", cells(3, 1, {text("time"), text("torque"), text("theta")})}}));
}

TEST_F(MatSignals, AStructureASampleIsAVectorAField) {
  std::vector<std::vector<Field>> samples;
  for (std::size_t k = 0; k < kSamples; ++k) {
    samples.push_back({{"time", column({times_s()[k]})},
                       {"torque", column({torques_N_m()[k]})},
                       {"theta", column({angles_rad()[k]})}});
  }
  expect_told(read({{"log", structures(samples)}}));
}

TEST(MatLevel73, HasTheShapesOfTheOthers) {
  expect_told(read_foreign_file(file_of_level73("structure.mat")), kOtherSine);
  expect_told(read_foreign_file(file_of_level73("cells.mat")), kOtherSine);
}

TEST(MatLevel73, ClassesOfNumbersAndResponsesAreRead) {
  const auto file = read_foreign_file(file_of_level73("classes.mat"));
  EXPECT_EQ(file.format, ForeignFormat::matlab73);
  constexpr double kSinglePrecision = 1e-8;  // of 0.1
  const auto& columns = file.table.columns;
  ASSERT_THAT(names_in(file), ElementsAre("f", "t_ms", "theta", "torque"));
  for (std::size_t k = 0; k < kSamples; ++k) {
    EXPECT_EQ(columns[1].values[k], 4.0 * static_cast<double>(k));
    EXPECT_NEAR(columns[2].values[k], angles_rad()[k], kOtherSine);
    EXPECT_NEAR(columns[3].values[k], torques_N_m()[k], kSinglePrecision);
  }
  ASSERT_EQ(file.responses.size(), 1U);
  EXPECT_EQ(file.responses[0].response[2], std::complex<double>(1.0, times_s()[2]));
}

std::string refusal(const std::filesystem::path& path) {
  try {
    read_foreign_file(path);
  } catch (const arm::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(MatLevel73, ObjectsAreNamedWithTheWayOut) {
  EXPECT_THAT(refusal(file_of_level73("objects.mat")),
              AllOf(HasSubstr("ti: an object of class timeseries"), HasSubstr("s.time = ti.Time"),
                    HasSubstr("table2struct(ta, 'ToScalar', true)")));
}

TEST(MatLevel73, AReferenceToItselfEnds) {
  EXPECT_THAT(refusal(file_of_level73("circular.mat")),
              HasSubstr("is damaged: structures within structures without end"));
}

TEST_F(MatSignals, AFileOfLevel73ThatIsCutOffIsRefused) {
  std::ifstream whole(file_of_level73("structure.mat"), std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(whole), {}};
  for (const std::size_t size : {200U, 512U, 600U, 3000U, 9000U}) {
    std::ofstream(folder_ / "cut.mat", std::ios::binary) << bytes.substr(0, size);
    EXPECT_THAT(refusal(folder_ / "cut.mat"), HasSubstr("cut.mat: is cut off or damaged")) << size;
  }
}

/// A number of four bytes, little or big endian.
std::string four_bytes(std::uint32_t value, bool little_endian) {
  std::string bytes;
  for (unsigned i = 0; i < 4; ++i) {
    const unsigned shift = 8 * (little_endian ? i : 3 - i);
    bytes += static_cast<char>((value >> shift) & 0xffU);
  }
  return bytes;
}

/// A matrix of 16-bit numbers of level 4, which has no other head.
std::string level4(const std::string& name, const std::vector<std::int16_t>& values,
                   bool little_endian) {
  const std::array<std::uint32_t, 5> head{little_endian ? 30U : 1030U,
                                          static_cast<std::uint32_t>(values.size()), 1, 0,
                                          static_cast<std::uint32_t>(name.size() + 1)};
  std::string bytes;
  for (const auto word : head) bytes += four_bytes(word, little_endian);
  bytes += name + '\0';
  for (const auto value : values) {
    const auto code = static_cast<std::uint16_t>(value);
    const std::array halves{static_cast<char>(code & 0xffU), static_cast<char>(code >> 8U)};
    bytes += little_endian ? std::string{halves[0], halves[1]} : std::string{halves[1], halves[0]};
  }
  return bytes;
}

TEST_F(MatSignals, Level4IsReadInEitherByteOrder) {
  for (const bool little_endian : {true, false}) {
    const std::string bytes =
        level4("t", {0, 1, 2}, little_endian) + level4("tau", {-5, 300, 0}, little_endian);
    const auto path = folder_ / "v4.mat";
    std::ofstream(path, std::ios::binary) << bytes;
    const auto file = read_foreign_file(path);
    EXPECT_EQ(file.format, ForeignFormat::matlab4);
    ASSERT_THAT(names_in(file), ElementsAre("t", "tau"));
    EXPECT_THAT(file.table.columns[1].values, ElementsAre(-5.0, 300.0, 0.0));
    std::ofstream(path, std::ios::binary) << bytes.substr(0, bytes.size() - 1);
    EXPECT_THAT(refusal(path), HasSubstr("v4.mat: is cut off"));
  }
}

}  // namespace
}  // namespace flexarm::measured
