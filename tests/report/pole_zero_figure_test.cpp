#include "report/figures/pole_zero_figure.hpp"

#include "report/figures/meaning.hpp"
#include "report/figures/svg.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <complex>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace flexarm::report {
namespace {

using testing::HasSubstr;
using testing::UnorderedElementsAre;
using Root = std::complex<double>;

std::vector<Root> mirrored(const std::vector<Root>& roots) {
  return with_mirror_images(roots);
}

const Series& series_named(const Panel& panel, const std::string& name) {
  for (const Series& series : panel.series) {
    if (series.name == name) return series;
  }
  throw std::out_of_range(name);
}

PoleZeroPlot pole_zero_plot() {
  const std::vector<Root> poles = mirrored({{0, 75}, {0, 203}, {0, 4600}});
  const std::vector<Root> zeros = mirrored({{57, 0}, {310, 0}});
  return {"torque to tip_acceleration", {{"exact_tf", poles, zeros}, {"fem", poles, zeros}}};
}

TEST(PoleZeroFigure, MirrorImagesArePairsOnAnAxisAndQuadruplesOffThem) {
  EXPECT_THAT(mirrored({{0, 2}}), UnorderedElementsAre(Root(0, 2), Root(0, -2)));
  EXPECT_THAT(mirrored({{3, 0}}), UnorderedElementsAre(Root(3, 0), Root(-3, 0)));
  EXPECT_THAT(mirrored({{1, 2}}),
              UnorderedElementsAre(Root(1, 2), Root(1, -2), Root(-1, 2), Root(-1, -2)));
}

TEST(PoleZeroFigure, BothAxesOfThePlaneAreAlike) {
  const PanelStack plane = pole_zero_figure(pole_zero_plot()).stacks.at(0);
  const Axis& y = plane.panels.at(0).y;
  EXPECT_TRUE(plane.square);
  EXPECT_EQ(plane.x.minimum, y.minimum);
  EXPECT_EQ(plane.x.maximum, y.maximum);
  ASSERT_EQ(plane.x.ticks.size(), y.ticks.size());
  const Series& poles = series_named(plane.panels[0], "exact_tf, poles");
  const Series& zeros = series_named(plane.panels[0], "exact_tf, zeros");
  for (const double x : poles.x) EXPECT_EQ(x, 0.0);
  for (const double z : zeros.y) EXPECT_EQ(z, 0.0);
  EXPECT_EQ(poles.x.size(), 6U);
  EXPECT_EQ(zeros.x.size(), 4U);
}

TEST(PoleZeroFigure, RowsPartTheRootsByTheNearerAxis) {
  const PanelStack strips = pole_zero_figure(pole_zero_plot()).stacks.at(1);
  ASSERT_EQ(strips.panels.size(), 2U);
  EXPECT_EQ(series_named(strips.panels[0], "fem, poles").x.front(), 75.0);
  EXPECT_THROW(series_named(strips.panels[0], "fem, zeros"), std::out_of_range);
  EXPECT_EQ(series_named(strips.panels[1], "fem, zeros").x.front(), 57.0);
}

TEST(PoleZeroFigure, NoMarkerIsCutAtTheEndsOfTheRows) {
  const Axis x = pole_zero_figure(pole_zero_plot()).stacks.at(1).x;
  EXPECT_LT(x.minimum.value(), 0.95 * 57.0);
  EXPECT_GT(x.maximum.value(), 1.05 * 4600.0);
}

TEST(PoleZeroFigure, RootsAtTheOriginAndAtInfinityAreLeftOut) {
  PoleZeroPlot odd = pole_zero_plot();
  odd.sets[0].zeros_rad_per_s = {{0, 0}, {std::numeric_limits<double>::infinity(), 0}, {0, 9}};
  const PanelStack plane = pole_zero_figure(odd).stacks.at(0);
  EXPECT_EQ(series_named(plane.panels[0], "exact_tf, zeros").y.size(), 1U);
  EXPECT_THROW(pole_zero_figure({"none", {{"fem", {{0, 0}}, {}}}}), std::invalid_argument);
}

TEST(PoleZeroFigure, MeasuredMarksAreSeenAmongThoseOfAllFormulations) {
  PoleZeroPlot plot = pole_zero_plot();
  plot.sets.push_back(plot.sets[0]);
  plot.sets.back().formulation = "assumed_modes";
  plot.sets.push_back({"measured", {{0, 75.4}}, {}, true});
  const Panel plane = pole_zero_figure(plot).stacks.at(0).panels.at(0);
  const Style measured = series_named(plane, "measured, poles").style;
  EXPECT_EQ(measured.colour, kMeasuredColour);
  EXPECT_GT(measured.marker_size, series_named(plane, "fem, poles").style.marker_size);
  EXPECT_GE(measured.marker_size, 1.0) << "gnuplot's standard; it was 0.5, about 2 pixels";
}

TEST(PoleZeroFigure, DrawsEveryFormulation) {
  const std::string svg = to_svg(pole_zero_figure(pole_zero_plot()));
  for (const char* text : {"Re s [rad/s]", "Im s [rad/s]", "|s| [rad/s]", "exact_tf", "fem", "pole",
                           "zero", "−1000"}) {
    EXPECT_THAT(svg, HasSubstr(std::string("<text>") + text + "</text>"));
  }
}

}  // namespace
}  // namespace flexarm::report
