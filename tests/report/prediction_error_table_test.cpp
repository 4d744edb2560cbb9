#include "report/tables/prediction_error_table.hpp"

#include "report/tables/csv.hpp"
#include "report/tables/text_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace flexarm::report {
namespace {

using diagnose::PredictionError;
using testing::HasSubstr;

std::vector<PredictionError> two_channels() {
  return {{"a", "hub_angle", 1, 0.002, 0.01, 0.004},
          {"a", "hub_angle", {}, 0.0, 2.0, 0.5},
          {"a", "tip_acceleration", 1, 0.002, 0.03, 0.006},
          {"a", "tip_acceleration", {}, 0.0, 4.0, 1.0}};
}

TEST(PredictionErrorTable, HasTheMeanOfTheChannels) {
  const Table table = prediction_error_table(two_channels());
  ASSERT_EQ(table.rows.size(), 1U) << "the simulation of whole runs is in the tables of NRMSE";
  EXPECT_EQ(std::get<std::int64_t>(table.rows[0][0]), 1);
  EXPECT_DOUBLE_EQ(std::get<double>(table.rows[0][1]), 0.002);
  EXPECT_DOUBLE_EQ(std::get<double>(table.rows[0][2]), 2.0);
  EXPECT_DOUBLE_EQ(std::get<double>(table.rows[0][3]), 0.5);
  EXPECT_THAT(to_text(table), HasSubstr("Prediction error k steps ahead"));
}

TEST(PredictionErrorTable, HasNoTimeWhereTheRunsDiffer) {
  auto errors = two_channels();
  errors[2].run = "b";
  errors[2].ahead_s = 0.004;
  EXPECT_TRUE(is_missing(prediction_error_table(errors).rows[0][1]));
}

TEST(ChannelPredictionErrorTable, HasARowAChannelAndHorizon) {
  const Table table = channel_prediction_error_table(two_channels());
  ASSERT_EQ(table.rows.size(), 4U);
  EXPECT_THAT(to_csv(table), HasSubstr("hub_angle,simulation,,200,50"));
}

}  // namespace
}  // namespace flexarm::report
