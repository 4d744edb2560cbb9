#include "report/figures/distortion_figure.hpp"

#include "report/figures/svg.hpp"
#include "tests/report/measured_sample.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace flexarm::report {
namespace {

using measured::LineKind;
using testing::ElementsAre;
using testing::HasSubstr;

measured::ChannelDistortion channel() {
  measured::ChannelDistortion made;
  made.lines = {{0.1, LineKind::driven, 1.0, 1e-4, 1.0},
                {0.2, LineKind::even, 1e-4, 1e-4, 0.5},
                {0.3, LineKind::odd, 1e-2, 1e-4, 1e-9},
                {0.4, LineKind::even, 1e-4, 1e-4, 0.5},
                {0.5, LineKind::driven, 1.0, 1e-4, 1.0}};
  made.odd = {1, 1e-9, true, -40.04, -80.0};
  made.even = {2, 0.5, false, -std::numeric_limits<double>::infinity(), -80.0};
  return made;
}

TEST(DistortionFigure, HasTheLinesByKind) {
  const Figure figure = distortion_figure(arm::parse_sensor("hub_velocity"), channel());
  const Panel& panel = figure.stacks.at(0).panels.at(0);
  EXPECT_EQ(panel.y.unit, "rad/s");
  EXPECT_THAT(find_series(panel, "excited lines")->x, ElementsAre(0.1, 0.5));
  EXPECT_THAT(find_series(panel, "odd detection lines")->y, ElementsAre(1e-2));
  EXPECT_THAT(find_series(panel, "even detection lines")->x, ElementsAre(0.2, 0.4));
  EXPECT_EQ(find_series(panel, "noise")->x.size(), 5U);
  const Figure strain = distortion_figure(arm::parse_sensor("strain@0.05"), channel());
  EXPECT_EQ(strain.stacks[0].panels[0].y.unit, "");
}

TEST(DistortionFigure, LegendSaysWhatTheTestsCameTo) {
  auto tested = channel();
  std::string svg = to_svg(distortion_figure(arm::parse_sensor("hub_velocity"), tested, "D"));
  for (const char* text :
       {"significant: −40.0 dB", "not significant", "amplitude [rad/s]", "excited lines"}) {
    EXPECT_THAT(svg, HasSubstr(std::string("<text>") + text + "</text>")) << text;
  }
  tested.even.lines = 0;
  svg = to_svg(distortion_figure(arm::parse_sensor("hub_velocity"), tested));
  EXPECT_THAT(svg, HasSubstr("<text>not tested</text>"));
}

TEST(DistortionFigure, OfManyLinesIsSmall) {
  measured::ChannelDistortion many;
  const auto amplitude = many_values(3);
  const auto noise = many_values(4);
  for (std::size_t k = 0; k < kManyLines; ++k) {
    const auto kind = k % 2 == 0 ? LineKind::even : k % 6 == 1 ? LineKind::odd : LineKind::driven;
    many.lines.push_back(
        {0.005 * static_cast<double>(k + 1), kind, amplitude[k], 0.1 * noise[k], 1.0});
  }
  EXPECT_LT(to_svg(distortion_figure(arm::parse_sensor("hub_angle"), many)).size(), kMostBytes);
}

TEST(DistortionFigure, RefusesAChannelWithoutALine) {
  EXPECT_THROW(distortion_figure({}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace flexarm::report
