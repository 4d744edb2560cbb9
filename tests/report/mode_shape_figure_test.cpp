#include "report/figures/mode_shape_figure.hpp"

#include "report/figures/svg.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace flexarm::report {
namespace {

using testing::HasSubstr;

ModeShapePlot mode_shape_plot(int modes) {
  ModeShapePlot plot{.title = "Mode shapes", .station_m = {0.0, 0.5, 1.0}, .modes = {}};
  for (int i = 1; i <= modes; ++i) {
    plot.modes.push_back(
        {"mode " + std::to_string(i), {{"exact_tf", {0.0, 1.0, -1.0}}, {"fem", {0.0, 1.0, -1.0}}}});
  }
  return plot;
}

TEST(ModeShapeFigure, HasAPanelAModeInAtMostTwoColumns) {
  EXPECT_EQ(mode_shape_figure(mode_shape_plot(3)).stacks.size(), 1U);
  const Figure five = mode_shape_figure(mode_shape_plot(5));
  ASSERT_EQ(five.stacks.size(), 2U);
  EXPECT_EQ(five.stacks[0].panels.size(), 3U);
  EXPECT_EQ(five.stacks[1].panels.size(), 2U);
  EXPECT_EQ(five.stacks[1].blank_panels, 1);
}

TEST(ModeShapeFigure, AShapeOfAnotherLengthIsRefused) {
  ModeShapePlot bad = mode_shape_plot(1);
  bad.modes[0].curves[1].displacement.pop_back();
  EXPECT_THROW(mode_shape_figure(bad), std::invalid_argument);
  bad.station_m.clear();
  EXPECT_THROW(mode_shape_figure(bad), std::invalid_argument);
}

TEST(ModeShapeFigure, DrawsEveryModeAndFormulation) {
  const std::string svg = to_svg(mode_shape_figure(mode_shape_plot(5)));
  for (const char* text : {"mode 1", "mode 5", "displacement [m]", "exact_tf", "fem",
                           "distance from the motor axis [m]"}) {
    EXPECT_THAT(svg, HasSubstr(std::string("<text>") + text + "</text>"));
  }
}

}  // namespace
}  // namespace flexarm::report
