#include "report/progress.hpp"

#include "tests/environment_variable.hpp"
#include "tests/report/pseudo_terminal.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <string>
#include <thread>
#include <unistd.h>
#include <vector>

namespace flexarm::report {
namespace {

using namespace std::chrono_literals;
using testing_environment::EnvironmentVariable;

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

TEST(Progress, WritesNothingToATerminalThatCannotWipeALine) {
  const PseudoTerminal terminal;
  ASSERT_GE(terminal.descriptor(), 0);
  const EnvironmentVariable kind("TERM", "dumb");
  {
    Progress progress("grid", 3,
                      {.descriptor = terminal.descriptor(), .quiet_for = 0s, .interval = 0s});
    progress.advance(3);
  }
  EXPECT_EQ(terminal.output(), "");
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

constexpr TimeLeftOptions kAtOnce{.quiet_for_s = 0.0, .least_fraction = 0.0};

TEST(Progress, SaysHowMuchTimeIsLeft) {
  const PseudoTerminal terminal;
  ASSERT_GE(terminal.descriptor(), 0);
  {
    Progress progress("fitting", {.descriptor = terminal.descriptor(),
                                  .quiet_for = 0s,
                                  .interval = 0s,
                                  .time_left = kAtOnce});
    std::this_thread::sleep_for(2ms);
    progress.reach(0.505);
    progress.reach(0.3);  // less than is known
  }
  EXPECT_EQ(terminal.output(),
            "\r\x1b[Kfitting  50 %, 1 s left\r\x1b[Kfitting  50 %, 1 s left\r\x1b[K");
}

TEST(Progress, ShowsThatALongStepGoesOn) {
  const PseudoTerminal terminal;
  ASSERT_GE(terminal.descriptor(), 0);
  {
    const Progress progress(
        "writing files",
        {.descriptor = terminal.descriptor(), .quiet_for = 0s, .interval = 0s, .tick = 5ms});
    std::this_thread::sleep_for(100ms);
  }
  const std::string output = terminal.output();
  EXPECT_THAT(output, testing::StartsWith("\r\x1b[Kwriting files  0 s\r\x1b[Kwriting files  0 s"));
  EXPECT_THAT(output, testing::EndsWith("s\r\x1b[K"));
}

TEST(Progress, FitsInANarrowTerminal) {
  const PseudoTerminal terminal(30);
  ASSERT_GE(terminal.descriptor(), 0);
  {
    Progress progress("a label that is quite long", 1000,
                      {.descriptor = terminal.descriptor(), .quiet_for = 0s, .interval = 0s});
    progress.advance();
  }
  EXPECT_EQ(terminal.output(), "\r\x1b[Ka label that is quite long  1\r\x1b[K");
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

TEST(TimeLeft, IsUnknownAtFirst) {
  TimeLeft left;
  EXPECT_FALSE(left.seconds());
  left.update(1.9, 0.5);
  EXPECT_FALSE(left.seconds());
  left.update(2.5, 0.009);
  EXPECT_FALSE(left.seconds());
}

TEST(TimeLeft, IsExactForAnEvenRate) {
  TimeLeft left;
  for (double elapsed_s = 0.0; elapsed_s < 40.0; elapsed_s += 0.1) {
    left.update(elapsed_s, elapsed_s / 40.0);
    if (left.seconds()) {
      EXPECT_NEAR(*left.seconds(), 40.0 - elapsed_s, 1e-9);
    }
  }
  ASSERT_TRUE(left.seconds());
}

TEST(TimeLeft, FollowsAChangeOfRateWithoutAJump) {
  // 30 s of work that goes ten times slower from 10 s on.
  TimeLeft left;
  double before_s = 0.0;
  for (double elapsed_s = 0.1; elapsed_s < 200.0; elapsed_s += 0.1) {
    left.update(elapsed_s,
                std::min(elapsed_s, 10.0) / 30.0 + std::max(elapsed_s - 10.0, 0.0) / 300.0);
    if (!left.seconds()) continue;
    if (before_s > 0.0) {
      EXPECT_LT(std::abs(*left.seconds() - before_s), 1.5) << elapsed_s;
    }
    before_s = *left.seconds();
  }
  // 10 s are left. The mean rate is above that of the end: 6.9 s, and the estimate lags by 2 s.
  EXPECT_NEAR(before_s, 5.0, 0.5);
}

TEST(TimeLeft, IsRoundedToWhatAReaderCanFollow) {
  EXPECT_EQ(time_left_text(0.0), "1 s left");
  EXPECT_EQ(time_left_text(8.2), "9 s left");
  EXPECT_EQ(time_left_text(42.0), "45 s left");
  EXPECT_EQ(time_left_text(89.0), "90 s left");
  EXPECT_EQ(time_left_text(170.0), "3 min left");
  EXPECT_EQ(time_left_text(7300.0), "2 h 10 min left");
  EXPECT_EQ(time_left_text(1e12), "over 999 h left");
}

}  // namespace
}  // namespace flexarm::report
