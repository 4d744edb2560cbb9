#include "measured/mat_file.hpp"

#include "arm/input_error.hpp"
#include "arm/text_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>

namespace flexarm::measured {
namespace {

using testing::HasSubstr;

/// A folder of its own, removed afterwards.
class MatFile : public testing::Test {
 protected:
  MatFile() {
    std::string name = (std::filesystem::temp_directory_path() / "flexarm-test-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
  }
  ~MatFile() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path path(const char* name = "a.mat") const { return folder_ / name; }

  std::string refusal() const {
    try {
      read_mat_file(path());
    } catch (const arm::InputError& error) {
      return error.what();
    }
    return "";
  }

  std::filesystem::path folder_;
};

std::vector<MatVariable> every_kind() {
  std::mt19937_64 random(20240611);
  std::uniform_real_distribution<double> uniform(-1e6, 1e6);
  MatMatrix real{3, 4, {}};
  MatComplexMatrix complex{2, 3, {}};
  for (int i = 0; i < 12; ++i) real.values.push_back(uniform(random));
  for (int i = 0; i < 6; ++i) complex.values.emplace_back(uniform(random), uniform(random));
  return {{"A", real},
          {"G", complex},
          {"delay_s", MatMatrix{1, 1, {std::numeric_limits<double>::denorm_min()}}},
          {"no_rows", MatMatrix{0, 3, {}}},
          {"schema", std::string("flexarm.state_space/1")},
          {"sensors", MatStrings{"hub_angle", "strain@0.05", ""}}};
}

TEST_F(MatFile, WhatIsWrittenIsReadBackBitForBit) {
  write_mat_file(every_kind(), path());
  EXPECT_EQ(read_mat_file(path()), every_kind());
}

TEST_F(MatFile, ColumnsComeOneAfterTheOther) {
  const MatMatrix matrix{2, 2, {1.0, 2.0, 3.0, 4.0}};
  EXPECT_EQ(matrix(1, 0), 2.0);
  EXPECT_EQ(matrix(0, 1), 3.0);
}

TEST_F(MatFile, TheSameVariablesGiveTheSameBytes) {
  write_mat_file(every_kind(), path("a.mat"));
  write_mat_file(every_kind(), path("b.mat"));
  constexpr std::size_t kMost = 1 << 20;
  EXPECT_EQ(arm::read_text_file(path("a.mat"), kMost), arm::read_text_file(path("b.mat"), kMost));
}

TEST_F(MatFile, WhatMatlabCouldNotHoldIsRefused) {
  const auto write = [&](MatVariable variable) { write_mat_file({std::move(variable)}, path()); };
  EXPECT_THROW(write({"2a", std::string("x")}), std::invalid_argument);
  EXPECT_THROW(write({"", std::string("x")}), std::invalid_argument);
  EXPECT_THROW(write({"a b", std::string("x")}), std::invalid_argument);
  EXPECT_THROW(write({std::string(64, 'a'), std::string("x")}), std::invalid_argument);
  EXPECT_THROW(write({"a", std::string("\xce\xbb")}), std::invalid_argument);
  EXPECT_THROW(write({"a", MatStrings{"line\nend"}}), std::invalid_argument);
  EXPECT_THROW(write({"a", MatMatrix{2, 2, {1.0}}}), std::invalid_argument);
  EXPECT_THROW(write_mat_file({{"a", std::string()}, {"a", std::string()}}, path()),
               std::invalid_argument);
  EXPECT_FALSE(std::filesystem::exists(path()));
}

TEST_F(MatFile, AFileThatIsNoneIsRefused) {
  EXPECT_THAT(refusal(), HasSubstr("a.mat: no such file"));
  std::ofstream(path()) << "time [s],torque [N m]\n0,1\n";
  EXPECT_THAT(refusal(), HasSubstr("a.mat: is no MATLAB 5 file; save with -v6 or -v7"));
}

TEST_F(MatFile, AFolderThatIsNotThereIsRefused) {
  EXPECT_THROW(write_mat_file(every_kind(), path("none/a.mat")), arm::InputError);
}

TEST_F(MatFile, AFileCutOffAnywhereIsRefusedOrHoldsWholeVariables) {
  write_mat_file(every_kind(), path());
  const std::string bytes = arm::read_text_file(path(), 1 << 20);
  const auto whole = every_kind();
  for (std::size_t size = 0; size < bytes.size(); size += 7) {
    std::ofstream(path(), std::ios::binary) << bytes.substr(0, size);
    try {
      const auto read = read_mat_file(path());
      ASSERT_LE(read.size(), whole.size());
      for (std::size_t i = 0; i < read.size(); ++i) EXPECT_EQ(read[i], whole[i]) << size;
    } catch (const arm::InputError&) {
    }
  }
}

}  // namespace
}  // namespace flexarm::measured
