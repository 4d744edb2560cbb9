#include "report/figures/nyquist_figure.hpp"

#include "report/figures/figure_layout.hpp"
#include "report/figures/svg.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

namespace flexarm::report {
namespace {

using Complex = std::complex<double>;
using testing::HasSubstr;

constexpr double kRounding = 1e-12;

/// `count` circles of a single pole, each a hundred times smaller than the one before.
NyquistPlot plot(std::size_t count) {
  NyquistPlot plot{
      .title = "Torque to hub_angle", .unit = "rad/(N m)", .response = {}, .circles = {}};
  double diameter = 20.0;
  for (std::size_t i = 0; i < count; ++i, diameter /= 100.0) {
    NyquistCircle circle{.label = "pole " + std::to_string(i + 1),
                         .values = {},
                         .at_pole = {0.0, -diameter},
                         .below = {diameter / 2, -diameter / 2},
                         .above = {-diameter / 2, -diameter / 2}};
    for (int j = 1; j < 40; ++j) {
      circle.values.push_back(Complex(0.0, -diameter / 2) *
                              (1.0 + std::polar(1.0, std::numbers::pi * (1.0 - j / 20.0))));
    }
    plot.response.insert(plot.response.end(), circle.values.begin(), circle.values.end());
    plot.circles.push_back(circle);
  }
  return plot;
}

TEST(NyquistFigure, AnglesOfTheCompressedLocusAreTrue) {
  NyquistPlot one = plot(1);
  one.response = {{3.0, 4.0}, {-30.0, 40.0}, {0.0, -0.5}, {0.6, 0.8}};
  const auto series = nyquist_figure(one).stacks[0].panels[0].series;
  const auto locus = std::ranges::find(series, "response", &Series::name);
  ASSERT_NE(locus, series.end());
  for (std::size_t i = 0; i < one.response.size(); ++i) {
    EXPECT_NEAR(std::arg(Complex(locus->x[i], locus->y[i])), std::arg(one.response[i]), kRounding);
  }
  EXPECT_LT(std::hypot(locus->x[3], locus->y[3]), std::hypot(locus->x[0], locus->y[0]));
}

TEST(NyquistFigure, AValueThatIsNoneIsAGap) {
  NyquistPlot gap = plot(1);
  gap.response.insert(gap.response.begin() + 5, Complex(std::numeric_limits<double>::infinity()));
  const auto series = nyquist_figure(gap).stacks[0].panels[0].series;
  const auto locus = std::ranges::find(series, "response", &Series::name);
  EXPECT_TRUE(std::isnan(locus->x[5]));
}

TEST(NyquistFigure, EachCircleFillsAPanelToScale) {
  const Figure figure = nyquist_figure(plot(3));
  ASSERT_EQ(figure.stacks.size(), 3U);  // the locus, two circles, and the third
  EXPECT_EQ(figure.stacks[1].panels.size(), 2U);
  EXPECT_EQ(figure.stacks[2].panels.size(), 1U);
  EXPECT_EQ(figure.stacks[2].blank_panels, 1);
  for (const auto* panel : {&figure.stacks[1].panels[0], &figure.stacks[1].panels[1]}) {
    const double width = *panel->x->maximum - *panel->x->minimum;
    const double height = *panel->y.maximum - *panel->y.minimum;
    EXPECT_NEAR(width, height, kRounding * width);
  }
  EXPECT_EQ(figure.stacks[1].panels[0].x->unit, "rad/(N m)");
  EXPECT_THAT(lay_out(figure).boxes[2][0].x_label, testing::HasSubstr("[10⁻³ rad/(N m)]"));
  EXPECT_TRUE(figure.stacks[1].square);
}

TEST(NyquistFigure, APanelHoldsItsValuesHoweverFarTheyAreFromItsHalfPowerPoints) {
  NyquistPlot one = plot(1);
  // A pole whose neighbours are near: the background carries the response away.
  one.circles[0].values = {{40.0, 3.0}, {41.0, 2.0}, {43.0, -60.0}};
  const Panel panel = nyquist_figure(one).stacks[1].panels[0];
  for (const Complex& value : one.circles[0].values) {
    EXPECT_GT(value.real(), *panel.x->minimum);
    EXPECT_LT(value.real(), *panel.x->maximum);
    EXPECT_GT(value.imag(), *panel.y.minimum);
    EXPECT_LT(value.imag(), *panel.y.maximum);
  }
}

TEST(NyquistFigure, NegativeFrequenciesAndMinusOneAreShownOnRequest) {
  NyquistPlot small = plot(1);
  for (Complex& value : small.response) value *= 1e-3;
  const auto without = nyquist_figure(small).stacks[0].panels[0].series;
  small.marks = {.minus_one = true, .negative_frequencies = true};
  const Panel panel = nyquist_figure(small).stacks[0].panels[0];
  EXPECT_EQ(panel.series.size(), without.size() + 2 + 2) << "decades up to 1 are marked, too";
  const auto locus = std::ranges::find(panel.series, "response", &Series::name);
  const auto negative = std::ranges::find(panel.series, "negative frequencies", &Series::name);
  ASSERT_NE(negative, panel.series.end());
  EXPECT_EQ(negative->x, locus->x);
  EXPECT_EQ(negative->y.at(7), -locus->y.at(7));
  const auto minus_one = std::ranges::find(panel.series, "−1", &Series::name);
  ASSERT_NE(minus_one, panel.series.end());
  EXPECT_LT(minus_one->x.at(0), *std::ranges::min_element(locus->x));
  EXPECT_EQ(minus_one->y.at(0), 0.0);
}

TEST(NyquistFigure, NoMoreThanFourCirclesAreDrawn) {
  std::size_t panels = 0;
  const Figure figure = nyquist_figure(plot(6));
  for (const auto& stack : figure.stacks) panels += stack.panels.size();
  EXPECT_EQ(panels, 1U + 4U);
}

TEST(NyquistFigure, NothingToDrawIsRefused) {
  EXPECT_THROW(nyquist_figure(plot(0)), std::invalid_argument);
  NyquistPlot empty = plot(1);
  empty.response.clear();
  EXPECT_THROW(nyquist_figure(empty), std::invalid_argument);
}

TEST(NyquistFigure, DrawsEveryPanelWithItsOwnAxes) {
  const std::string svg = to_svg(nyquist_figure(plot(4)));
  for (const char* text : {"Re G [rad/(N m)]", "Im G [10⁻³ rad/(N m)]", "pole 4",
                           "all frequencies, modulus compressed", "half-power points"}) {
    EXPECT_THAT(svg, HasSubstr(std::string("<text>") + text + "</text>")) << text;
  }
}

}  // namespace
}  // namespace flexarm::report
