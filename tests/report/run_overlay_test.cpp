// Measured runs over their simulation: figure, tables, JSON and verdict.
#include "report/figures/run_overlay_figure.hpp"
#include "report/figures/svg.hpp"
#include "report/tables/csv.hpp"
#include "report/tables/measured_tables.hpp"
#include "tests/report/comparison_sample.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace flexarm::report {
namespace {

using Json = nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

/// A sine that the simulation misses by 10 % in the samples from `wrong` on, 100 of them.
compare::MeasuredTimeRun sample_run(std::size_t samples, std::size_t wrong) {
  compare::MeasuredTimeRun run;
  run.run = "steps";
  compare::MeasuredSignal angle{"hub_angle", "rad", {}, {}, {1}};
  for (std::size_t k = 0; k < samples; ++k) {
    run.time_s.push_back(0.01 * static_cast<double>(k));
    run.torque_N_m.push_back(k % 2 == 0 ? 0.1 : -0.1);
    angle.measured.push_back(std::sin(run.time_s.back()));
    const bool is_wrong = k >= wrong && k < wrong + 100;
    angle.simulated.push_back(angle.measured.back() * (is_wrong ? 0.9 : 1.0));
  }
  angle.nrmse_percent = 2.5;
  run.signals = {angle};
  return run;
}

TEST(RunOverlay, HasASignalItsResidualAndTheTorque) {
  const Figure figure = run_overlay_figure(sample_run(200, 50));
  ASSERT_EQ(figure.stacks.size(), 1U);
  const auto& panels = figure.stacks[0].panels;
  ASSERT_EQ(panels.size(), 3U);
  EXPECT_EQ(panels[0].y.label, "hub angle");
  EXPECT_EQ(panels[0].series[0].name, "measured");
  EXPECT_EQ(panels[0].series[1].name, "simulated");
  EXPECT_TRUE(std::isnan(panels[0].series[0].y[1])) << "left out";
  EXPECT_THAT(panels[1].note, AllOf(HasSubstr("fit of the run 97.5 %"), HasSubstr("NRMSE 2.5 %")));
  EXPECT_NEAR(panels[1].series[0].y[60], 0.1 * std::sin(0.6), 1e-12);
  EXPECT_EQ(panels[2].y.label, "torque");
  EXPECT_THAT(to_svg(figure), HasSubstr("Measured and simulated: steps"));
}

TEST(RunOverlay, OfALongRunTheWorstPartIsAtItsRight) {
  const Figure figure = run_overlay_figure(sample_run(5000, 3000));
  ASSERT_EQ(figure.stacks.size(), 2U);
  EXPECT_EQ(figure.stacks[0].panels[0].series[0].x.size(), 5000U);
  const auto& part = figure.stacks[1].panels[0].series[0].x;
  EXPECT_EQ(part.size(), kWholeSamples);
  EXPECT_LE(part.front(), 30.0);
  EXPECT_GE(part.back(), 30.99);
}

TEST(RunOverlay, AClosedLoopIsDrivenByItsReference) {
  compare::MeasuredTimeRun run = sample_run(100, 0);
  run.closed_loop = true;
  run.reference = {"rad", std::vector<double>(100, 0.3)};
  const Figure figure = run_overlay_figure(run);
  const auto& input = figure.stacks[0].panels.back();
  EXPECT_EQ(input.y.label, "reference");
  EXPECT_EQ(input.series[0].y.front(), 0.3);
}

TEST(RunOverlay, TablesHaveFitAndValues) {
  const auto run = sample_run(50, 0);
  EXPECT_THAT(to_csv(measured_runs_table({run})), HasSubstr("steps,rest,open,hub_angle,97.5,2.5"));
  const Table listing = measured_run_listing(run);
  EXPECT_EQ(listing.rows.size(), 50U);
  EXPECT_TRUE(is_missing(listing.rows[1][2])) << "left out";
  EXPECT_EQ(std::get<double>(listing.rows[2][2]), std::sin(0.02));
}

TEST(RunOverlay, WhatTheTimeLimitLeftOutIsTold) {
  ComparedArm compared = sample_comparison();
  EXPECT_EQ(out_of_time_text(compared.comparison, compared.measured), "");
  compared.comparison.are_refinements_complete = false;
  compared.measured.runs_out_of_time = {"one", "two"};
  EXPECT_EQ(out_of_time_text(compared.comparison, compared.measured),
            "the time limit left no time for the whole convergence study and simulations of one, "
            "two");
  const auto document = Json::parse(comparison_json({compared}));
  EXPECT_EQ(document["comparisons"][0]["refinements_complete"], false);
  EXPECT_EQ(document["comparisons"][0]["runs_out_of_time"], Json({"one", "two"}));
}

TEST(RunOverlay, JsonHasTheRunAndItsVerdict) {
  ComparedArm compared = sample_comparison();
  compared.measured = {{}, {}, {}, {sample_run(50, 0)}, {"loaded"}};
  const auto document = Json::parse(comparison_json({compared}));
  EXPECT_EQ(document["measured_verdict"], "agrees");
  const auto& arm = document["comparisons"][0];
  EXPECT_EQ(arm["measured_runs"][0]["channels"][0]["fit_percent"], 97.5);
  EXPECT_EQ(arm["runs_left_out"], Json({"loaded"}));
  EXPECT_EQ(arm["measured_verdict"]["largest_difference_of"], "hub_angle of run steps");
  EXPECT_TRUE(arm["measured_verdict"]["chi_square"].is_null());
  compared.measured.runs[0].signals[0].nrmse_percent = std::nan("");
  const auto constant = Json::parse(comparison_json({compared}));
  EXPECT_TRUE(constant["measured_verdict"].is_null());
  EXPECT_TRUE(
      constant["comparisons"][0]["measured_runs"][0]["channels"][0]["fit_percent"].is_null());
}

TEST(MeasuredVerdictLine, SaysBothKindsOfDifferences) {
  compare::MeasuredComparison measured = sample_comparison().measured;
  EXPECT_EQ(
      measured_verdict_line(compare::judge(measured)),
      "Measurement: agrees with the model. Largest difference: 1.4 standard deviations (pole 1 "
      "frequency); chi-square 1.96 of 1 number, probability 0.16, limit 0.046. Largest "
      "difference without a standard deviation: 4.5 % (hub_angle response of run sine), "
      "tolerance 5 %.");
  measured.tolerance_percent = 4.0;
  EXPECT_THAT(measured_verdict_line(compare::judge(measured)),
              testing::StartsWith("Measurement: DIFFERS from the model. "));
  measured.rows.clear();
  EXPECT_EQ(measured_verdict_line(compare::judge(measured)),
            "Measurement: DIFFERS from the model. Largest difference: 4.5 % (hub_angle response of "
            "run sine), tolerance 4 %.");
}

}  // namespace
}  // namespace flexarm::report
