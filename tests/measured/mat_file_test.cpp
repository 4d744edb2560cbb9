#include "measured/files/mat_file.hpp"

#include "arm/input_error.hpp"
#include "measured/files/text_file.hpp"
#include "tests/environment_variable.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <matio.h>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <sys/resource.h>
#include <vector>
#include <zlib.h>

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

TEST_F(MatFile, PagesAreReadAsVectors) {
  write_mat_file({{"P", MatPages{1, 2, 2, {1.0, 2.0, 3.0, 4.0}}}, {"x", MatMatrix{1, 1, {5.0}}}},
                 path());
  const MatContents contents = read_mat_contents(path());
  EXPECT_TRUE(contents.left_out.empty());
  EXPECT_EQ(contents.variables, (std::vector<MatVariable>{{"P(1,1,:)", MatMatrix{2, 1, {1.0, 3.0}}},
                                                          {"P(1,2,:)", MatMatrix{2, 1, {2.0, 4.0}}},
                                                          {"x", MatMatrix{1, 1, {5.0}}}}));
}

TEST_F(MatFile, AFileOfMoreThanIsAllowedIsNotWritten) {
  constexpr std::size_t kMost = 100;
  EXPECT_THROW(write_mat_file({{"x", MatMatrix{1, 1, {5.0}}}}, path(), kMost), arm::InputError);
  EXPECT_FALSE(std::filesystem::exists(path()));
}

TEST_F(MatFile, TheSameVariablesGiveTheSameBytes) {
  write_mat_file(every_kind(), path("a.mat"));
  write_mat_file(every_kind(), path("b.mat"));
  constexpr std::size_t kMost = 1 << 20;
  EXPECT_EQ(measured::read_text_file(path("a.mat"), kMost),
            measured::read_text_file(path("b.mat"), kMost));
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
  EXPECT_THROW(write({"a", MatPages{1, 2, 2, {1.0, 2.0}}}), std::invalid_argument);
  EXPECT_THROW(write_mat_file({{"a", std::string()}, {"a", std::string()}}, path()),
               std::invalid_argument);
  EXPECT_FALSE(std::filesystem::exists(path()));
}

TEST_F(MatFile, AFileThatIsNoneIsRefused) {
  EXPECT_THAT(refusal(), HasSubstr("a.mat: no such file"));
  std::ofstream(path()) << "time [s],torque [N m]\n0,1\n";
  EXPECT_THAT(refusal(), HasSubstr("a.mat: not a MATLAB file"));
}

TEST_F(MatFile, AFolderThatIsNotThereIsRefused) {
  EXPECT_THROW(write_mat_file(every_kind(), path("none/a.mat")), arm::InputError);
}

/// A structure of a single, an integer and a nested structure, and a sparse matrix that is none of
/// ours, as another program writes them.
void write_foreign(const std::filesystem::path& path, matio_compression compression) {
  const std::unique_ptr<mat_t, int (*)(mat_t*)> file(
      Mat_CreateVer(path.c_str(), nullptr, MAT_FT_MAT5), Mat_Close);
  std::array<std::size_t, 2> size{3, 1};
  std::array<float, 3> single{0.5F, -1.25F, 3.0F};
  std::array<std::int16_t, 3> whole{-7, 0, 32767};
  std::array<std::size_t, 2> one{1, 1};
  std::array<const char*, 1> inner_names{"k"};
  matvar_t* inner = Mat_VarCreateStruct(nullptr, 2, one.data(), inner_names.data(), 1);
  Mat_VarSetStructFieldByName(
      inner, "k", 0,
      Mat_VarCreate(nullptr, MAT_C_INT16, MAT_T_INT16, 2, size.data(), whole.data(), 0));
  std::array<const char*, 2> names{"y", "n"};
  matvar_t* outer = Mat_VarCreateStruct("s", 2, one.data(), names.data(), 2);
  Mat_VarSetStructFieldByName(
      outer, "y", 0,
      Mat_VarCreate(nullptr, MAT_C_SINGLE, MAT_T_SINGLE, 2, size.data(), single.data(), 0));
  Mat_VarSetStructFieldByName(outer, "n", 0, inner);
  Mat_VarWrite(file.get(), outer, compression);
  Mat_VarFree(outer);  // and its fields
  std::array<double, 1> value{2.0};
  std::array<mat_uint32_t, 1> row{0};
  std::array<mat_uint32_t, 2> column{0, 1};
  mat_sparse_t sparse{1, row.data(), 1, column.data(), 2, 1, value.data()};
  matvar_t* matrix =
      Mat_VarCreate("K", MAT_C_SPARSE, MAT_T_DOUBLE, 2, one.data(), &sparse, MAT_F_DONT_COPY_DATA);
  Mat_VarWrite(file.get(), matrix, MAT_COMPRESSION_NONE);
  Mat_VarFree(matrix);
}

