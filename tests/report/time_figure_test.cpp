#include "report/figures/time_figure.hpp"

#include "report/figures/svg.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

namespace flexarm::report {
namespace {

using testing::HasSubstr;

TimePlot time_plot(std::size_t samples) {
  TimePlot plot{.title = "arm: bang-bang", .time_s = {}, .panels = {}};
  std::vector<double> wave;
  for (std::size_t k = 0; k < samples; ++k) {
    plot.time_s.push_back(0.001 * static_cast<double>(k));
    wave.push_back(std::sin(0.02 * static_cast<double>(k)));
  }
  std::vector<double> half = wave;
  for (auto& value : half) value *= 0.5;
  plot.panels = {{"torque", "N m", {{"commanded", wave}, {"at the hub", half}}},
                 {"hub angle", "rad", {{"", wave}}},
                 {"strain at 0.05 m", "", {{"", wave}}}};
  return plot;
}

TEST(TimeFigure, StacksThePanelsOnOneTimeAxis) {
  const Figure figure = time_figure(time_plot(100));
  ASSERT_EQ(figure.stacks.size(), 1U);
  EXPECT_EQ(figure.stacks[0].x.label, "time");
  ASSERT_EQ(figure.stacks[0].panels.size(), 3U);
  EXPECT_EQ(figure.stacks[0].panels[0].series.size(), 2U);
  EXPECT_EQ(figure.stacks[0].panels[0].series[0].x.size(), 100U);
  EXPECT_GT(figure.height_px, time_figure({"", {0.0}, {{"x", "m", {{"", {0.0}}}}}}).height_px);
}

TEST(TimeFigure, OfALongSignalWhatShowsIsDrawn) {
  TimePlot one = time_plot(1'000'000);
  one.panels.resize(2);
  EXPECT_LT(to_svg(time_figure(one)).size(), 400'000U);
}

TEST(TimeFigure, DrawsEveryPanelAndTheLegendOfThoseWithSeveralCurves) {
  const std::string svg = to_svg(time_figure(time_plot(500)));
  for (const char* text : {"arm: bang-bang", "torque [N m]", "hub angle [rad]", "strain at 0.05 m",
                           "time [s]", "commanded", "at the hub"}) {
    EXPECT_THAT(svg, HasSubstr(std::string("<text>") + text + "</text>"));
  }
}

TEST(TimeFigure, ACurveOfAnotherLengthIsRefused) {
  TimePlot bad = time_plot(10);
  bad.panels[1].curves[0].values.pop_back();
  EXPECT_THROW(time_figure(bad), std::invalid_argument);
  bad.panels.clear();
  EXPECT_THROW(time_figure(bad), std::invalid_argument);
}

}  // namespace
}  // namespace flexarm::report
