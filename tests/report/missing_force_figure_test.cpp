#include "report/figures/missing_force_figure.hpp"

#include "report/figures/svg.hpp"
#include "tests/report/measured_sample.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace flexarm::report {
namespace {

using diagnose::ForceBand;
using diagnose::ForcePort;
using diagnose::MissingForce;
using testing::DoubleEq;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::NanSensitiveDoubleEq;
using testing::Not;

MissingForce at_hub() {
  MissingForce made;
  made.ports = {
      {.port = ForcePort::hub, .place = "torque on the hub", .share = 0.9, .std_error = 0.02},
      {.port = ForcePort::sensor,
       .sensors = {"hub_angle"},
       .place = "error of hub_angle",
       .share = 0.3,
       .std_error = 0.04},
      {.port = ForcePort::root, .place = "rotation at the root", .share = -0.1, .std_error = 0.05}};
  made.stated = 1;
  made.lines = 200;
  made.size = {.unit = "N m", .rms = 0.013, .std_error = 0.001, .from_Hz = 1.0, .to_Hz = 8.0};
  made.size->spectrum = {
      {1.0, 1.25, 1e-4, 1.25e-5}, {1.25, 1.6, 6.4e-5, 4e-5}, {4.0, 5.0, 0.0, 0.0}};
  return made;
}

TEST(MissingForceFigure, HasTheSpectrumInBands) {
  const Figure figure = missing_force_figure(at_hub());
  ASSERT_EQ(figure.stacks.at(0).panels.size(), 2U);
  const Panel& spectrum = figure.stacks[0].panels[0];
  EXPECT_EQ(spectrum.title, "hub (torque on the hub)");
  EXPECT_EQ(spectrum.x->unit, "Hz");
  EXPECT_EQ(spectrum.y.unit, "N m");
  const Series* force = find_series(spectrum, "missing force");
  ASSERT_NE(force, nullptr);
  // Neighbouring bands share an edge; between the second and the third there is a gap.
  EXPECT_THAT(force->x, ElementsAre(1.0, 1.25, 1.25, 1.6, 4.0, 4.0, 5.0));
  EXPECT_THAT(force->y, ElementsAre(DoubleEq(0.01), DoubleEq(0.01), DoubleEq(0.008),
                                    DoubleEq(0.008), NanSensitiveDoubleEq(kNotDrawn), 0.0, 0.0));
  const Series* interval = find_series(spectrum, "± 2 standard errors");
  ASSERT_NE(interval, nullptr);
  // Of the mean square, which ends at 0.
  EXPECT_DOUBLE_EQ(interval->y[0], std::sqrt(1e-4 - 2.0 * 1.25e-5));
  EXPECT_DOUBLE_EQ(interval->y_to[0], std::sqrt(1e-4 + 2.0 * 1.25e-5));
  EXPECT_EQ(interval->y[2], 0.0);
}

TEST(MissingForceFigure, OfOneSegmentHasNoInterval) {
  MissingForce force = at_hub();
  for (ForceBand& band : force.size->spectrum) band.std_error.reset();
  force.size->std_error.reset();
  const Figure figure = missing_force_figure(force);
  EXPECT_EQ(find_series(figure.stacks[0].panels[0], "± 2 standard errors"), nullptr);
}

TEST(MissingForceFigure, HasTheSharesOfThePorts) {
  const Figure figure = missing_force_figure(at_hub());
  const Panel& shares = figure.stacks[0].panels[1];
  EXPECT_EQ(shares.x->unit, "%");
  ASSERT_EQ(shares.y.ticks.size(), 3U);
  EXPECT_EQ(shares.y.ticks[0].label, "hub");
  EXPECT_EQ(shares.y.ticks[1].label, "sensor hub angle");
  EXPECT_THAT(find_series(shares, "port stated")->x, ElementsAre(DoubleEq(90.0)));
  EXPECT_THAT(find_series(shares, "port not stated")->x,
              ElementsAre(DoubleEq(30.0), 0.0));  // -10 % explains nothing
  const Series* bars = find_series(shares, "± 2 standard errors");
  EXPECT_DOUBLE_EQ(bars->x[0], 86.0);
  EXPECT_DOUBLE_EQ(bars->x[1], 94.0);
  // The best is the uppermost.
  EXPECT_GT(find_series(shares, "port stated")->y[0], find_series(shares, "port not stated")->y[0]);
}

TEST(MissingForceFigure, OfAPortThatIsNotDeterminedHasTheSharesAlone) {
  MissingForce force = at_hub();
  force.size.reset();
  force.stated = 0;
  const Figure figure = missing_force_figure(force);
  ASSERT_EQ(figure.stacks.at(0).panels.size(), 1U);
  EXPECT_EQ(find_series(figure.stacks[0].panels[0], "port stated"), nullptr);
  EXPECT_THAT(to_svg(figure), Not(HasSubstr("third octave")));
}

TEST(MissingForceFigure, NamesItsAxesInTheDocument) {
  const std::string svg = to_svg(missing_force_figure(at_hub()));
  for (const char* text : {"RMS in third octaves [N m]", "frequency [Hz]",
                           "explained share of the excess residual [%]", "sensor hub angle",
                           "port stated", "missing force"}) {
    EXPECT_THAT(svg, HasSubstr(std::string("<text>") + text + "</text>")) << text;
  }
}

}  // namespace
}  // namespace flexarm::report