TEST_F(MatFile, StructuresAndOtherClassesOfNumbersAreReadCompressedOrNot) {
  for (const auto compression : {MAT_COMPRESSION_NONE, MAT_COMPRESSION_ZLIB}) {
    write_foreign(path(), compression);
    const MatContents contents = read_mat_contents(path());
    EXPECT_EQ(contents.variables,
              (std::vector<MatVariable>{{"s.y", MatMatrix{3, 1, {0.5, -1.25, 3.0}}},
                                        {"s.n.k", MatMatrix{3, 1, {-7.0, 0.0, 32767.0}}}}));
    EXPECT_THAT(contents.left_out, testing::ElementsAre("K: a sparse matrix"));
    EXPECT_THAT(refusal(), HasSubstr("variable K: a sparse matrix"));
  }
}

TEST_F(MatFile, MutatedFilesGiveVariablesOrOneLine) {
  std::mt19937_64 random(20261127);
  write_foreign(path("a.mat"), MAT_COMPRESSION_NONE);
  write_foreign(path("b.mat"), MAT_COMPRESSION_ZLIB);
  write_mat_file(every_kind(), path("c.mat"));
  Mat_LogInitFunc("test", [](int, char*) {});  // the library's own words on broken files
  constexpr int kFiles = 2000;
  for (const char* name : {"a.mat", "b.mat", "c.mat"}) {
    const std::string good = measured::read_text_file(path(name), 1 << 20);
    for (int i = 0; i < kFiles; ++i) {
      std::string bytes = good;
      if (i % 2 == 0) {
        bytes.resize(random() % good.size());
      } else {
        for (auto changes = 1 + random() % 4; changes > 0; --changes) {
          bytes[128 + random() % (bytes.size() - 128)] = static_cast<char>(random() % 256);
        }
      }
      // A file that is written over waits for the disk.
      std::filesystem::remove(path("m.mat"));
      std::ofstream(path("m.mat"), std::ios::binary) << bytes;
      try {
        read_mat_contents(path("m.mat"));
      } catch (const arm::InputError& error) {
        EXPECT_EQ(std::string(error.what()).find_first_of("\r\n"), std::string::npos);
      }
    }
  }
}

