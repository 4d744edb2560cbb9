#include "report/figures/bode_figure.hpp"

#include "report/figures/svg.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>
#include <string>

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

TEST(BodeFigure, DecibelsAreTwentyTimesTheLogarithm) {
  BodePlot decibel = bode_plot();
  decibel.magnitude = Magnitude::decibel;
  const Panel panel = bode_figure(decibel).stacks[0].panels[0];
  EXPECT_EQ(panel.y.unit, "dB re 1 rad/(N m)");
  EXPECT_THAT(panel.series[0].y, ElementsAre(20.0, 0.0, DoubleNear(-20.0, 1e-13)));
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

TEST(BodeFigure, AWrapIsAGap) {
  BodePlot wrapping = bode_plot();
  wrapping.curves = {{"a", {}}};
  for (const double angle_deg : {100.0, 130.0, 140.0}) {
    wrapping.curves[0].response.push_back(std::polar(2.0, angle_deg * std::numbers::pi / 180.0));
  }
  const Series phase = bode_figure(wrapping).stacks[0].panels[1].series[0];
  ASSERT_EQ(phase.y.size(), 4U);
  EXPECT_TRUE(std::isnan(phase.y[2]));
  EXPECT_NEAR(phase.y[3], -220.0, kAngleTolerance_deg);
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
