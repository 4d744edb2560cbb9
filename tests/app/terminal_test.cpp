#include "report/utf8_text.hpp"
#include "tests/app/flexarm_fixture.hpp"
#include "tests/app/terminal_session.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace flexarm::testing_app {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

using Terminal = Flexarm;

constexpr const char* kGreenAgree = "\x1b[1;32magree\x1b[0m";

const std::vector<std::string> kQuick = {"compare", "--quick", "--poles", "3"};

/// What stays on the terminal: without the lines of progress that wipe each other where the work
/// takes over a second, as under the sanitizers.
std::string lasting(const std::string& output) {
  return std::regex_replace(output, std::regex("[^\n]*\r\x1b\\[K"), "");
}

/// Widths of the lines of an output, without its colours. A command to type next is not broken.
std::size_t widest_line(const std::string& output) {
  std::size_t widest = 0;
  std::istringstream lines(std::regex_replace(output, std::regex("\x1b\\[[0-9;]*m|\r"), ""));
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("next: ")) widest = std::max(widest, report::display_width(line));
  }
  return widest;
}

TEST_F(Terminal, TablesAndTextFitItsWidth) {
  for (const unsigned short columns : std::array<unsigned short, 4>{40, 60, 80, 132}) {
    const Ended ended = run_on_terminal(kQuick, columns);
    EXPECT_EQ(ended.status, 0) << ended.output;
    EXPECT_LE(widest_line(lasting(ended.output)), columns) << ended.output;
  }
}

TEST_F(Terminal, APipeHas100Columns) {
  const std::size_t widest = widest_line(run(kQuick).output);
  EXPECT_LE(widest, 100U);
  EXPECT_GT(widest, 80U);
}

TEST_F(Terminal, TheVerdictIsColouredUnlessTheUserSaysNo) {
  EXPECT_THAT(run_on_terminal(kQuick, 100).output, HasSubstr(kGreenAgree));
  for (const auto& [name, value] :
       std::map<std::string, std::string>{{"NO_COLOR", "1"}, {"TERM", "dumb"}}) {
    EXPECT_THAT(lasting(run_on_terminal(kQuick, 100, {{name, value}}).output),
                AllOf(HasSubstr("agree"), Not(HasSubstr("\x1b["))))
        << name;
  }
  EXPECT_THAT(run(kQuick).output, AllOf(HasSubstr("agree"), Not(HasSubstr("\x1b"))));
}

TEST_F(Terminal, CtrlCLeavesOneLineAndNoFile) {
  const std::string out = (folder_ / "out").string();
  for (const auto& [call, progress] :
       {std::pair{std::vector<std::string>{"simulate", "--duration", "5000", "--out", out},
                  "bang-bang, samples  "},
        // Its steps are long: the time shows that they go on.
        std::pair{std::vector<std::string>{"modes", "--modes", "500000", "--out", out},
                  "computing modes  1 s"}}) {
    const Ended ended = interrupt_on_terminal(call, 80);
    EXPECT_EQ(ended.status, 128 + SIGINT);
    EXPECT_THAT(ended.output,
                AllOf(HasSubstr(progress), EndsWith("\r\x1b[Kflexarm: interrupted\r\n")));
    EXPECT_TRUE(names_in().empty());
  }
}

}  // namespace
}  // namespace flexarm::testing_app
