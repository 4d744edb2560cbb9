#include "report/figures/label_placement.hpp"

#include "report/figures/figure_layout.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace flexarm::report {
namespace {

Figure with_labels(const std::vector<Annotation>& labels, Scale scale = Scale::linear) {
  Panel panel;
  panel.y = {.scale = scale, .minimum = 1.0, .maximum = 1000.0};
  panel.series = {{"a", {0.5, 100.0}, {1.0, 1.0}, {}}};
  panel.annotations = labels;
  return {.stacks = {{.x = {.scale = scale, .minimum = 0.5, .maximum = 100.0}, .panels = {panel}}}};
}

std::vector<TextBox> boxes_of(const Figure& figure) {
  const PanelBox box = lay_out(figure).boxes[0][0];
  const PanelStack& stack = figure.stacks[0];
  std::vector<TextBox> boxes;
  for (const Annotation& annotation : stack.panels[0].annotations) {
    boxes.push_back(text_box(annotation, box, stack.x, stack.panels[0].y));
  }
  return boxes;
}

class PlacedLabels : public testing::TestWithParam<Scale> {};

TEST_P(PlacedLabels, DoNotOverlapAndStayInThePanel) {
  std::vector<Annotation> labels;
  for (int k = 0; k < 40; ++k) {
    labels.push_back({1.0 + 2.5 * k, 300.0 + 10.0 * k, std::to_string(1.0 + 2.5 * k),
                      k % 3 == 0 ? TextPlace::below : TextPlace::above});
  }
  Figure figure = with_labels(labels, GetParam());
  place_labels(figure);
  const auto boxes = boxes_of(figure);
  const PanelBox panel = lay_out(figure).boxes[0][0];
  EXPECT_GT(boxes.size(), 10U);
  EXPECT_EQ(figure.stacks[0].panels[0].annotations[0].text, labels[0].text);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    EXPECT_GE(boxes[i].left_px, panel.left_px - 1e-9);
    EXPECT_LE(boxes[i].right_px, panel.right_px + 1e-9);
    EXPECT_GE(boxes[i].bottom_px, panel.bottom_px - 1e-9);
    for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(boxes[i].overlaps(boxes[j])) << i << j;
  }
}

INSTANTIATE_TEST_SUITE_P(Scales, PlacedLabels, testing::Values(Scale::linear, Scale::logarithmic));

TEST(LabelPlacement, LeavesALabelThatIsInNobodysWay) {
  Figure figure = with_labels({{50.0, 500.0, "50.00", TextPlace::above}});
  place_labels(figure);
  const Annotation& label = figure.stacks[0].panels[0].annotations.at(0);
  EXPECT_NEAR(label.x, 50.0, 1e-9);
  EXPECT_NEAR(label.y, 500.0, 1e-9);
}

TEST(LabelPlacement, GoesOutOfTheWayOfALine) {
  Figure figure = with_labels({{50.0, 500.0, "50.00", TextPlace::above}});
  const PanelBox box = lay_out(figure).boxes[0][0];
  const double y_per_px = (box.y.to - box.y.from) / (box.top_px - box.bottom_px);
  const double through = 500.0 + TextSize{}.above_px() * y_per_px;
  figure.stacks[0].panels[0].series.push_back({"b", {0.5, 100.0}, {through, through}, {}});
  place_labels(figure);
  ASSERT_EQ(boxes_of(figure).size(), 1U);
  const TextBox text = boxes_of(figure)[0];
  const double line_px = box.bottom_px + (through - box.y.from) / y_per_px;
  EXPECT_GT(text.bottom_px, line_px);
}

TEST(LabelPlacement, APeakAtTheUpperEdgeIsLabelledBesideIt) {
  Figure figure = with_labels({{50.0, 1000.0, "50.00", TextPlace::above}});
  place_labels(figure);
  ASSERT_EQ(figure.stacks[0].panels[0].annotations.size(), 1U);
  const PanelBox panel = lay_out(figure).boxes[0][0];
  EXPECT_LE(boxes_of(figure)[0].top_px, panel.top_px + panel.text.line_px());
}

TEST(LabelPlacement, TakesAwayWhatHasNoPlace) {
  Figure figure =
      with_labels(std::vector<Annotation>(40, Annotation{50.0, 500.0, "50.00", TextPlace::above}));
  place_labels(figure);
  const std::size_t left = figure.stacks[0].panels[0].annotations.size();
  EXPECT_GE(left, 5U);
  EXPECT_LE(left, 15U);  // five rows of three
}

TEST(LabelPlacement, LabelsAtTheEndsOfCurvesStandApartInTheirOrder) {
  std::vector<Annotation> ends;
  for (const double y : {500.0, 501.0, 505.0, 900.0}) {
    ends.push_back({99.0, y, fmt::format("{}", y), TextPlace::end});
  }
  Figure figure = with_labels(ends);
  place_labels(figure);
  const auto boxes = boxes_of(figure);
  ASSERT_EQ(boxes.size(), 4U);
  for (std::size_t i = 1; i < boxes.size(); ++i) {
    EXPECT_GT(boxes[i].bottom_px, boxes[i - 1].top_px);
  }
  EXPECT_NEAR(figure.stacks[0].panels[0].annotations[3].y, 900.0, 1e-9);
}

TEST(LabelPlacement, KeepsClearOfLabelsThatStay) {
  const Annotation stays{50.0, 500.0, "stays where it is", TextPlace::centre};
  Figure figure = with_labels({stays, {50.0, 480.0, "moves", TextPlace::above}});
  place_labels(figure);
  EXPECT_EQ(figure.stacks[0].panels[0].annotations[0].y, stays.y);
  const auto boxes = boxes_of(figure);
  ASSERT_EQ(boxes.size(), 2U);
  EXPECT_FALSE(boxes[0].overlaps(boxes[1]));
}

}  // namespace
}  // namespace flexarm::report
