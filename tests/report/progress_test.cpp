#include "report/progress.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <fcntl.h>
#include <string>
#include <thread>
#include <unistd.h>
#include <vector>

namespace flexarm::report {
namespace {

using namespace std::chrono_literals;

/// What `write` sends into the far end of `read_from`, which must not block.
std::string read_all(int read_from) {
  fcntl(read_from, F_SETFL, O_NONBLOCK);
  std::string text;
  std::array<char, 4096> buffer{};
  for (ssize_t n = 0; (n = ::read(read_from, buffer.data(), buffer.size())) > 0;) {
    text.append(buffer.data(), static_cast<std::size_t>(n));
  }
  return text;
}

/// A terminal of the test's own.
class PseudoTerminal {
 public:
  PseudoTerminal() : master_(posix_openpt(O_RDWR | O_NOCTTY)) {
    if (master_ < 0 || grantpt(master_) != 0 || unlockpt(master_) != 0) return;
    slave_ = open(ptsname(master_), O_RDWR | O_NOCTTY);
  }
  ~PseudoTerminal() {
    close(slave_);
    close(master_);
  }
  PseudoTerminal(const PseudoTerminal&) = delete;
  PseudoTerminal& operator=(const PseudoTerminal&) = delete;

  int descriptor() const { return slave_; }
  std::string output() const { return read_all(master_); }

 private:
  int master_;
  int slave_ = -1;
};

TEST(Progress, WritesNothingWhereThereIsNoTerminal) {
  std::array<int, 2> ends{};
  ASSERT_EQ(pipe(ends.data()), 0);
  {
    Progress progress("grid", 3, {.descriptor = ends[1], .quiet_for = 0s, .interval = 0s});
    progress.advance(3);
  }
  EXPECT_EQ(read_all(ends[0]), "");
  close(ends[0]);
  close(ends[1]);
}

TEST(Progress, WritesNothingForShortWork) {
  const PseudoTerminal terminal;
  ASSERT_GE(terminal.descriptor(), 0);
  {
    Progress progress("grid", 3, {.descriptor = terminal.descriptor(), .quiet_for = 1h});
    progress.advance(3);
  }
  EXPECT_EQ(terminal.output(), "");
}

TEST(Progress, CountsOnATerminalAndWipesItsLineAtTheEnd) {
  const PseudoTerminal terminal;
  ASSERT_GE(terminal.descriptor(), 0);
  {
    Progress progress("grid", 40,
                      {.descriptor = terminal.descriptor(), .quiet_for = 0s, .interval = 0s});
    progress.advance();
    progress.advance(11);
  }
  EXPECT_EQ(terminal.output(), "\r\x1b[Kgrid  1 of 40\r\x1b[Kgrid  12 of 40\r\x1b[K");
}

TEST(Progress, ThreadsMayAdvanceTogether) {
  constexpr int kThreads = 4;
  constexpr int kSteps = 1000;
  const PseudoTerminal terminal;
  ASSERT_GE(terminal.descriptor(), 0);
  {
    Progress progress("grid", kThreads * kSteps + 1,
                      {.descriptor = terminal.descriptor(), .quiet_for = 0s, .interval = 1ms});
    std::vector<std::thread> threads;
    for (int t = 0; t < kThreads; ++t) {
      threads.emplace_back([&] {
        for (int i = 0; i < kSteps; ++i) progress.advance();
      });
    }
    for (std::thread& thread : threads) thread.join();
    std::this_thread::sleep_for(2ms);
    progress.advance();
  }
  EXPECT_THAT(terminal.output(), testing::EndsWith("grid  4001 of 4001\r\x1b[K"));
}

}  // namespace
}  // namespace flexarm::report
