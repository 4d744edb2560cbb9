#include "tests/trials/calibration.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace flexarm::trials {
namespace {

using testing::HasSubstr;
using testing::Not;

TrialResult claiming(std::vector<Claim> claims) {
  TrialResult one;
  one.claims = std::move(claims);
  return one;
}

TEST(Reliability, BrierScoreIsTheMeanSquare) {
  const auto all = reliability({claiming({{1.0, true}, {0.5, false}}), claiming({{0.0, true}})});
  EXPECT_EQ(all.claims, 3);
  EXPECT_NEAR(all.brier, (0.0 + 0.25 + 1.0) / 3.0, 1e-15);
}

TEST(Reliability, BinsHoldTheirLowerEndsAndTheLastHoldsOne) {
  const auto all = reliability({claiming({{1.0, true}, {0.9, false}, {0.1, false}, {0.05, true}})});
  EXPECT_EQ(all.bins[9].claims, 2);
  EXPECT_EQ(all.bins[9].right, 1);
  EXPECT_NEAR(all.bins[9].sum_of_probabilities, 1.9, 1e-15);
  EXPECT_EQ(all.bins[1].claims, 1);
  EXPECT_EQ(all.bins[0].right, 1);
}

TEST(Reliability, TableStatesBounds) {
  const std::vector<TrialResult> results(60, claiming({{0.95, true}}));
  const std::string table = reliability_table(results);
  EXPECT_THAT(table, HasSubstr("Brier score 0.003 over 60 identified effects."));
  EXPECT_THAT(table, HasSubstr("| 90 to 100 | 60 | 95 % | 100 % (95 to 100 %) |"));
  EXPECT_THAT(table, Not(HasSubstr("| 0 to 10 |")));
  EXPECT_EQ(reliability_table({}), "No effect identified.\n");
}

TEST(Coverage, IsCountedByKindWithBounds) {
  TrialResult one;
  one.kind = "frf";
  one.parameters = 30;
  one.covered = 30;
  TrialResult other = one;
  other.kind = "time";
  other.covered = 15;
  const std::string table = coverage_table({one, one, other});
  EXPECT_THAT(table, HasSubstr("| frf | 60 | 100 % (95 to 100 %) |"));
  EXPECT_THAT(table, HasSubstr("| time | 30 | 50 % (34 to 66 %) |"));
}

}  // namespace
}  // namespace flexarm::trials
