#include "report/figures/bode_figure.hpp"

#include "report/figures/svg.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <complex>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

namespace flexarm::report {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kAngleTolerance_deg = 1e-12;  // a few roundings of numbers up to 1000

BodePlot bode_plot() {
  return {
      .title = "torque to hub_angle",
      .unit = "rad/(N m)",
      .frequency_Hz = {1, 10, 100},
      .curves = {{"exact_tf", {10.0, -1.0, {0.0, 0.1}}}, {"fem", {10.0, -1.0 + 1e-6, {0.0, 0.1}}}}};
}

TEST(BodeFigure, ThirdPanelIsTheRelativeDifferenceFromTheFirstCurve) {
  const Figure figure = bode_figure(bode_plot());
  ASSERT_EQ(figure.stacks.at(0).panels.size(), 3U);
  EXPECT_THAT(figure.stacks[0].panels[2].series.at(0).y,
              ElementsAre(0x1p-53, DoubleNear(1e-6, 1e-15), 0x1p-53));

  BodePlot one = bode_plot();
  one.curves.pop_back();
  EXPECT_EQ(bode_figure(one).stacks[0].panels.size(), 2U);
}

TEST(BodeFigure, PolesAndZerosWithinTheFrequenciesAreMarkedBelowTheCurves) {
  BodePlot marked = bode_plot();
  marked.poles_Hz = {0.5, 11.0, 200.0};
  marked.zeros_Hz = {3.0};
  const auto series = bode_figure(marked).stacks[0].panels[0].series;
  ASSERT_EQ(series.size(), 4U);
  EXPECT_THAT(series[2].x, ElementsAre(11.0));
  EXPECT_THAT(series[3].x, ElementsAre(3.0));
  EXPECT_LT(series[2].y[0], 0.1);
}

TEST(BodeFigure, ThePhaseIsOneCurveBeyondHalfATurn) {
  BodePlot turning = bode_plot();
  turning.curves = {{"a", {}}};
  const std::vector<double> angles_deg = {-100.0, -220.0, -340.0};
  for (const double angle_deg : angles_deg) {
    turning.curves[0].response.push_back(std::polar(2.0, angle_deg * std::numbers::pi / 180.0));
  }
  const Series phase = bode_figure(turning).stacks[0].panels[1].series[0];
  ASSERT_EQ(phase.y.size(), 3U) << "no gap";
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(phase.y[i], angles_deg[i], kAngleTolerance_deg);
}

TEST(BodeFigure, AResponseOfAnotherLengthIsRefused) {
  BodePlot bad = bode_plot();
  bad.curves[1].response.pop_back();
  EXPECT_THROW(bode_figure(bad), std::invalid_argument);
}

TEST(BodeFigure, DrawsWithAxesUnitsAndNames) {
  const std::string svg = to_svg(bode_figure(bode_plot()));
  for (const char* text : {"frequency [Hz]", "magnitude [rad/(N m)]", "phase [deg]",
                           "relative difference", "exact_tf", "fem", "−180"}) {
    EXPECT_THAT(svg, HasSubstr(std::string("<text>") + text + "</text>"));
  }
}

}  // namespace
}  // namespace flexarm::report
