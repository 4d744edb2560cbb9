#include "compare/finding.hpp"

#include "tests/compare/models.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace flexarm::compare {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

TEST(Judge, AgreesWhenEveryDistanceIsWithinItsTolerance) {
  const std::vector<Finding> findings = {{"a", "x", "y", 1e-12, 1e-9}, {"b", "x", "y", 1e-7, 1e-7}};
  const auto verdict = judge(findings);
  EXPECT_TRUE(verdict.agree) << "a distance equal to the tolerance agrees";
  EXPECT_EQ(verdict.worst.quantity, "b");
}

TEST(Judge, TheWorstIsMeasuredByItsOwnTolerance) {
  const std::vector<Finding> findings = {{"large", "x", "y", 1e-3, 1.0},
                                         {"small", "x", "y", 2e-9, 1e-9}};
  const auto verdict = judge(findings);
  EXPECT_FALSE(verdict.agree);
  EXPECT_EQ(verdict.worst.quantity, "small");
}

TEST(Judge, AMissingValueIsWorseThanAnyDistance) {
  const std::vector<Finding> before = {{"huge", "x", "y", 1e200, 1e-9},
                                       {"missing", "x", "y", kNaN, 1e-9}};
  const std::vector<Finding> after = {before[1], before[0]};
  for (const auto& findings : {before, after}) {
    const auto verdict = judge(findings);
    EXPECT_FALSE(verdict.agree);
    EXPECT_EQ(verdict.worst.quantity, "missing");
  }
}

TEST(Judge, AnInfiniteDistanceDisagrees) {
  const std::vector<Finding> findings = {{"a", "x", "y", kInfinite, 1e-9}};
  EXPECT_FALSE(judge(findings).agree);
}

TEST(Judge, OfEqualsTheFirstIsNamed) {
  const std::vector<Finding> findings = {{"first", "x", "y", 0.0, 1e-9},
                                         {"second", "x", "y", 0.0, 1e-9}};
  const auto verdict = judge(findings);
  EXPECT_TRUE(verdict.agree);
  EXPECT_EQ(verdict.worst.quantity, "first");
}

/// What `alone` is of three models whose pairs are so far apart in a zero.
std::string alone_of(double x_y, double x_z, double y_z) {
  return judge(std::vector<Finding>{{"zero 4", "x", "y", x_y, 1e-9},
                                    {"zero 4", "x", "z", x_z, 1e-9},
                                    {"zero 4", "y", "z", y_z, 1e-9}})
      .alone;
}

TEST(Judge, NamesTheOneThatDiffersFromTwoThatAgree) {
  EXPECT_EQ(alone_of(1e-13, kNaN, kNaN), "z");
  EXPECT_EQ(alone_of(1e-3, 1e-13, 1e-3), "y");
  // What differs elsewhere by less says nothing.
  EXPECT_EQ(judge(std::vector<Finding>{{"zero 4", "x", "y", 1e-13, 1e-9},
                                       {"zero 4", "x", "z", kNaN, 1e-9},
                                       {"zero 4", "y", "z", kNaN, 1e-9},
                                       {"pole 1", "x", "y", 1e-3, 1e-9}})
                .alone,
            "z");
  // Each pair of responses is worst somewhere else.
  EXPECT_EQ(judge(std::vector<Finding>{{"hub_angle response at 3 Hz", "x", "y", 1e-4, 1e-7},
                                       {"hub_angle response at 4 Hz", "x", "z", 1e-9, 1e-7},
                                       {"hub_angle response at 4 Hz", "y", "z", 1e-4, 1e-7}})
                .alone,
            "y");
}

TEST(Judge, NamesNoneWhereAllDifferOrTwoAreCompared) {
  EXPECT_EQ(judge(std::vector<Finding>{{"zero 4", "x", "y", 1e-3, 1e-9}}).alone, "");
  EXPECT_EQ(alone_of(1e-3, 1e-3, 1e-3), "");
  EXPECT_EQ(alone_of(1e-13, 1e-13, 1e-13), "");
}

TEST(Judge, NothingToJudgeIsAMistakeOfTheCaller) {
  EXPECT_THROW(judge({}), std::invalid_argument);
}

}  // namespace
}  // namespace flexarm::compare
