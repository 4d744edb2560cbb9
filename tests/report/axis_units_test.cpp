#include "report/figures/axis_units.hpp"

#include "report/figures/bode_figure.hpp"
#include "report/figures/feature_marks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace flexarm::report {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;

constexpr double kTwoPi = 2.0 * std::numbers::pi;

/// A Bode diagram with a peak at 10 Hz.
Figure bode() {
  Figure figure = bode_figure({.title = "torque to hub angle",
                               .unit = "rad/(N m)",
                               .frequency_Hz = {1, 10, 100},
                               .curves = {{"exact", {0.1, 10.0, {0.0, 0.01}}}}});
  Panel& panel = figure.stacks[0].panels[0];
  panel.y.minimum = 0.001;
  panel.series.push_back({"interval", {1.0, 10.0}, {0.05, 8.0}, {.filled = true}, {0.2, 12.0}});
  measured::SpectralFeature peak;
  peak.frequency_Hz = peak.line_Hz = 10.0;
  peak.level_dB = 20.0;
  add_feature_marks(panel, {&peak, 1}, FeatureLevel::amplitude);
  return figure;
}

TEST(AxisUnits, DecibelsAreTwentyTimesTheLogarithm) {
  const Figure made = in_units(bode(), MagnitudeScale::decibel, FrequencyUnit::hertz);
  const Panel& panel = made.stacks[0].panels[0];
  EXPECT_EQ(panel.y.unit, "dB re 1 rad/(N m)");
  EXPECT_EQ(panel.y.scale, Scale::linear);
  EXPECT_EQ(panel.y.minimum, -60.0);
  EXPECT_THAT(panel.series[0].y, ElementsAre(-20.0, 20.0, DoubleNear(-40.0, 1e-13)));
  EXPECT_NEAR(panel.series[1].y_to[1], 20.0 * std::log10(12.0), 1e-12);
  EXPECT_NEAR(panel.annotations[0].y, 20.0, 1e-12);
  EXPECT_EQ(made.stacks[0].panels[1].y.unit, "deg") << "the phase stays";
  EXPECT_EQ(made.stacks[0].x.unit, "Hz");
}

TEST(AxisUnits, AnInverseUnitIsItsOwnReference) {
  Figure strain = bode();
  strain.stacks[0].panels[0].y.unit = "1/(N m)";
  EXPECT_EQ(
      in_units(strain, MagnitudeScale::decibel, FrequencyUnit::hertz).stacks[0].panels[0].y.unit,
      "dB re 1/(N m)");
}

TEST(AxisUnits, AngularFrequenciesAreOnTheAxisAndInTheLabels) {
  const Figure made = in_units(bode(), MagnitudeScale::absolute, FrequencyUnit::radians_per_second);
  const PanelStack& stack = made.stacks[0];
  EXPECT_EQ(stack.x.unit, "rad/s");
  for (const Panel& panel : stack.panels) {
    EXPECT_NEAR(panel.series[0].x[1], kTwoPi * 10.0, 1e-12);
  }
  const Annotation& label = stack.panels[0].annotations[0];
  EXPECT_NEAR(label.x, kTwoPi * 10.0, 1e-12);
  EXPECT_EQ(label.text, "62.83");
  EXPECT_EQ(stack.panels[0].y.unit, "rad/(N m)");
}

TEST(AxisUnits, AFrequencyMayBeOnTheUprightAxis) {
  Figure sweep;
  sweep.stacks = {{.x = {.label = "payload mass", .unit = "kg"},
                   .panels = {{.y = {.label = "|s|/2π", .unit = "Hz", .maximum = 2.0},
                               .series = {{"", {0.1, 0.2}, {1.0, 2.0}}}}}}};
  const Figure made = in_units(sweep, MagnitudeScale::decibel, FrequencyUnit::radians_per_second);
  const Panel& panel = made.stacks[0].panels[0];
  EXPECT_EQ(panel.y.label, "|s|");
  EXPECT_EQ(panel.y.unit, "rad/s");
  EXPECT_EQ(panel.y.maximum, 2.0 * kTwoPi);
  EXPECT_EQ(panel.series[0].x[1], 0.2);
  EXPECT_EQ(panel.series[0].y[1], 2.0 * kTwoPi);
}

}  // namespace
}  // namespace flexarm::report