TEST_F(MatFile, AFileCutOffAnywhereIsRefusedOrHoldsWholeVariables) {
  write_mat_file(every_kind(), path());
  const std::string bytes = measured::read_text_file(path(), 1 << 20);
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

TEST_F(MatFile, NeedsNoTemporaryFolder) {
  const std::string none = path("none");
  const testing_environment::EnvironmentVariable folder("TMPDIR", none.c_str());
  write_mat_file(every_kind(), path());
  EXPECT_EQ(read_mat_file(path()), every_kind());
}

/// The library does not say that a write of its own has failed.
TEST_F(MatFile, WithoutRoomNothingIsWritten) {
  rlimit before = {};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto previous = std::signal(SIGXFSZ, SIG_IGN);
  const MatVariable numbers{"numbers", MatMatrix{1000, 1, std::vector<double>(1000, 1.0)}};
  // Within the header, within the numbers, and between two variables.
  for (const rlim_t limit : {100U, 4000U, 8192U}) {
    const rlimit small = {limit, before.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    std::string error;
    try {
      write_mat_file({numbers, {"more", MatMatrix{1, 1, {2.0}}}}, path());
    } catch (const arm::InputError& refused) {
      error = refused.what();
    }
    ::setrlimit(RLIMIT_FSIZE, &before);
    EXPECT_THAT(error, HasSubstr(path().string() + ": cannot be written")) << limit;
    EXPECT_FALSE(std::filesystem::exists(path()));
  }
  std::signal(SIGXFSZ, previous);
}

std::string compressed(const std::string& bytes) {
  std::string out(compressBound(bytes.size()), '\0');
  uLongf size = out.size();
  compress(reinterpret_cast<Bytef*>(out.data()), &size,
           reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
  out.resize(size);
  return out;
}

/// Four bytes, little endian.
std::string word(std::size_t value) {
  std::string out;
  for (unsigned shift = 0; shift < 32; shift += 8)
    out += static_cast<char>((value >> shift) & 0xffU);
  return out;
}

/// A file of one compressed row of `numbers` zeros of 8 bits; `stated` bytes are stated in all.
std::string zeros_file(std::size_t numbers, std::size_t stated) {
  constexpr std::size_t kHeads = 48;  // tags, flags, size and name in front of the numbers
  std::string matrix = word(14) + word(stated) + word(6) + word(8) + word(8) + word(0);
  matrix +=
      word(5) + word(8) + word(1) + word(numbers) + word(0x00010001) + "a" + std::string(3, '\0');
  matrix += word(1) + word(numbers);
  EXPECT_EQ(matrix.size(), kHeads + 8);
  const std::string data = compressed(matrix + std::string(numbers, '\0'));
  std::string head = "MATLAB 5.0 MAT-file";
  head.resize(124, ' ');
  return head + std::string("\x00\x01IM", 4) + word(15) + word(data.size()) + data;
}

TEST_F(MatFile, ASmallFileThatExpandsToAHugeOneIsRefusedFromItsFirstBytes) {
  constexpr std::size_t kNumbers = 1 << 20;
  constexpr std::size_t kStated = std::size_t{1} << 31U;
  std::ofstream(path(), std::ios::binary) << zeros_file(kNumbers, kStated);
  EXPECT_THAT(refusal(), HasSubstr("expands to 2147483656 bytes or more where 268435456 may be"));
}

TEST_F(MatFile, SeveralVariablesShareTheRoom) {
  // Each is below the bound.
  constexpr std::size_t kNumbers = std::size_t{7} << 20U;
  const std::string one = zeros_file(kNumbers, kNumbers + 48);
  std::string all = one;
  for (int i = 0; i < 5; ++i) all += one.substr(128);
  std::ofstream(path(), std::ios::binary) << all;
  EXPECT_THAT(refusal(), HasSubstr("holds more than 33554432 numbers"));
}

TEST_F(MatFile, ManyEmptyCellsAreRefused) {
  constexpr std::size_t kCells = 300000;
  std::string cell = word(6) + word(8) + word(1) + word(0);
  cell +=
      word(5) + word(8) + word(1) + word(kCells) + word(0x00010001) + "c" + std::string(3, '\0');
  for (std::size_t i = 0; i < kCells; ++i) cell += word(14) + word(0);
  std::string head = "MATLAB 5.0 MAT-file";
  head.resize(124, ' ');
  std::ofstream(path(), std::ios::binary)
      << head << std::string("\x00\x01IM", 4) << word(14) << word(cell.size()) << cell;
  EXPECT_THAT(refusal(), HasSubstr("holds more than 262144 arrays, cells and fields"));
}

}  // namespace
}  // namespace flexarm::measured
