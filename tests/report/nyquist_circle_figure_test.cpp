#include "report/figures/nyquist_circle_figure.hpp"

#include "report/figures/svg.hpp"
#include "tests/report/measured_sample.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace flexarm::report {
namespace {

using Complex = std::complex<double>;
using testing::HasSubstr;

constexpr double kTwoPi = 2.0 * std::numbers::pi;

std::vector<measured::NyquistCircle> circles_of(const arm::Sensor& sensor, int points = 401,
                                                double step_Hz = 0.005) {
  return measured::nyquist_circles(
             stepped_sine(measured::damped_paper_arm(), sensor, 2, points, step_Hz))
      .circles;
}

/// The response in velocity form.
Complex velocity(const arm::Sensor& sensor, double frequency_Hz) {
  const exact_tf::ExactArm exact(measured::damped_paper_arm());
  const Complex s(0.0, kTwoPi * frequency_Hz);
  return exact.transfer_function(sensor, s) * std::pow(s, 1 - arm::derivative_order(sensor));
}

TEST(NyquistCircleFigure, MarksThePointsOfTheirFrequencies) {
  for (const char* name : {"hub_angle", "hub_velocity", "tip_acceleration"}) {
    const arm::Sensor sensor = arm::parse_sensor(name);
    const auto circles = circles_of(sensor);
    ASSERT_EQ(circles.size(), 2U);
    const Figure figure = nyquist_circle_figure(sensor, std::span(circles).first(1));
    const Panel& panel = figure.stacks.at(0).panels.at(0);
    const Series* natural = find_series(panel, "natural frequency");
    const Series* half = find_series(panel, "half-power points");
    ASSERT_NE(natural, nullptr);
    ASSERT_NE(half, nullptr);
    const double zeta = circles[0].damping_ratio;
    const double f_Hz = circles[0].natural_frequency_Hz;
    // The other modes' slope over the resonance, in radii: measured/modal/nyquist_circle.hpp.
    const double near = 0.02 * circles[0].circle.radius;
    const auto distance = [&](const Series& mark, std::size_t i, double at_Hz) {
      return std::abs(Complex(mark.x[i], mark.y[i]) - velocity(sensor, at_Hz));
    };
    EXPECT_LT(distance(*natural, 0, f_Hz), near) << name;
    EXPECT_LT(distance(*half, 0, f_Hz * (std::sqrt(1.0 + zeta * zeta) - zeta)), near) << name;
    EXPECT_LT(distance(*half, 1, f_Hz * (std::sqrt(1.0 + zeta * zeta) + zeta)), near) << name;
  }
}

TEST(NyquistCircleFigure, HasEqualAxesAndAPanelAResonance) {
  const auto circles = circles_of(arm::parse_sensor("hub_angle"));
  std::vector<measured::NyquistCircle> five;
  for (int i = 0; i < 5; ++i) five.push_back(circles[0]);
  const Figure figure = nyquist_circle_figure(arm::parse_sensor("hub_angle"), five);
  ASSERT_EQ(figure.stacks.size(), 3U);
  EXPECT_EQ(figure.stacks[0].panels.size(), 2U);
  EXPECT_EQ(figure.stacks[2].panels.size(), 1U);
  EXPECT_EQ(figure.stacks[2].blank_panels, 1);
  for (const PanelStack& stack : figure.stacks) {
    EXPECT_TRUE(stack.square);
    for (const Panel& panel : stack.panels) {
      const double width = *panel.x->maximum - *panel.x->minimum;
      EXPECT_NEAR(width, *panel.y.maximum - *panel.y.minimum, 1e-12 * width);
    }
  }
}

TEST(NyquistCircleFigure, OfManyPointsDrawsSome) {
  const auto circles = circles_of(arm::parse_sensor("hub_angle"), 6001, 0.0005);
  ASSERT_FALSE(circles.empty());
  EXPECT_GT(circles.back().velocity.size(), 1000U);
  const Figure figure = nyquist_circle_figure(arm::parse_sensor("hub_angle"), circles);
  for (const PanelStack& stack : figure.stacks) {
    EXPECT_LE(find_series(stack.panels[0], "measured")->x.size(), 500U);
  }
  EXPECT_LT(to_svg(figure).size(), kMostBytes);
}

TEST(NyquistCircleFigure, RefusesNothingAndACircleWithoutASize) {
  EXPECT_THROW(nyquist_circle_figure({}, {}), std::invalid_argument);
  EXPECT_THROW(nyquist_circle_figure({}, std::vector<measured::NyquistCircle>(1)),
               std::invalid_argument);
}

TEST(NyquistCircleFigure, DrawsWithUnitsOfTheVelocityAndLabelsApart) {
  const char* units[] = {"Re V [rad/s/(N m)]", "Re V [rad/s/(N m)]", "Re V [m/s/(N m)]",
                         "Re V [1/s/(N m)]"};
  std::size_t i = 0;
  for (const char* name : {"hub_angle", "hub_velocity", "tip_acceleration", "strain@0.05"}) {
    const arm::Sensor sensor = arm::parse_sensor(name);
    const Figure figure = nyquist_circle_figure(sensor, circles_of(sensor), "Circles");
    EXPECT_EQ(overlapping_labels(figure), 0) << name;
    const std::string svg = to_svg(figure);
    for (const char* text :
         {units[i], "fitted circle", "measured", "natural frequency", "half-power points"}) {
      EXPECT_THAT(svg, HasSubstr(std::string("<text>") + text + "</text>")) << name;
    }
    EXPECT_THAT(svg, HasSubstr("<text>resonance at 11.86"));
    ++i;
  }
}

}  // namespace
}  // namespace flexarm::report
