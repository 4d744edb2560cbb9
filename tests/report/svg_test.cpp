#include "report/figures/svg.hpp"

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace flexarm::report {
namespace {

using boost::property_tree::ptree;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// Parses the document and throws where it is not well-formed.
ptree parsed(const std::string& svg) {
  std::istringstream stream(svg);
  ptree tree;
  read_xml(stream, tree);
  return tree;
}

/// The content of every element of that name, in the order of the document.
void collect(const ptree& tree, const std::string& element, std::vector<std::string>& found) {
  for (const auto& [name, child] : tree) {
    if (name == element) found.push_back(child.data());
    collect(child, element, found);
  }
}

std::vector<std::string> texts(const std::string& svg, const std::string& element = "text") {
  std::vector<std::string> found;
  collect(parsed(svg), element, found);
  return found;
}

Figure two_lines() {
  Figure figure;
  figure.title = "Two lines";
  Panel panel;
  panel.y = {.label = "error", .scale = Scale::logarithmic};
  Style dashed;
  dashed.colour = vermillion;
  dashed.line = Line::dashed;
  dashed.marker = Marker::circle;
  panel.series = {{"hub_angle", {1, 2, 3}, {1, 0.1, 0.01}, {}},
                  {"strain@0.05", {1, 2, 3}, {2, 0.2, 0.02}, dashed}};
  figure.stacks = {{.x = {.label = "time", .unit = "s"}, .panels = {panel}}};
  return figure;
}

/// Pieces of the first curve in the group with that title: "moveto" commands in its path.
std::ptrdiff_t pieces(const std::string& svg, const std::string& title) {
  const std::size_t group = svg.find("<title>" + title + "</title>");
  const std::size_t path = svg.find("d='M", group);
  return std::ranges::count(svg.substr(path, svg.find("'/>", path) - path), 'M');
}

TEST(Svg, IsWellFormedAndNamesItsTitleAxesAndSeries) {
  const std::string svg = to_svg(two_lines());
  EXPECT_THAT(texts(svg), AllOf(Contains("Two lines"), Contains("time [s]"), Contains("error"),
                                Contains("hub_angle"), Contains("strain@0.05")));
  EXPECT_THAT(texts(svg, "title"), AllOf(Contains("Two lines"), Contains("hub_angle").Times(2),
                                         Contains("strain@0.05").Times(2)));
}

TEST(Svg, IsTheSameBytesForTheSameFigureWithoutDateOrVersion) {
  const std::string svg = to_svg(two_lines());
  EXPECT_EQ(svg, to_svg(two_lines()));
  EXPECT_THAT(svg, AllOf(Not(HasSubstr("Produced by")), Not(HasSubstr("patchlevel"))));
}

TEST(Svg, TextIsShownAsItIsAndNeverInterpreted) {
  const std::string awkward = R"(<a> & "b" 'c' x_1^2 {d} \n @e `echo f` %g # λ²)";
  Figure figure = two_lines();
  figure.title = awkward;
  figure.width_px = 2000;  // room for one line in the legend
  figure.stacks[0].x.label = awkward;
  figure.stacks[0].panels[0].title = awkward;
  figure.stacks[0].panels[0].y.label = awkward;
  figure.stacks[0].panels[0].series[0].name = awkward;
  figure.stacks[0].panels[0].annotations = {{2, 0.1, awkward}};
  const std::string svg = to_svg(figure);
  EXPECT_THAT(texts(svg), AllOf(Contains(awkward).Times(5), Contains(awkward + " [s]")));
  EXPECT_THAT(texts(svg, "title"), Contains(awkward).Times(3));
  EXPECT_THAT(svg, AllOf(Not(HasSubstr("<a>")), Not(HasSubstr("& "))));
}

TEST(Svg, WhatXmlCannotHoldIsReplaced) {
  Figure figure = two_lines();
  figure.title = "bell \a and \xff";
  EXPECT_THAT(texts(to_svg(figure)), Contains("bell \uFFFD and \uFFFD"));
}

TEST(Svg, APointThatCannotBeDrawnIsAGap) {
  for (const double gap : {kNaN, HUGE_VAL, 0.0, -1.0}) {  // the last two on a logarithmic axis
    Figure figure = two_lines();
    figure.stacks[0].panels[0].series[0] = {
        "hub_angle", {1, 2, 3, 4, 5, 6, 7}, {1, 0.5, gap, gap, 0.2, 0.1, gap}, {}};
    EXPECT_EQ(pieces(to_svg(figure), "hub_angle"), 2) << gap;
  }
  EXPECT_EQ(pieces(to_svg(two_lines()), "hub_angle"), 1);
}

TEST(Svg, AnAreaIsAPolygonForEachStretchBetweenGaps) {
  Figure figure = two_lines();
  figure.stacks[0].panels[0].series.push_back({"band",
                                               {1, 1.5, 2, 2.2, 2.5, 3},
                                               {1, 1, kNaN, 1, 1, 1},
                                               {.colour = sky_blue, .filled = true},
                                               {2, 3, 2, 2, 3, 2}});
  const std::string svg = to_svg(figure);
  const std::size_t group = svg.find("<title>band</title>");
  const std::string area = svg.substr(group, svg.find("<title>", group + 1) - group);
  std::size_t polygons = 0;
  for (std::size_t at = area.find("<polygon"); at != std::string::npos;
       at = area.find("<polygon", at + 1)) {
    ++polygons;
  }
  EXPECT_EQ(polygons, 2U);
  EXPECT_THAT(texts(svg), Contains("band"));
}

TEST(Svg, ASeriesWithNothingToDrawIsNotInTheLegend) {
  Figure figure = two_lines();
  figure.stacks[0].panels[0].series[0].y.assign(3, kNaN);
  const std::string svg = to_svg(figure);
  EXPECT_THAT(texts(svg), Not(Contains("hub_angle")));
  EXPECT_THAT(texts(svg, "title"),
              AllOf(Not(Contains("hub_angle")), Contains("strain@0.05").Times(2)));
}

TEST(Svg, PanelsOfOneStackShareTheLowestPanelsAxis) {
  Figure figure = two_lines();
  figure.stacks[0].panels.push_back(figure.stacks[0].panels[0]);
  figure.stacks[0].panels[1].y.label = "other error";
  const std::string svg = to_svg(figure);
  EXPECT_THAT(texts(svg), AllOf(Contains("time [s]").Times(1), Contains("error"),
                                Contains("other error"), Contains("hub_angle").Times(1)));
}

}  // namespace
}  // namespace flexarm::report
