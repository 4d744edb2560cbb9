#include "measured/files/universal_file.hpp"

#include "arm/input_error.hpp"
#include "measured/files/universal_grid.hpp"
#include "tests/measured/any_finite.hpp"
#include "tests/measured/mistake.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

namespace flexarm::measured {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

bool is_same(const std::vector<double>& a, const std::vector<double>& b) {
  return std::ranges::equal(a, b, [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  });
}

UniversalFunction function_of(std::mt19937_64& random, std::vector<double> abscissa,
                              bool is_complex) {
  UniversalFunction function;
  function.id = {"strain@0.05 [1]", "run 3", "20-Nov-26 11:00:00", "NONE", "NONE"};
  function.type = is_complex ? kUniversalFrequencyResponse : kUniversalTimeResponse;
  function.number = 7;
  function.version = 2;
  function.load_case = 1;
  function.response = {"BEAM", 12, -3};
  function.reference = {"HUB", 1, 6};
  function.z = 0.5;
  function.abscissa_axis = {17, 0, 0, 0, "Time", "s"};
  function.ordinate_axis = {0, -1, 2, 3, "strain", "1"};
  function.denominator_axis = {0, 1, 1, 0, "torque", "N m"};
  function.abscissa = std::move(abscissa);
  for (std::size_t i = 0; i < function.abscissa.size(); ++i) {
    function.real.push_back(any_finite(random));
    if (is_complex) function.imaginary.push_back(any_finite(random));
  }
  function.real[0] = -0.0;
  return function;
}

std::vector<double> grid(std::size_t points, double first, double step) {
  std::vector<double> values(points);
  for (std::size_t k = 0; k < points; ++k) values[k] = first + static_cast<double>(k) * step;
  return values;
}

std::vector<double> uneven(std::mt19937_64& random, std::size_t points) {
  std::uniform_real_distribution<double> step(1e-3, 1.0);
  std::vector<double> values(points);
  double sum = -3.0;
  for (auto& value : values) value = sum += step(random);
  return values;
}

using Form = std::tuple<bool, bool, bool>;  // binary, big endian, complex

class UniversalRoundTrip : public testing::TestWithParam<Form> {};

TEST_P(UniversalRoundTrip, LosesNothingInDoublePrecision) {
  const auto& [binary, big_endian, is_complex] = GetParam();
  std::mt19937_64 random(20261123);
  std::vector<UniversalFunction> functions = {
      function_of(random, grid(101, 0.0, 0.002), is_complex),
      function_of(random, grid(77, 0.1, 1.0 / 300.0), is_complex),
      function_of(random, uneven(random, 50), is_complex),
      function_of(random, grid(1, 4.0, 1.0), is_complex)};
  const auto read =
      parse_universal_file(format_universal_file(functions, {binary, big_endian, false}), "f");
  ASSERT_EQ(read.functions.size(), functions.size());
  for (std::size_t i = 0; i < functions.size(); ++i) {
    EXPECT_EQ(read.functions[i], functions[i]) << i;
    EXPECT_TRUE(is_same(read.functions[i].abscissa, functions[i].abscissa)) << i;
    EXPECT_TRUE(is_same(read.functions[i].real, functions[i].real)) << i;
    EXPECT_TRUE(is_same(read.functions[i].imaginary, functions[i].imaginary)) << i;
  }
}

/// Half a unit in the 24th bit, or in the 6th digit.
TEST_P(UniversalRoundTrip, RoundsInSinglePrecisionAsSaid) {
  const auto& [binary, big_endian, is_complex] = GetParam();
  const double relative = binary ? 0x1p-24 : 5e-6;
  std::mt19937_64 random(20261124);
  std::uniform_real_distribution<double> uniform(-1e3, 1e3);
  UniversalFunction function = function_of(random, uneven(random, 60), is_complex);
  for (auto& value : function.real) value = uniform(random);
  for (auto& value : function.imaginary) value = uniform(random);
  const auto read =
      parse_universal_file(format_universal_file({function}, {binary, big_endian, true}), "f");
  ASSERT_EQ(read.functions.size(), 1U);
  const auto expect_near = [&](const std::vector<double>& a, const std::vector<double>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      EXPECT_LE(std::abs(a[i] - b[i]), relative * std::abs(b[i]));
    }
  };
  expect_near(read.functions[0].abscissa, function.abscissa);
  expect_near(read.functions[0].real, function.real);
  expect_near(read.functions[0].imaginary, function.imaginary);
}

