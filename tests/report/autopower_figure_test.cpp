#include "report/figures/autopower_figure.hpp"

#include "report/figures/gnuplot_script.hpp"
#include "report/figures/svg.hpp"
#include "tests/report/measured_sample.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace flexarm::report {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;

/// Two sensors at 0, 1, ... 5 Hz.
measured::FrequencyResponseEstimate small_estimate() {
  measured::FrequencyResponseEstimate estimate;
  estimate.frequency_Hz = {0, 1, 2, 3, 4, 5};
  estimate.input_autopower = {1e-30, 2, 2, 2, 2, 2};
  for (const char* name : {"hub_angle", "tip_acceleration"}) {
    measured::ChannelEstimate channel;
    channel.sensor = arm::parse_sensor(name);
    channel.autopower = {1e-30, 1, 10, 100, 10, 1};
    estimate.channels.push_back(channel);
  }
  return estimate;
}

std::vector<measured::SensorFeatures> small_features() {
  measured::SpectralFeature peak;
  peak.frequency_Hz = 3.1;
  peak.line_Hz = 3.0;
  peak.level_dB = 20.0;
  peak.prominence_dB = 20.0;
  measured::SensorFeatures found;
  found.sensor = arm::parse_sensor("hub_angle");
  found.autopower = {peak};
  return {found};
}

TEST(AutopowerFigure, HasAPanelForTheTorqueAndEachSensorWithUnits) {
  const Figure figure = autopower_figure(small_estimate(), {});
  const auto& panels = figure.stacks.at(0).panels;
  ASSERT_EQ(panels.size(), 3U);
  EXPECT_EQ(panels[0].title, "torque");
  EXPECT_EQ(panels[0].y.unit, "(N m)²/Hz");
  EXPECT_EQ(panels[1].y.unit, "rad²/Hz");
  EXPECT_EQ(panels[2].title, "tip acceleration");
  EXPECT_EQ(panels[2].y.unit, "(m/s²)²/Hz");
  EXPECT_EQ(panels[2].series.at(0).x, (std::vector<double>{1, 2, 3, 4, 5}));  // no line 0
}

TEST(AutopowerFigure, MarksFeaturesOnTheirLineWithTheirFrequency) {
  const Figure figure = autopower_figure(small_estimate(), small_features());
  const Panel& panel = figure.stacks[0].panels[1];
  const Series* peaks = find_series(panel, "peak");
  ASSERT_NE(peaks, nullptr);
  EXPECT_THAT(peaks->x, ElementsAre(3.0));
  EXPECT_THAT(peaks->y, ElementsAre(DoubleNear(100.0, 1e-10)));
  ASSERT_EQ(panel.annotations.size(), 1U);
  EXPECT_EQ(panel.annotations[0].text, "3.100");
  EXPECT_EQ(find_series(figure.stacks[0].panels[2], "peak"), nullptr);
}

TEST(AutopowerFigure, DrawsAnalyticalPolesWithinTheFrequencies) {
  const Figure figure =
      autopower_figure(small_estimate(), {}, {.analytical_poles_Hz = {2.5, 80.0}});
  const Panel& panel = figure.stacks[0].panels[1];
  const Series* lines = find_series(panel, "analytical pole");
  ASSERT_NE(lines, nullptr);
  EXPECT_THAT(lines->x, ElementsAre(2.5, 2.5, 2.5));
  EXPECT_EQ(lines->y[0], *panel.y.minimum);
  EXPECT_EQ(lines->y[1], *panel.y.maximum);
}

TEST(AutopowerFigure, LeavesOutASensorThatReadNothing) {
  auto estimate = small_estimate();
  estimate.channels[0].autopower = {0, 0, 0, kNaN, 0, 0};
  EXPECT_EQ(autopower_figure(estimate, {}).stacks[0].panels.size(), 2U);
}

TEST(AutopowerFigure, AnExactZeroOfTheSpectrumDoesNotSetTheScale) {
  auto estimate = small_estimate();
  estimate.frequency_Hz = many_frequencies_Hz();
  estimate.input_autopower = estimate.channels[0].autopower = estimate.channels[1].autopower =
      many_values(1);
  estimate.channels[0].autopower[500] = 1e-40;
  EXPECT_GT(*autopower_figure(estimate, {}).stacks[0].panels[1].y.minimum, 1e-9);
}

TEST(AutopowerFigure, RefusesWhatCannotBeDrawn) {
  auto estimate = small_estimate();
  estimate.channels[1].autopower.pop_back();
  EXPECT_THROW(autopower_figure(estimate, {}), std::invalid_argument);
  EXPECT_THROW(autopower_figure({}, {}), std::invalid_argument);
}

TEST(AutopowerFigure, OfManyLinesIsSmallAndKeepsThePeak) {
  measured::FrequencyResponseEstimate estimate;
  estimate.frequency_Hz = many_frequencies_Hz();
  estimate.input_autopower = many_values(1);
  for (const char* name :
       {"hub_angle", "hub_velocity", "tip_acceleration", "tip_displacement", "strain@0.05"}) {
    measured::ChannelEstimate channel;
    channel.sensor = arm::parse_sensor(name);
    channel.autopower = many_values(estimate.channels.size() + 2);
    estimate.channels.push_back(channel);
  }
  const Figure figure = autopower_figure(estimate, {});
  EXPECT_THAT(gnuplot_script(figure, lay_out(figure)).text,
              HasSubstr(fmt::format("\n{} 1000000\n", estimate.frequency_Hz[kPeakLine])));
  EXPECT_LT(to_svg(figure).size(), kMostBytes);
}

TEST(AutopowerFigure, OfTheArmHasEveryLabelToItself) {
  const auto record = measured::record_of(sample_case());
  const auto estimate = measured::estimate_frequency_response(record);
  // Many features: those of noise too.
  measured::PeakSettings eager;
  eager.false_alarm_rate = 0.9;
  eager.least_prominence_dB = 0.1;
  for (const auto& settings : {measured::PeakSettings{}, eager}) {
    const auto features = measured::spectral_features(estimate, settings);
    for (const Scale scale : {Scale::linear, Scale::logarithmic}) {
      const Figure figure =
          autopower_figure(estimate, features,
                           {.title = "arm",
                            .frequency_scale = scale,
                            .analytical_poles_Hz = exact_poles_Hz(sample_case().arm, 3)});
      EXPECT_EQ(overlapping_labels(figure), 0);
      const std::string svg = to_svg(figure);
      for (const char* text : {"frequency [Hz]", "density [(rad/s)²/Hz]", "strain at 0.05 m",
                               "analytical pole", "peak", "minimum"}) {
        EXPECT_THAT(svg, HasSubstr(std::string("<text>") + text + "</text>"));
      }
    }
  }
}

}  // namespace
}  // namespace flexarm::report
