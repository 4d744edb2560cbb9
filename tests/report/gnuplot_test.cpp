#include "report/figures/gnuplot.hpp"

#include "tests/environment_variable.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <stdexcept>
#include <string>

namespace flexarm::report {
namespace {

using testing::HasSubstr;

std::string failure(const std::string& script) {
  try {
    run_gnuplot(script);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(Gnuplot, ReturnsWhatTheScriptPrints) {
  EXPECT_EQ(run_gnuplot("set print '-'\nprint 6*7\n"), "42\n");
}

TEST(Gnuplot, LongOutputDoesNotBlock) {
  // Ten times what a pipe holds.
  const std::string printed =
      run_gnuplot("set print '-'\ndo for [i=1:65536] { print '123456789' }\n");
  EXPECT_EQ(printed.size(), 655360U);
}

TEST(Gnuplot, AnErrorInTheScriptCarriesGnuplotsMessage) {
  EXPECT_THAT(failure("plot no_such_variable\n"), HasSubstr("undefined variable"));
}

TEST(Gnuplot, OneThatHangsIsEnded) {
  constexpr std::chrono::milliseconds kShort(200);
  try {
    run_gnuplot("pause 30\n", kShort);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "gnuplot did not end within 0.2 s");
  }
}

TEST(Gnuplot, NamesThePackageWhenItIsNotInstalled) {
  const testing_environment::EnvironmentVariable path("PATH", FLEXARM_SOURCE_DIR);
  EXPECT_THAT(failure("print 1\n"), HasSubstr("gnuplot-nox"));
}

}  // namespace
}  // namespace flexarm::report
