#include "report/figures/figure_layout.hpp"

#include "report/figures/logarithmic_ticks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace flexarm::report {
namespace {

Figure one_panel() {
  Panel panel;
  panel.series = {{"a", {0, 1}, {0, 10}, {}}};
  return {.title = "t", .stacks = {{.panels = {panel}}}};
}

std::string refusal(const Figure& figure) {
  try {
    lay_out(figure);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

/// "1 2 5 10": the labels there are.
std::string labels(const std::vector<Tick>& ticks) {
  std::string text;
  for (const Tick& tick : ticks) {
    if (!tick.label.empty()) text += (text.empty() ? "" : " ") + tick.label;
  }
  return text;
}

TEST(FigureLayout, WhatCannotBeDrawnIsRefusedByName) {
  EXPECT_EQ(refusal(one_panel()), "");
  EXPECT_EQ(refusal({.title = "t"}), "figure \"t\" has no panels");

  Figure figure = one_panel();
  figure.stacks[0].panels[0].series.push_back({"b", {}, {}, {}});
  EXPECT_EQ(refusal(figure), "series \"b\": 0 values of x and 0 of y");
  figure.stacks[0].panels[0].series[1] = {"b", {1, 2}, {1}, {}};
  EXPECT_EQ(refusal(figure), "series \"b\": 2 values of x and 1 of y");

  figure = one_panel();
  figure.stacks[0].panels[0].series[0].style.filled = true;
  EXPECT_EQ(refusal(figure), "series \"a\": 2 values of y and 0 to fill up to");

  figure = one_panel();
  figure.stacks[0].panels[0].y.label = "gain";
  figure.stacks[0].panels[0].series[0].y.assign(2, std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(refusal(figure), "panel \"gain\": no series has a point to draw");

  figure = one_panel();
  figure.stacks[0].x = {.label = "f", .minimum = 2.0, .maximum = 2.0};
  EXPECT_EQ(refusal(figure), "axis \"f\": 2 to 2 is no range");
}

TEST(FigureLayout, RangesHoldTheDataWithAMarginAndKeepGivenLimits) {
  Figure figure = one_panel();
  figure.stacks[0].x.minimum = 0.0;
  const PanelBox box = lay_out(figure).boxes[0][0];
  EXPECT_EQ(box.x.from, 0.0);
  EXPECT_GT(box.x.to, 1.0);
  EXPECT_LT(box.y.from, 0.0);
  EXPECT_GT(box.y.to, 10.0);
}

TEST(FigureLayout, RangesHoldBothSidesOfAnArea) {
  Figure figure = one_panel();
  figure.stacks[0].panels[0].series.push_back({"b", {0, 1}, {-5, -5}, {.filled = true}, {20, 20}});
  const PanelBox box = lay_out(figure).boxes[0][0];
  EXPECT_LT(box.y.from, -5.0);
  EXPECT_GT(box.y.to, 20.0);
}

TEST(FigureLayout, ASingleValueGetsRoomAroundIt) {
  Figure figure = one_panel();
  for (const double value : {0.0, -3.0, 1e-12}) {
    figure.stacks[0].panels[0].series[0].y.assign(2, value);
    const PanelBox box = lay_out(figure).boxes[0][0];
    EXPECT_LT(box.y.from, value);
    EXPECT_GT(box.y.to, value);
  }
}

TEST(FigureLayout, RoundingOfOneValueDoesNotFillAPanel) {
  Figure figure = one_panel();
  auto& y = figure.stacks[0].panels[0].series[0].y;
  y.assign(y.size(), 57.4409);
  y.back() *= 1.0 + 1e-13;
  const PanelBox box = lay_out(figure).boxes[0][0];
  EXPECT_LT(box.y.from, 50.0);
  EXPECT_GT(box.y.to, 65.0);
}

TEST(FigureLayout, PanelsAndLegendDoNotOverlapAndStayInTheFigure) {
  Figure figure = one_panel();
  figure.stacks[0].panels.push_back(figure.stacks[0].panels[0]);
  figure.stacks[0].panels[1].title = "second";
  figure.stacks.push_back(figure.stacks[0]);
  figure.stacks[1].blank_panels = 1;
  for (int i = 0; i < 60; ++i) figure.legend.push_back({"entry " + std::to_string(i), Style{}});
  const FigureLayout layout = lay_out(figure);
  double right_px = 0.0;
  for (const auto& stack : layout.boxes) {
    EXPECT_GT(stack[0].left_px, right_px);
    right_px = stack[0].right_px;
    EXPECT_GT(right_px, stack[0].left_px);
    EXPECT_GT(stack[0].bottom_px, stack[1].top_px);
    EXPECT_GT(stack[1].bottom_px, 0.0);
    EXPECT_LT(stack[0].top_px, figure.height_px);
    EXPECT_NEAR(stack[0].top_px - stack[0].bottom_px, stack[1].top_px - stack[1].bottom_px, 1e-9);
  }
  EXPECT_GT(layout.boxes[1][1].bottom_px, layout.boxes[0][1].bottom_px);
  EXPECT_GT(layout.legend_left_px, right_px);
  EXPECT_LT(layout.legend_rows, 60);
  EXPECT_LT(layout.legend_rows * kLegendRow_px, layout.legend_top_px);
}

TEST(FigureLayout, ASquarePanelHasEqualSides) {
  Figure figure = one_panel();
  figure.stacks[0].square = true;
  const PanelBox box = lay_out(figure).boxes[0][0];
  EXPECT_NEAR(box.right_px - box.left_px, box.top_px - box.bottom_px, 1e-9);
}

TEST(FigureLayout, LegendHasEachNameOnce) {
  Figure figure = one_panel();
  figure.stacks[0].panels.push_back(figure.stacks[0].panels[0]);
  figure.stacks[0].panels[1].series.push_back({"b", {1}, {1}, {}});
  figure.stacks[0].panels[1].series.push_back({"", {1}, {1}, {}});
  const FigureLayout layout = lay_out(figure);
  ASSERT_EQ(layout.legend.size(), 2U);
  EXPECT_EQ(layout.legend[0].text, "a");
  EXPECT_EQ(layout.legend[1].text, "b");
}

TEST(LogarithmicTicks, AreDecadesInOneNotation) {
  EXPECT_EQ(labels(logarithmic_ticks({0.5, 2000.0}, 10)), "1 10 100 1000");
  EXPECT_EQ(labels(logarithmic_ticks({5e-5, 20.0}, 10)), "10⁻⁴ 10⁻³ 10⁻² 10⁻¹ 10⁰ 10¹");
  EXPECT_EQ(labels(logarithmic_ticks({1e-16, 1.0}, 5)), "10⁻¹⁶ 10⁻¹² 10⁻⁸ 10⁻⁴ 10⁰");
}

TEST(LogarithmicTicks, LabelTwoAndFiveWhereDecadesAreFew) {
  EXPECT_EQ(labels(logarithmic_ticks({1.5, 30.0}, 10)), "2 5 10 20");
  EXPECT_EQ(labels(logarithmic_ticks({15.0, 80.0}, 10)), "20 50");
  EXPECT_EQ(labels(logarithmic_ticks({3e-4, 3e-3}, 10)), "5·10⁻⁴ 10⁻³ 2·10⁻³");
}

}  // namespace
}  // namespace flexarm::report
