#include "report/figures/figure_layout.hpp"

#include "report/figures/linear_ticks.hpp"
#include "report/figures/logarithmic_ticks.hpp"
#include "report/figures/robust_range.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
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
  ASSERT_EQ(layout.legend.size(), 60U);
  EXPECT_GT(layout.legend.front().left_px, right_px);
  EXPECT_GT(layout.legend.back().left_px, layout.legend.front().left_px) << "a second column";
  for (const PlacedLegendEntry& entry : layout.legend) EXPECT_GT(entry.middle_px, 0.0);
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

TEST(FigureLayout, LegendHasNothingThatDoesNotShow) {
  Figure figure = one_panel();
  Panel& panel = figure.stacks[0].panels[0];
  panel.y.minimum = 0.0;
  panel.y.maximum = 10.0;
  panel.series.push_back({"above", {0, 1}, {20, 30}, {}});
  panel.series.push_back({"through", {0, 1}, {-20, 30}, {}});
  panel.series.push_back({"no number", {0, 1}, {kNotDrawn, kNotDrawn}, {}});
  panel.series.push_back({"area above", {0, 1}, {11, 11}, {.filled = true}, {20, 20}});
  panel.series.push_back({"area across", {0, 1}, {5, 5}, {.filled = true}, {20, 20}});
  std::vector<std::string> names;
  for (const auto& entry : lay_out(figure).legend) names.push_back(entry.text);
  EXPECT_THAT(names, testing::ElementsAre("a", "through", "area across"));
}

TEST(FigureLayout, OutliersDoNotSetARobustAxisAndAreCounted) {
  Figure figure = one_panel();
  Panel& panel = figure.stacks[0].panels[0];
  Series& series = panel.series[0];
  series = {"a", {}, {}, {}};
  for (int k = 0; k < 1000; ++k) {
    series.x.push_back(k);
    series.y.push_back(k == 500 ? 1000.0 : (k == 700 ? -300.0 : k % 10));
  }
  EXPECT_GT(lay_out(figure).boxes[0][0].y.to, 1000.0);
  EXPECT_EQ(lay_out(figure).boxes[0][0].note, "");
  panel.y.robust = true;
  panel.note = "NRMSE 3 %";
  const PanelBox box = lay_out(figure).boxes[0][0];
  EXPECT_LT(box.y.to, 10.0);
  EXPECT_GT(box.y.from, -1.0);
  EXPECT_EQ(box.note, "NRMSE 3 %; 2 of 1000 points outside, up to −300 and 1e+03");
}

TEST(FigureLayout, LabelsOfTicksHaveThePowerOfTenInTheLabelOfTheAxis) {
  Figure figure = one_panel();
  Panel& panel = figure.stacks[0].panels[0];
  panel.y = {.label = "residual", .unit = "rad"};
  panel.series[0].y = {3.5e-5, 4e-5};
  const PanelBox box = lay_out(figure).boxes[0][0];
  EXPECT_EQ(box.y_label, "residual [10⁻⁶ rad]");
  for (const Tick& tick : box.y_ticks) EXPECT_LT(tick.label.size(), 6U) << tick.label;
}

TEST(FigureLayout, AnAxisLabelLongerThanItsPanelHasLines) {
  Figure figure = one_panel();
  figure.height_px = 260;
  figure.stacks[0].panels[0].y = {.label = "tip acceleration", .unit = "m/s²"};
  const FigureLayout small = lay_out(figure);
  EXPECT_EQ(small.boxes[0][0].y_label, "tip acceleration\n[m/s²]");
  figure.height_px = 600;
  const FigureLayout high = lay_out(figure);
  EXPECT_EQ(high.boxes[0][0].y_label, "tip acceleration [m/s²]");
  EXPECT_GT(small.boxes[0][0].left_px, high.boxes[0][0].left_px);
}

TEST(FigureLayout, ALabelStandsBesideTheNumbersOfItsPanel) {
  Figure figure = one_panel();
  Panel names = figure.stacks[0].panels[0];
  names.y.ticks = {{5.0, "sensor hub angle, hub velocity"}};
  figure.stacks[0].panels.push_back(names);
  const auto boxes = lay_out(figure).boxes[0];
  EXPECT_LT(boxes[0].label_px, 0.5 * boxes[0].left_px);
  EXPECT_GT(boxes[1].label_px, 0.8 * boxes[1].left_px);
}

