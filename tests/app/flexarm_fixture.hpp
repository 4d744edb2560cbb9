#pragma once

#include "measured/files/text_file.hpp"
#include "tests/app/process.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::testing_app {

/// The command line under "Example:" in a command's help, without the program's name.
inline std::vector<std::string> example_in(const std::string& help) {
  constexpr std::string_view kHeading = "Example:\n  flexarm ";
  const auto begin = help.find(kHeading) + kHeading.size();
  std::string line;
  std::istringstream lines(help.substr(begin));
  // A line that ends in a backslash is continued on the next.
  std::string whole;
  while (std::getline(lines, line)) {
    const bool is_continued = line.ends_with('\\');
    whole += line.substr(0, line.size() - (is_continued ? 1 : 0));
    if (!is_continued) break;
  }
  std::istringstream words(whole);
  return {std::istream_iterator<std::string>(words), {}};
}

/// The program, run in a folder of its own that is removed afterwards.
class Flexarm : public testing::Test {
 protected:
  Flexarm() {
    std::string name = (std::filesystem::temp_directory_path() / "flexarm-test-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
  }
  ~Flexarm() override { std::filesystem::remove_all(folder_); }

  Ended run(const std::vector<std::string>& arguments) const {
    return run_flexarm(arguments, folder_.string());
  }
  /// What the example in a command's help prints, beside a new rig.toml.
  std::string output_of_example(const std::string& command) const {
    const Ended help = run({command, "--help"});
    EXPECT_EQ(help.status, 0);
    run({"new", "rig.toml"});
    const Ended ended = run(example_in(help.output));
    EXPECT_EQ(ended.status, 0) << ended.errors;
    return ended.output;
  }
  std::string text_of(const std::string& name) const {
    return measured::read_text_file(folder_ / name, 1 << 26);
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  /// Names of the files and folders in `folder`, sorted.
  std::vector<std::string> names_in(const std::string& folder = ".") const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / folder)) {
      names.push_back(entry.path().filename());
    }
    std::ranges::sort(names);
    return names;
  }

  std::filesystem::path folder_;
};

/// One line on standard error, nothing on standard output, status 2.
inline void expect_refused(const Ended& ended, const std::string& line) {
  EXPECT_EQ(ended.status, 2);
  EXPECT_EQ(ended.errors, line + "\n");
  EXPECT_EQ(ended.output, "");
}

}  // namespace flexarm::testing_app