INSTANTIATE_TEST_SUITE_P(, UniversalRoundTrip,
                         testing::Combine(testing::Bool(), testing::Bool(), testing::Bool()),
                         [](const auto& form) {
                           return fmt::format(
                               "{}{}{}", std::get<0>(form.param) ? "Binary" : "Text",
                               std::get<1>(form.param) ? "BigEndian" : "LittleEndian",
                               std::get<2>(form.param) ? "Complex" : "Real");
                         });

TEST(UniversalGrid, PointsAreTheNearestDoublesToTheDecimals) {
  const auto points = grid_points({0.1, 0.003}, 1000);
  for (std::size_t k = 0; k < points.size(); ++k) {
    EXPECT_EQ(points[k], static_cast<double>(100 + 3 * k) / 1000.0);
  }
}

TEST(UniversalGrid, AWholeRateIsSeenThroughSixDigits) {
  EXPECT_EQ(grid_points({0.0, 1.66667e-3}, 601)[600], 1.0);
  EXPECT_EQ(grid_points({0.0, 1.52588e-5}, 65537)[65536], 1.0);
  // 0.244141 is 500/2048 rounded, which is 1/n for no whole n.
  EXPECT_EQ(grid_points({0.0, 0.244141}, 3)[2], 0.488282);
  // More digits than six are meant as they are.
  EXPECT_EQ(grid_points({0.0, 1.6666668e-3}, 2)[1], 1.6666668e-3);
}

constexpr const char* kHead58 =
    "    -1\n    58\nacc\nNONE\n18-Apr-16 13:49:58\nNONE\nNONE\n"
    "    1         0    0         0 Mic 01             3  -3 NONE               0   0\n";
constexpr const char* kAxes =
    "        17    0    0    0 time                 s                   \n"
    "        12    0    0    0 Acceleration         m/s^2               \n"
    "         0    0    0    0 NONE                 NONE                \n"
    "         0    0    0    0 NONE                 NONE                \n";

std::string sample(const std::string& form, const std::string& data) {
  return kHead58 + form + kAxes + data + "    -1\n";
}

TEST(UniversalFile, ForeignLayoutsAreRead) {
  const auto read = [](const std::string& form, const std::string& data) {
    return parse_universal_file(sample(form, data), "f").functions.at(0);
  };
  const auto even = read("         2         7         1  0.00000E+00  5.00000E-03  0.00000E+00\n",
                         " -1.47553E-02 -1.72957E-02 -1.66101E-02 -1.61988E-02 -1.68925E-02 "
                         "-1.53669E-02\n -1.44522E-02\n");
  EXPECT_EQ(even.id[0], "acc");
  EXPECT_EQ(even.response, (UniversalPlace{"Mic 01", 3, -3}));
  EXPECT_EQ(even.ordinate_axis.units, "m/s^2");
  EXPECT_EQ(even.abscissa[6], 0.03);
  EXPECT_EQ(even.real[6], -1.44522e-2);
  EXPECT_TRUE(even.imaginary.empty());
  // Numbers that abut are told apart by their columns.
  const auto abutting =
      read("         4         3         1  0.00000E+00  5.00000E-03  0.00000E+00\n",
           "-1.0000000000000E-02-2.0000000000000E-02-3.0000000000000E+99\n");
  EXPECT_THAT(abutting.real, ElementsAre(-1e-2, -2e-2, -3e99));
  const auto complex =
      read("         6         2         0  0.00000E+00  0.00000E+00  0.00000E+00\n",
           "  1.00000E+00  1.000000000000D+00  2.000000000000D+00\n"
           "  2.50000E+00  3.000000000000D+00  4.000000000000D+00\n");
  EXPECT_THAT(complex.abscissa, ElementsAre(1.0, 2.5));
  EXPECT_THAT(complex.imaginary, ElementsAre(2.0, 4.0));
}

TEST(UniversalFile, OtherDataSetsArePassedOver) {
  const std::string file =
      "    -1\n   151\nmodel\n0\n    -1\n    -1\n   164\n         1  SI\n    -1\n" +
      sample("         2         1         1  0.00000E+00  1.00000E+00  0.00000E+00\n",
             "  1.00000E+00\n") +
      "\r\n    -1\r\n    15\r\n    -1\r\n";
  const auto read = parse_universal_file(file, "f");
  EXPECT_EQ(read.functions.size(), 1U);
  EXPECT_THAT(read.passed_over, ElementsAre("151", "164", "15"));
}

