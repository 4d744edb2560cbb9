#include "compare/responses.hpp"

#include "tests/compare/models.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace flexarm::compare {
namespace {

std::vector<response::AnyFormulation> formulations(const arm::Arm& first, const arm::Arm& second) {
  return {exact_tf::ExactArm(first), exact_tf::ExactArm(second)};
}

arm::Arm damped_arm() {
  arm::Arm arm = arm::paper_arm();
  arm.damping.kelvin_voigt_s = 1e-4;
  return arm;
}

TEST(Responses, TheGridRunsFromATenthOfTheFirstPoleToJustBelowTheLast) {
  const auto grid = response_grid_Hz({10.0, 32.0, 58.0}, 100);
  ASSERT_EQ(grid.size(), 100U);
  EXPECT_NEAR(grid.front(), 1.0, 1e-12);
  EXPECT_NEAR(grid.back(), (1.0 - kOffResonance) * 58.0, 1e-12);
  EXPECT_NEAR(grid[50] / grid[49], grid[1] / grid[0], 1e-12) << "even in the logarithm";
}

TEST(Responses, TheGridResolvesPeaksThatItsStepsWouldMiss) {
  const std::vector<double> features = {20.0, 200.0};
  const auto grid = response_grid_Hz({10.0, 250.0}, 100, features);
  EXPECT_TRUE(std::ranges::is_sorted(grid));
  for (const double feature_Hz : features) {
    const auto above = std::ranges::upper_bound(grid, feature_Hz);
    EXPECT_LT(*above / feature_Hz - 1.0, 2e-4);
    EXPECT_LT(1.0 - *(above - 1) / feature_Hz, 2e-4);
    EXPECT_EQ(std::ranges::count(grid, feature_Hz), 0) << "there a response has no bound";
  }
}

TEST(Responses, AModelAgreesWithItself) {
  const auto seen =
      compare_responses(formulations(damped_arm(), damped_arm()), kHubAngle, {1.0, 11.8, 30.0}, {});
  EXPECT_EQ(seen.largest_error, (std::vector<double>{0.0, 0.0}));
  EXPECT_EQ(seen.one_minus_coherence, (std::vector<double>(3, 0.0)));
}

TEST(Responses, ErrorAndCoherenceFollowTheirFormulas) {
  arm::Arm heavier = damped_arm();
  heavier.hub.inertia_kg_m2 *= 1.1;
  const auto seen =
      compare_responses(formulations(damped_arm(), heavier), kHubAngle, {1.0, 20.0}, {});
  for (std::size_t k = 0; k < 2; ++k) {
    const auto a = seen.values[0][k];
    const auto b = seen.values[1][k];
    EXPECT_DOUBLE_EQ(seen.relative_error[1][k], std::abs(b - a) / std::abs(a));
    const double coherence = std::norm(a + b) / (2.0 * (std::norm(a) + std::norm(b)));
    EXPECT_NEAR(seen.one_minus_coherence[k], 1.0 - coherence, 1e-14);
  }
}

TEST(Responses, WhatIsNearAFeatureDoesNotCountAndTheWorstOfTheRestIsNamed) {
  arm::Arm stiffer = damped_arm();
  stiffer.damping.kelvin_voigt_s = 2e-4;
  const double pole_Hz = 11.8618;
  const std::vector<double> grid = {5.0, pole_Hz * (1.0 + 0.9 * kOffResonance), 15.0};
  const auto all = compare_responses(formulations(damped_arm(), stiffer), kHubAngle, grid, {});
  EXPECT_EQ(all.largest_error_frequency_Hz[1], grid[1]);
  const auto off =
      compare_responses(formulations(damped_arm(), stiffer), kHubAngle, grid, {pole_Hz});
  EXPECT_NE(off.largest_error_frequency_Hz[1], grid[1]);
  EXPECT_GT(off.largest_error[1], 0.0);
  EXPECT_LT(off.largest_error[1], all.largest_error[1]);
}

TEST(Responses, AResponseThatIsNotANumberIsWorstWhereverItIs) {
  // The undamped response of strain at the tip is 0 at every frequency: 0/0 in the error.
  const arm::Sensor tip_strain{arm::SensorKind::strain, arm::paper_arm().beam.length_m};
  const auto models = formulations(arm::paper_arm(), arm::paper_arm());
  const auto seen = compare_responses(models, tip_strain, {1.0, 20.0, 40.0}, {});
  EXPECT_TRUE(std::isnan(seen.largest_error[1]));
  EXPECT_EQ(seen.largest_error_frequency_Hz[1], 1.0);
}

}  // namespace
}  // namespace flexarm::compare
