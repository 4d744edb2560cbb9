#include "report/bode_figure.hpp"

#include "report/svg.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace flexarm::report {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kAngleTolerance_deg = 1e-12;  // a few roundings of numbers up to 1000

std::vector<std::complex<double>> at_angles(const std::vector<double>& angles_deg) {
  std::vector<std::complex<double>> values;
  for (const double angle : angles_deg) {
    values.push_back(std::polar(2.0, angle * std::numbers::pi / 180.0));
  }
  return values;
}

TEST(BodeFigure, WrappedPhaseKeepsTheMultiplesOf90DegAwayFromTheCut) {
  const double e = 1e-6;
  const auto phase =
      phase_deg(at_angles({0, 180 - e, 180 + e, 90 + e, -90, 134, 136}), Phase::wrapped);
  const std::vector<double> expected{0, -180 - e, -180 + e, 90 + e, -90, 134, -224};
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(phase[i], expected[i], 1e-9);
}

TEST(BodeFigure, UnwrappedPhaseGoesOnOverFullTurns) {
  std::vector<double> falling;
  for (double angle = -30; angle > -900; angle -= 100) falling.push_back(angle);
  const auto phase = phase_deg(at_angles(falling), Phase::unwrapped);
  for (std::size_t i = 0; i < falling.size(); ++i) EXPECT_NEAR(phase[i], falling[i], 1e-9);
}

BodePlot plot() {
  return {
      .title = "torque to hub_angle",
      .unit = "rad/(N m)",
      .frequency_Hz = {1, 10, 100},
      .curves = {{"exact_tf", {10.0, -1.0, {0.0, 0.1}}}, {"fem", {10.0, -1.0 + 1e-6, {0.0, 0.1}}}}};
}

TEST(BodeFigure, ThirdPanelIsTheRelativeDifferenceFromTheFirstCurve) {
  const Figure figure = bode_figure(plot());
  ASSERT_EQ(figure.stacks.at(0).panels.size(), 3U);
  EXPECT_THAT(figure.stacks[0].panels[2].series.at(0).y,
              ElementsAre(0x1p-53, DoubleNear(1e-6, 1e-15), 0x1p-53));

  BodePlot one = plot();
  one.curves.pop_back();
  EXPECT_EQ(bode_figure(one).stacks[0].panels.size(), 2U);
}

TEST(BodeFigure, DecibelsAreTwentyTimesTheLogarithm) {
  BodePlot decibel = plot();
  decibel.magnitude = Magnitude::decibel;
  const Panel panel = bode_figure(decibel).stacks[0].panels[0];
  EXPECT_EQ(panel.y.unit, "dB re 1 rad/(N m)");
  EXPECT_THAT(panel.series[0].y, ElementsAre(20.0, 0.0, DoubleNear(-20.0, 1e-13)));
}

TEST(BodeFigure, PolesAndZerosWithinTheFrequenciesAreMarkedBelowTheCurves) {
  BodePlot marked = plot();
  marked.poles_Hz = {0.5, 11.0, 200.0};
  marked.zeros_Hz = {3.0};
  const auto series = bode_figure(marked).stacks[0].panels[0].series;
  ASSERT_EQ(series.size(), 4U);
  EXPECT_THAT(series[2].x, ElementsAre(11.0));
  EXPECT_THAT(series[3].x, ElementsAre(3.0));
  EXPECT_LT(series[2].y[0], 0.1);
}

TEST(BodeFigure, AWrapIsAGap) {
  BodePlot wrapping = plot();
  wrapping.curves = {{"a", at_angles({100, 130, 140})}};
  const Series phase = bode_figure(wrapping).stacks[0].panels[1].series[0];
  ASSERT_EQ(phase.y.size(), 4U);
  EXPECT_TRUE(std::isnan(phase.y[2]));
  EXPECT_NEAR(phase.y[3], -220.0, kAngleTolerance_deg);
}

TEST(BodeFigure, AResponseOfAnotherLengthIsRefused) {
  BodePlot bad = plot();
  bad.curves[1].response.pop_back();
  EXPECT_THROW(bode_figure(bad), std::invalid_argument);
}

TEST(BodeFigure, DrawsWithAxesUnitsAndNames) {
  const std::string svg = to_svg(bode_figure(plot()));
  for (const char* text : {"frequency [Hz]", "magnitude [rad/(N m)]", "phase [deg]",
                           "relative difference", "exact_tf", "fem", "−180"}) {
    EXPECT_THAT(svg, HasSubstr(std::string("<text>") + text + "</text>"));
  }
}

}  // namespace
}  // namespace flexarm::report
