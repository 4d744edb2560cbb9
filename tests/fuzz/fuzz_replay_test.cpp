// The targets of scripts/fuzz without libFuzzer: every seed, every finding of the past, and many
// inputs made of the seeds.
#include "arm/input_error.hpp"
#include "tests/fuzz/contract.hpp"
#include "tests/fuzz/mutation.hpp"
#include "tests/fuzz/reader.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace flexarm::fuzz {

void PrintTo(const Reader& reader, std::ostream* out) {
  *out << reader.name;
}

namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kRandomSeed = 20261127;

std::vector<fs::path> files_in(const char* folder, const std::string& reader) {
  std::vector<fs::path> files;
  const fs::path path = fs::path(FLEXARM_SOURCE_DIR) / "tests/fuzz" / folder / reader;
  if (!fs::exists(path)) return files;
  for (const auto& entry : fs::directory_iterator(path)) files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

std::string bytes_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw std::runtime_error("cannot read " + file.string());
  return {std::istreambuf_iterator<char>(stream), {}};
}

class FuzzReplay : public testing::TestWithParam<Reader> {};

TEST_P(FuzzReplay, SeedsAndFindingsOfThePast) {
  const Reader reader = GetParam();
  const auto seeds = files_in("seeds", reader.name);
  ASSERT_FALSE(seeds.empty()) << "no seeds in tests/fuzz/seeds/" << reader.name;
  for (const auto* folder : {"seeds", "findings"}) {
    for (const auto& file : files_in(folder, reader.name)) {
      EXPECT_NO_THROW(reader.read(bytes_of(file))) << file;
    }
  }
}

TEST_P(FuzzReplay, MutatedSeeds) {
  const Reader reader = GetParam();
  std::vector<std::string> seeds;
  for (const auto& file : files_in("seeds", reader.name)) seeds.push_back(bytes_of(file));
  Mutator mutator(std::move(seeds), kRandomSeed);
  for (int k = 0; k < reader.mutated_inputs; ++k) {
    const std::string input = mutator.next();
    try {
      reader.read(input);
    } catch (const Finding& finding) {
      const fs::path kept = fs::temp_directory_path() / ("flexarm-finding-" + reader.name);
      std::ofstream(kept, std::ios::binary) << input;
      FAIL() << finding.what() << "\ninput " << k << ", kept in " << kept;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(EveryReader, FuzzReplay, testing::ValuesIn(every_reader()),
                         [](const auto& reader) { return reader.param.name; });

/// A reader of this test that breaks its contract in a way of its own.
std::string finding_of(void (*read)()) {
  try {
    returns_or_refuses(read);
  } catch (const Finding& finding) {
    return finding.what();
  }
  return "";
}

TEST(FuzzContract, OtherExceptionsAreFindings) {
  EXPECT_EQ(finding_of([] { throw std::out_of_range("at"); }), "no InputError: at");
}

TEST(FuzzContract, ControlCharactersAndWhatIsNoUtf8AreFindings) {
  EXPECT_EQ(finding_of([] { throw arm::InputError("a line: \xce\xb8 = 1"); }), "");
  EXPECT_NE(finding_of([] { throw arm::InputError("two\nlines"); }), "");
  EXPECT_NE(finding_of([] { throw arm::InputError("\xff"); }), "");
  EXPECT_NE(finding_of([] { throw arm::InputError("\xc2\x9b"); }), "");
  EXPECT_NE(finding_of([] { throw arm::InputError(""); }), "");
}

}  // namespace
}  // namespace flexarm::fuzz