TEST(FigureLayout, LongLegendEntriesAndTitlesHaveLines) {
  Figure figure = one_panel();
  figure.title = std::string(40, 'a') + " " + std::string(40, 'b') + " " + std::string(40, 'c');
  figure.stacks[0].panels[0].series[0].name = "finite elements, 5 elements of increasing degree";
  const FigureLayout layout = lay_out(figure);
  EXPECT_EQ(line_count(layout.title), 2);
  EXPECT_GT(line_count(layout.legend[0].text), 1);
  EXPECT_GT(layout.boxes[0][0].right_px, 0.5 * figure.width_px);
}

/// Room along a horizontal axis of a font of 10 px.
double room_of(const std::string& label) {
  return TextSize{10.0}.width_px(label) + 10.0;
}

TEST(LinearTicks, AreRoundNumbersThatHaveRoom) {
  EXPECT_EQ(labels(linear_ticks({0.0, 10.0}, 400.0, room_of).ticks), "0 2 4 6 8 10");
  EXPECT_EQ(labels(linear_ticks({0.0, 10.0}, 100.0, room_of).ticks), "0 5 10");
  EXPECT_EQ(labels(linear_ticks({-0.3, 0.31}, 120.0, room_of).ticks), "−0.2 0 0.2");
  EXPECT_EQ(labels(linear_ticks({345.0, 350.5}, 300.0, room_of).ticks), "345 346 347 348 349 350");
}

TEST(LinearTicks, HaveFewDigits) {
  const LinearTicks small = linear_ticks({2e-5, 4.1e-5}, 250.0, room_of);
  EXPECT_EQ(small.exponent, -6);
  EXPECT_EQ(labels(small.ticks), "20 25 30 35 40");
  EXPECT_NEAR(small.ticks[1].position, 2.5e-5, 1e-18);
  const LinearTicks large = linear_ticks({0.0, 3e6}, 100.0, room_of);
  EXPECT_EQ(large.exponent, 6);
  EXPECT_EQ(labels(large.ticks), "0 1 2 3");
  EXPECT_EQ(linear_ticks({-4.0, 0.02}, 200.0, room_of).exponent, 0);
}

TEST(RobustRange, LeavesOutFewValuesFarFromTheOthersAlone) {
  std::vector<double> values;
  for (int k = 0; k < 1000; ++k) values.push_back(std::sin(0.1 * k));
  EXPECT_EQ(robust_range(values).outside, 0U);
  values[10] = 50.0;
  values[11] = 3.0;  // within twice the range of the others
  const RobustRange range = robust_range(values);
  EXPECT_EQ(range.outside, 1U);
  EXPECT_EQ(range.high, 3.0);
  // A pulse is no outlier: too many values.
  for (int k = 0; k < 20; ++k) values[static_cast<std::size_t>(k)] = 50.0;
  EXPECT_EQ(robust_range(values).outside, 0U);
  EXPECT_EQ(robust_range({1.0, 1.0, 100.0}).outside, 0U);
  EXPECT_EQ(robust_range(std::vector<double>(100, 2.0)).outside, 0U);
}

TEST(LogarithmicTicks, AreDecadesInOneNotation) {
  EXPECT_EQ(labels(logarithmic_ticks({0.5, 2000.0}, 10)), "1 10 100 1000");
  EXPECT_EQ(labels(logarithmic_ticks({5e-5, 20.0}, 10)), "10⁻⁴ 10⁻³ 10⁻² 10⁻¹ 10⁰ 10¹");
  EXPECT_EQ(labels(logarithmic_ticks({1e-16, 1.0}, 5)), "10⁻¹⁶ 10⁻¹² 10⁻⁸ 10⁻⁴ 10⁰");
}

TEST(LogarithmicTicks, LabelTwoAndFiveWhereDecadesAreFew) {
  EXPECT_EQ(labels(logarithmic_ticks({1.5, 30.0}, 10)), "2 5 10 20");
  EXPECT_EQ(labels(logarithmic_ticks({15.0, 80.0}, 10)), "20 30 40 50 60 70 80");
  EXPECT_EQ(labels(logarithmic_ticks({15.0, 80.0}, 5)), "20 50");
  EXPECT_EQ(labels(logarithmic_ticks({3e-4, 3e-3}, 10)), "5·10⁻⁴ 10⁻³ 2·10⁻³");
}

}  // namespace
}  // namespace flexarm::report
