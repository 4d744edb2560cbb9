#include "report/figures/convergence_figure.hpp"

#include "report/figures/svg.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace flexarm::report {
namespace {

using testing::HasSubstr;

/// Errors of order 4 that end in rounding, and an exact zero.
ConvergencePlot convergence_plot() {
  ConvergencePlot plot;
  plot.title = "convergence";
  for (int mode = 1; mode <= 10; ++mode) {
    ConvergenceCurve fem{"fem", "pole " + std::to_string(mode), {}, {}};
    for (double n = 4; n <= 256; n *= 2) {
      fem.degrees_of_freedom.push_back(2 * n);
      fem.relative_error.push_back(std::pow(mode / n, 4));
    }
    fem.degrees_of_freedom.push_back(1024);
    fem.relative_error.push_back(1e-6);
    plot.curves.push_back(fem);
    plot.curves.push_back({"assumed_modes", fem.feature, {5, 10}, {1e-3, 0.0}});
  }
  plot.slopes = {{"fem", 4}};
  plot.rounding_level = 2.2e-16;
  return plot;
}

TEST(ConvergenceFigure, HasAColourAFormulationAndAMarkerAMode) {
  const Figure figure = convergence_figure(convergence_plot());
  const auto& series = figure.stacks.at(0).panels.at(0).series;
  ASSERT_EQ(series.size(), 22U);
  EXPECT_EQ(series[0].name, "fem, pole 1");
  for (std::size_t i = 0; i < 20; i += 2) {
    EXPECT_EQ(series[i].style.colour, series[0].style.colour);
    EXPECT_EQ(series[i + 1].style.colour, series[1].style.colour);
    EXPECT_EQ(series[i].style.marker, series[i + 1].style.marker);
    for (std::size_t j = 0; j < i; j += 2)
      EXPECT_NE(series[i].style.marker, series[j].style.marker);
  }
  EXPECT_NE(series[0].style.colour, series[1].style.colour);
}

TEST(ConvergenceFigure, AnErrorOfZeroIsDrawnAtHalfAnEpsilon) {
  const Figure figure = convergence_figure(convergence_plot());
  EXPECT_EQ(figure.stacks[0].panels[0].series[1].y[1], kSmallestDrawnError);
}

TEST(ConvergenceFigure, AReferenceSlopeHasItsOrderAndLiesAboveTheFallingCurves) {
  const Figure figure = convergence_figure(convergence_plot());
  const Series& slope = figure.stacks[0].panels[0].series[20];
  ASSERT_EQ(slope.name, "order 4 (fem)");
  EXPECT_NEAR(std::log(slope.y[0] / slope.y[1]) / std::log(slope.x[1] / slope.x[0]), 4.0, 1e-12);
  const double level = slope.y[0] * std::pow(slope.x[0], 4);
  EXPECT_GT(level, std::pow(2 * 10, 4));  // mode 10's curve is (20/dof)^4
  EXPECT_LT(level, 10 * std::pow(2 * 10, 4));
}

TEST(ConvergenceFigure, ASlopeWithNothingToLieAboveIsLeftOut) {
  ConvergencePlot coarse = convergence_plot();
  coarse.curves = {{"fem", "pole 1", {5, 9}, {0.3, 0.05}}};
  const Figure figure = convergence_figure(coarse);
  ASSERT_EQ(figure.stacks[0].panels[0].series.size(), 2U);
  EXPECT_EQ(figure.stacks[0].panels[0].series[1].name, "rounding");
}

TEST(ConvergenceFigure, ACurveOfTwoLengthsIsRefused) {
  ConvergencePlot bad = convergence_plot();
  bad.curves[0].relative_error.pop_back();
  EXPECT_THROW(convergence_figure(bad), std::invalid_argument);
}

TEST(ConvergenceFigure, DrawsEveryCurveAndNamesItInTheLegend) {
  const std::string svg = to_svg(convergence_figure(convergence_plot()));
  for (const char* text : {"<text>fem</text>", "<text>assumed_modes</text>", "<text>pole 10</text>",
                           "<text>order 4 (fem)</text>", "<text>rounding</text>",
                           "<title>assumed_modes, pole 10</title>"}) {
    EXPECT_THAT(svg, HasSubstr(text));
  }
}

}  // namespace
}  // namespace flexarm::report
