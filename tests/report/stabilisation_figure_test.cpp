#include "report/figures/stabilisation_figure.hpp"

#include "report/figures/svg.hpp"
#include "tests/report/measured_sample.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace flexarm::report {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;

measured::StabilisationChart chart() {
  measured::StabilisationChart made;
  made.from_Hz = 1.0;
  made.to_Hz = 50.0;
  made.orders = {2, 4, 6, 8};
  made.poles = {{2, 12.0, 0.01, false, false, false},
                {4, 12.1, 0.02, true, false, false},
                {6, 12.1, 0.02, true, true, false},
                {6, 30.0, 0.02, true, false, true},
                {8, 12.1, 0.02, true, true, true}};
  return made;
}

TEST(StabilisationFigure, HasASymbolForWhatIsStable) {
  const Panel panel = stabilisation_figure(chart()).stacks.at(0).panels.at(0);
  const auto orders = [&](const char* name) {
    const Series* found = find_series(panel, name);
    return found ? found->y : std::vector<double>{};
  };
  EXPECT_THAT(orders("new pole"), ElementsAre(2));
  EXPECT_THAT(orders("stable frequency"), ElementsAre(4, 6));
  EXPECT_THAT(orders("stable frequency and damping"), ElementsAre(6));
  EXPECT_THAT(orders("stable pole"), ElementsAre(8));
}

TEST(StabilisationFigure, DrawsTheBackgroundOverTheOrdersWithinTheBand) {
  const MeanResponse mean{{0.5, 1.0, 10.0, 50.0, 60.0}, {1e9, 1.0, 100.0, 0.0, 1e-9}};
  const Panel panel = stabilisation_figure(chart(), {.background = mean}).stacks[0].panels[0];
  const Series* course = find_series(panel, "mean |H|, log");
  ASSERT_NE(course, nullptr);
  EXPECT_THAT(course->x, ElementsAre(1.0, 10.0, 50.0));
  EXPECT_THAT(course->y, ElementsAre(2.0, 8.0, testing::IsNan()));
}

TEST(StabilisationFigure, LabelsFittedPolesInTheBand) {
  const Figure figure =
      stabilisation_figure(chart(), {.fitted_poles_Hz = {12.1, 12.2, 12.3, 70.0}});
  const auto& labels = figure.stacks[0].panels[0].annotations;
  ASSERT_EQ(labels.size(), 3U);
  EXPECT_EQ(labels[0].text, "12.10");
  EXPECT_EQ(overlapping_labels(figure), 0);
}

TEST(StabilisationFigure, RefusesAChartWithoutAPole) {
  EXPECT_THROW(stabilisation_figure({}), std::invalid_argument);
}

TEST(MeanResponse, IsTheGeometricMeanAtTheFirstChannelsFrequencies) {
  measured::FrequencyRecord record;
  record.channels.push_back({arm::parse_sensor("hub_angle"), {1, 2, 3, 4}, {4, 4, 4, 4}, {}});
  record.channels.push_back({arm::parse_sensor("hub_velocity"), {1, 3}, {1, {0, 100}}, {}});
  const MeanResponse mean = mean_response(record);
  EXPECT_EQ(mean.frequency_Hz, record.channels[0].frequency_Hz);
  EXPECT_THAT(mean.magnitude,
              ElementsAre(DoubleNear(2.0, 1e-13), DoubleNear(std::sqrt(40.0), 1e-13),
                          DoubleNear(20.0, 1e-13), testing::IsNan()));
  EXPECT_TRUE(mean_response({}).frequency_Hz.empty());
}

TEST(StabilisationFigure, OfTheArmHasAColumnAtEachFittedPole) {
  auto arm_case = sample_case();
  arm_case.sensors = measured::sensors_named({"hub_velocity", "tip_acceleration"});
  arm_case.duration_s = 40.0;
  const std::array records = {measured::record_of(arm_case)};
  const auto fit = measured::fit_modes(records, {.modes = 3});
  StabilisationPlot plot{.title = "Stabilisation"};
  plot.background = mean_response(
      measured::to_frequency_record(measured::estimate_frequency_response(records[0])));
  for (const auto& pole : fit.poles) plot.fitted_poles_Hz.push_back(pole.frequency_Hz);
  const Figure figure = stabilisation_figure(fit.chart, plot);
  const Series* stable = find_series(figure.stacks[0].panels[0], "stable pole");
  ASSERT_NE(stable, nullptr);
  for (const double pole_Hz : plot.fitted_poles_Hz) {
    EXPECT_GE(std::ranges::count_if(
                  stable->x, [&](double f_Hz) { return std::abs(f_Hz / pole_Hz - 1.0) < 0.01; }),
              3)
        << pole_Hz;
  }
  const std::string svg = to_svg(figure);
  EXPECT_LT(svg.size(), kMostBytes);
  for (const char* text : {"order of the denominator", "frequency [Hz]", "fitted pole",
                           "mean |H|, log", "stable pole"}) {
    EXPECT_THAT(svg, HasSubstr(std::string("<text>") + text + "</text>")) << text;
  }
}

}  // namespace
}  // namespace flexarm::report
