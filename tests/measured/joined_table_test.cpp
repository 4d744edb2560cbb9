#include "measured/files/joined_table.hpp"

#include "arm/input_error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace flexarm::measured {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TimedSignals signal(const std::string& file, const std::string& column, double from_s,
                    double period_s, std::size_t samples, double (*value)(double time_s)) {
  TimedSignals made{file, {}, {{column, "", {}}}};
  for (std::size_t k = 0; k < samples; ++k) {
    made.times_s.push_back(from_s + period_s * static_cast<double>(k));
    made.columns[0].values.push_back(value(made.times_s.back()));
  }
  return made;
}

double smooth(double time_s) {
  return std::sin(5.0 * time_s);
}
double steps(double time_s) {
  return std::floor(time_s * 10.0 + 1e-9);
}

bool is_torque(const std::string& column) {
  return column == "torque";
}

std::string refusal(const std::vector<TimedSignals>& files, JoinGrid grid) {
  try {
    joined_table(files, grid, is_torque);
  } catch (const arm::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(JoinedTable, FilesOfTheSameTimesKeepTheirNumbers) {
  const auto table = joined_table({signal("a.csv", "torque", 0.0, 0.01, 100, steps),
                                   signal("b.csv", "theta", 0.2, 0.01, 100, smooth)},
                                  JoinGrid::same, is_torque);
  ASSERT_EQ(table.columns.size(), 3U);
  ASSERT_EQ(table.columns[0].values.size(), 80U);
  EXPECT_NEAR(table.columns[0].values[0], 0.2, 1e-12);
  for (std::size_t k = 0; k < 80; ++k) {
    EXPECT_EQ(table.columns[1].values[k], steps(0.2 + 0.01 * static_cast<double>(k)));
    EXPECT_EQ(table.columns[2].values[k], smooth(0.2 + 0.01 * static_cast<double>(k)));
  }
  EXPECT_THAT(table.assumptions[0],
              AllOf(HasSubstr("over 0.2 s to 0.99 s"), HasSubstr("40 samples outside")));
}

TEST(JoinedTable, OtherTimesAreResampledOnlyIfItIsSaid) {
  const std::vector files{signal("a.csv", "theta", 0.0, 0.01, 200, smooth),
                          signal("b.csv", "torque", 0.003, 0.0025, 700, steps)};
  EXPECT_THAT(refusal(files, JoinGrid::same),
              HasSubstr("--join-grid first or --join-grid coarsest"));
  for (const auto grid : {JoinGrid::first, JoinGrid::coarsest}) {
    const auto table = joined_table(files, grid, is_torque);
    EXPECT_NEAR(table.columns[0].values[1] - table.columns[0].values[0], 0.01, 1e-12);
    EXPECT_THAT(table.assumptions.back(), HasSubstr("above 50 Hz is folded"));
    // The mean of a torque over a step within [k/10, (k + 1)/10) is its value there.
    const double time_s = table.columns[0].values[4];
    EXPECT_NEAR(table.columns[2].values[4], steps(time_s), 1e-9);
  }
}

TEST(JoinedTable, ASmoothSignalIsTakenByCubics) {
  const auto table = joined_table({signal("a.csv", "torque", 0.001, 0.004, 400, steps),
                                   signal("b.csv", "theta", 0.0, 0.01, 170, smooth)},
                                  JoinGrid::first, is_torque);
  // h^4/24 times the fourth derivative, 5^4, of the cubic through four points.
  constexpr double kCubicError = 1e-8 * 625.0;
  for (std::size_t k = 5; k + 5 < table.columns[0].values.size(); ++k) {
    EXPECT_NEAR(table.columns[2].values[k], smooth(table.columns[0].values[k]), kCubicError);
  }
}

TEST(JoinedTable, SamplesThatAreMissingAreNotMade) {
  auto angle = signal("b.csv", "theta", 0.0, 0.004, 500, smooth);
  auto torque = signal("c.csv", "torque", 0.0, 0.0025, 800, steps);
  const auto unread = [](TimedSignals& file, std::size_t first, std::size_t last) {
    std::fill(file.columns[0].values.begin() + static_cast<std::ptrdiff_t>(first),
              file.columns[0].values.begin() + static_cast<std::ptrdiff_t>(last), NAN);
  };
  unread(angle, 100, 130);
  unread(angle, 250, 251);
  unread(torque, 160, 168);
  const auto table = joined_table({signal("a.csv", "acc", 0.0, 0.01, 190, smooth), angle, torque},
                                  JoinGrid::first, is_torque);
  ASSERT_EQ(table.columns[0].values.size(), 190U);
  for (std::size_t k = 0; k < 190; ++k) {
    const double time_s = table.columns[0].values[k];
    const bool has_no_angle = (k >= 40 && k < 52) || k == 100;
    EXPECT_EQ(std::isnan(table.columns[2].values[k]), has_no_angle) << time_s;
    if (!has_no_angle) {
      EXPECT_NEAR(table.columns[2].values[k], smooth(time_s), 1e-7);
    }
    const bool has_no_torque = k == 40 || k == 41;
    EXPECT_EQ(std::isnan(table.columns[3].values[k]), has_no_torque) << time_s;
    if (!has_no_torque) {
      EXPECT_NEAR(table.columns[3].values[k], steps(time_s), 1e-6);
    }
  }
}

TEST(JoinedTable, RowsThatAreAbsentAreNotMade) {
  auto angle = signal("b.csv", "theta", 0.0, 0.004, 500, smooth);
  for (auto* values : {&angle.times_s, &angle.columns[0].values}) {
    values->erase(values->begin() + 100, values->begin() + 130);
  }
  const auto table = joined_table({signal("a.csv", "torque", 0.0, 0.01, 190, steps), angle},
                                  JoinGrid::first, is_torque);
  for (std::size_t k = 0; k < 190; ++k) {
    EXPECT_EQ(std::isnan(table.columns[2].values[k]), k >= 40 && k < 52) << k;
  }
}

TEST(JoinedTable, RowsThatOneFileLacksAreMissing) {
  const auto lacking = [](TimedSignals file, std::ptrdiff_t first, std::ptrdiff_t rows) {
    for (auto* values : {&file.times_s, &file.columns[0].values}) {
      values->erase(values->begin() + first, values->begin() + first + rows);
    }
    return file;
  };
  const auto torque = signal("a.csv", "torque", 0.0, 0.01, 100, steps);
  const auto angle = signal("b.csv", "theta", 0.0, 0.01, 100, smooth);
  const auto table =
      joined_table({lacking(torque, 20, 1), lacking(angle, 60, 9)}, JoinGrid::same, is_torque);
  ASSERT_EQ(table.columns[0].values.size(), 100U);
  for (std::size_t k = 0; k < 100; ++k) {
    EXPECT_NEAR(table.columns[0].values[k], 0.01 * static_cast<double>(k), 1e-12);
    EXPECT_EQ(std::isnan(table.columns[1].values[k]), k == 20) << k;
    EXPECT_EQ(std::isnan(table.columns[2].values[k]), k >= 60 && k < 69) << k;
    if (k < 60) {
      EXPECT_EQ(table.columns[2].values[k], angle.columns[0].values[k]);
    }
  }
  EXPECT_THAT(table.assumptions[1], HasSubstr("a.csv has no sample at 1 of 100 times"));
  EXPECT_THAT(table.assumptions[2], HasSubstr("b.csv has no sample at 9 of 100 times"));
  EXPECT_THAT(refusal({torque, signal("b.csv", "theta", 0.005, 0.01, 99, smooth)}, JoinGrid::same),
              HasSubstr("the samples lie between each other"));
  EXPECT_THAT(refusal({torque, signal("b.csv", "theta", 0.0, 0.02, 50, smooth)}, JoinGrid::same),
              HasSubstr("--join-grid"));
}

TEST(JoinedTable, ClocksWithoutCommonTimeAreRefused) {
  EXPECT_THAT(refusal({signal("a.csv", "torque", 0.0, 0.01, 100, steps),
                       signal("b.csv", "theta", 1.7e9, 0.01, 100, smooth)},
                      JoinGrid::first),
              AllOf(HasSubstr("no time in which all files have samples"),
                    HasSubstr("b.csv from 1700000000 s")));
}

TEST(JoinedTable, LittleCommonTimeIsDoubted) {
  const auto table = joined_table({signal("a.csv", "torque", 0.0, 0.01, 100, steps),
                                   signal("b.csv", "theta", 0.8, 0.01, 100, smooth)},
                                  JoinGrid::same, is_torque);
  EXPECT_THAT(table.assumptions[1], HasSubstr("are the times of one clock?"));
}

TEST(JoinedTable, ColumnsOfOneNameAndWithoutMeaningGetThatOfTheirFile) {
  std::vector files{signal("data/torque.csv", "value", 0.0, 0.01, 10, steps),
                    signal("angle.csv", "value", 0.0, 0.01, 10, smooth),
                    signal("tip.csv", "acc", 0.0, 0.01, 10, smooth)};
  name_joined_columns(files);
  EXPECT_EQ(files[0].columns[0].name, "torque.value");
  EXPECT_EQ(files[1].columns[0].name, "angle.value");
  EXPECT_EQ(files[2].columns[0].name, "acc");
}

}  // namespace
}  // namespace flexarm::measured