TEST(UniversalFile, WhatIsNotFiniteIsNeitherWrittenNorRead) {
  std::mt19937_64 random(20261125);
  UniversalFunction function = function_of(random, grid(3, 0.0, 1.0), false);
  function.real[1] = std::numeric_limits<double>::infinity();
  EXPECT_THROW(format_universal_file({function}), arm::InputError);
  function.real = {1.0, 1e300, 2.0};
  EXPECT_THROW(format_universal_file({function}, {true, false, true}), arm::InputError);
  function.real.pop_back();
  EXPECT_THROW(format_universal_file({function}), std::invalid_argument);
  function.real.push_back(3.0);
  std::string bytes = format_universal_file({function}, {true, false, false});
  bytes.replace(bytes.size() - 8 - 7, 8, std::string("\0\0\0\0\0\0\xf0\x7f", 8));
  EXPECT_THROW(parse_universal_file(bytes, "f"), arm::InputError);
}

/// What a hand or a disk does to a file.
TEST(UniversalFile, MutatedFilesGiveARecordOrOneLine) {
  std::mt19937_64 random(20261126);
  constexpr int kFiles = 2000;
  for (const bool binary : {false, true}) {
    std::vector<UniversalFunction> functions = {function_of(random, grid(9, 0.0, 0.002), false),
                                                function_of(random, uneven(random, 5), true)};
    const std::string good = format_universal_file(functions, {binary, false, false});
    const auto expect_result_or_line = [](const std::string& bytes) {
      try {
        parse_universal_file(bytes, "f");
      } catch (const arm::InputError& error) {
        EXPECT_EQ(std::string(error.what()).find_first_of("\r\n"), std::string::npos);
      }
    };
    for (int i = 0; i < kFiles; ++i) {
      expect_result_or_line(good.substr(0, random() % good.size()));
      std::string bytes = good;
      for (auto changes = 1 + random() % 4; changes > 0; --changes) {
        bytes[random() % bytes.size()] = static_cast<char>(random() % 256);
      }
      expect_result_or_line(bytes);
    }
  }
}

const std::vector<Mistake> kUniversalFileMistakes = {
    {"Empty", "\n", "1: empty; must have one data set 58 or more"},
    {"NoUniversalFile", "t,u\n0,1\n",
     "1: not a universal file: a data set begins with a line of -1 alone"},
    {"NoDataSet58", "    -1\n   151\n    -1\n",
     "3: has no data set 58, which holds time and frequency responses, nor 55, which holds modes"},
    {"CutOffInTheHead", std::string(kHead58), "8: file incomplete"},
    {"CutOffInTheNumbers",
     sample("         2         7         1  0.00000E+00  5.00000E-03  0.00000E+00\n",
            " 1.0 2.0 3.0\n"),
     "15: incomplete data set: 3 of 7 numbers"},
    {"MorePointsThanBytes",
     sample("         2 999999999         1  0.00000E+00  5.00000E-03  0.00000E+00\n", " 1.0\n"),
     "9: number of points = 999999999: must be from 1 to 142, which the file has room for"},
    {"FormUnknown",
     sample("         3         1         1  0.00000E+00  5.00000E-03  0.00000E+00\n", " 1.0\n"),
     "9: ordinate data type = 3: must be 2 or 4, real in single or double precision, or 5 or 6, "
     "complex"},
    {"NotANumber",
     sample("         2         2         1  0.00000E+00  5.00000E-03  0.00000E+00\n", " 1.0 x\n"),
     "14: 1.0 x: must be a number in 13 columns"},
    {"StepZero",
     sample("         2         2         1  0.00000E+00  0.00000E+00  0.00000E+00\n",
            " 1.0 1.0\n"),
     "9: abscissa increment = 0: must be above 0"},
};

class UniversalMistake : public testing::TestWithParam<Mistake> {};

TEST_P(UniversalMistake, GivesOneLineWithPlaceReasonAndRemedy) {
  expect_line(GetParam(), "run.uff", parse_universal_file);
}

INSTANTIATE_TEST_SUITE_P(, UniversalMistake, testing::ValuesIn(kUniversalFileMistakes),
                         name_of_mistake);

}  // namespace
}  // namespace flexarm::measured
