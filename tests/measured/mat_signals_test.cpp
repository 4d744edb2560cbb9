// Signals in the shapes in which Simulink, dSPACE and scripts save them, of every level.
#include "arm/input_error.hpp"
#include "measured/files/column_guess.hpp"
#include "measured/files/foreign_file.hpp"
#include "measured/files/mat_file.hpp"
#include "tests/measured/mat_structures.hpp"

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
