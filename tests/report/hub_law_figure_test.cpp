#include "report/figures/hub_law_figure.hpp"

#include "report/figures/svg.hpp"
#include "tests/report/measured_sample.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace flexarm::report {
namespace {

using diagnose::EmpiricalLaw;
using testing::DoubleEq;
using testing::ElementsAre;
using testing::HasSubstr;

EmpiricalLaw friction() {
  return {
      .table = {.velocity_rad_per_s = {-1.0, 0.0, 0.0, 1.0}, .torque_N_m = {0.3, 0.2, -0.2, -0.3}},
      .std_error_N_m = 0.01,
      .std_errors_N_m = {0.01, 0.01, 0.01, 0.02},
      .means = {{{-0.9, 0.31, 0.02}, {0.8, -0.28, 0.01}}}};
}

TEST(HubLawFigure, HasTheLawOverTheVelocityWithItsErrorsAndTheMeans) {
  const Figure figure = hub_law_figure(friction());
  ASSERT_EQ(figure.stacks.at(0).panels.size(), 1U);
  const PanelStack& stack = figure.stacks[0];
  EXPECT_EQ(stack.x.label, "hub velocity");
  EXPECT_EQ(stack.x.unit, "rad/s");
  const Panel& panel = stack.panels[0];
  EXPECT_EQ(panel.y.unit, "N m");
  const Series* law = find_series(panel, "empirical law");
  EXPECT_THAT(law->x, ElementsAre(-1.0, 0.0, 0.0, 1.0));
  EXPECT_THAT(law->y, ElementsAre(0.3, 0.2, -0.2, -0.3));
  const Series* interval = find_series(panel, "law ± 2 standard errors");
  EXPECT_DOUBLE_EQ(interval->y[3], -0.34);
  EXPECT_DOUBLE_EQ(interval->y_to[3], -0.26);
  EXPECT_THAT(find_series(panel, "mean residual hub torque")->x, ElementsAre(-0.9, 0.8));
  const Series* bars = find_series(panel, "mean ± 2 standard errors");
  EXPECT_DOUBLE_EQ(bars->y[0], 0.27);
  EXPECT_DOUBLE_EQ(bars->y[1], 0.35);
  const std::string svg = to_svg(figure);
  for (const char* text : {"hub velocity [rad/s]", "hub torque [N m]", "empirical law"}) {
    EXPECT_THAT(svg, HasSubstr(std::string("<text>") + text + "</text>")) << text;
  }
}

TEST(HubLawFigure, HasTheScaleOfTheLawWhereAPlaceIsUnknown) {
  EmpiricalLaw law = friction();
  law.std_errors_N_m.back() = 20.0;
  const Figure figure = hub_law_figure(law);
  const Panel& panel = figure.stacks.at(0).panels.at(0);
  EXPECT_LT(*panel.y.maximum, 1.0);
  EXPECT_GT(*panel.y.minimum, -1.0);
  const Series* interval = find_series(panel, "law ± 2 standard errors");
  EXPECT_EQ(interval->y.back(), *panel.y.minimum);
  EXPECT_EQ(interval->y_to.back(), *panel.y.maximum);
  // It reaches the frame where the interval does, not at the place itself.
  ASSERT_EQ(interval->x.size(), 6U);
  EXPECT_LT(interval->x[3], 0.02);
  EXPECT_LT(interval->x[4], 0.02);
}

TEST(HubLawFigure, OfBothHasAPanelForEachVelocityInOneRange) {
  const EmpiricalLaw law{.table = {.angle_rad = {0.0, 1.0, 2.0},
                                   .velocity_rad_per_s = {-1.0, 1.0},
                                   .torque_N_m = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6}},
                         .std_errors_N_m = {0.01, 0.02, 0.03, 0.04, 0.05, 0.06},
                         .means = {{{0.5, 0.2, 0.01}}, {}}};
  const Figure figure = hub_law_figure(law);
  EXPECT_EQ(figure.stacks.at(0).x.label, "hub angle");
  const auto& panels = figure.stacks[0].panels;
  ASSERT_EQ(panels.size(), 2U);
  EXPECT_EQ(panels[0].title, "hub velocity -1 rad/s");
  EXPECT_THAT(find_series(panels[0], "empirical law")->y, ElementsAre(0.1, 0.3, 0.5));
  EXPECT_THAT(find_series(panels[1], "empirical law")->y, ElementsAre(0.2, 0.4, 0.6));
  EXPECT_THAT(find_series(panels[1], "law ± 2 standard errors")->y,
              ElementsAre(DoubleEq(0.16), DoubleEq(0.32), DoubleEq(0.48)));
  EXPECT_EQ(panels[0].y.minimum, panels[1].y.minimum);
  EXPECT_EQ(panels[0].y.maximum, panels[1].y.maximum);
  // Where the hub never had that velocity there are no means.
  EXPECT_EQ(find_series(panels[1], "mean residual hub torque"), nullptr);
  EXPECT_THAT(to_svg(figure), HasSubstr("<text>hub angle [rad]</text>"));
}

}  // namespace
}  // namespace flexarm::report
