// Structures, cells and texts of MATLAB files, of signals that are known.
#pragma once

#include "measured/files/column_guess.hpp"
#include "measured/files/foreign_file.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <matio.h>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace flexarm::measured {

inline constexpr std::size_t kSamples = 12;
/// Sines below 0.1 of another library, by their last digit.
inline constexpr double kOtherSine = 0x1p-56;

inline std::vector<double> times_s() {
  std::vector<double> values;
  for (std::size_t k = 0; k < kSamples; ++k) values.push_back(0.004 * static_cast<double>(k));
  return values;
}

inline std::vector<double> torques_N_m() {
  std::vector<double> values;
  for (const double time_s : times_s()) values.push_back(0.1 * std::sin(9.0 * time_s));
  return values;
}

inline std::vector<double> angles_rad() {
  std::vector<double> values;
  for (const double time_s : times_s()) values.push_back(0.05 * std::sin(8.0 * time_s));
  return values;
}

inline matvar_t* numbers(const std::vector<double>& values, std::vector<std::size_t> size) {
  std::vector<double> copy = values;
  return Mat_VarCreate(nullptr, MAT_C_DOUBLE, MAT_T_DOUBLE, static_cast<int>(size.size()),
                       size.data(), copy.data(), 0);
}

inline matvar_t* column(const std::vector<double>& values) {
  return numbers(values, {values.size(), 1});
}

inline matvar_t* text(std::string letters) {
  std::array<std::size_t, 2> size{letters.empty() ? 0U : 1U, letters.size()};
  return Mat_VarCreate(nullptr, MAT_C_CHAR, MAT_T_UINT8, 2, size.data(), letters.data(), 0);
}

using Field = std::pair<const char*, matvar_t*>;

/// Structures, each with the same fields.
inline matvar_t* structures(const std::vector<std::vector<Field>>& elements) {
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

inline matvar_t* cells(std::size_t rows, std::size_t columns,
                       const std::vector<matvar_t*>& values) {
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
inline std::filesystem::path file_of_level73(const char* name) {
  return std::filesystem::path(FLEXARM_SOURCE_DIR "/tests/fuzz/seeds/matlab_73_file") / name;
}

/// The values of the columns that are taken for time, torque and hub angle.
inline void expect_told(const ForeignFile& file, double tolerance = 0.0) {
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

inline std::vector<std::string> names_in(const ForeignFile& file) {
  std::vector<std::string> names;
  for (const auto& column : file.table.columns) names.push_back(column.name);
  return names;
}

}  // namespace flexarm::measured
