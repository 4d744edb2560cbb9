#include "report/figures/frequency_response_figure.hpp"

#include "report/figures/gnuplot_script.hpp"
#include "report/figures/svg.hpp"
#include "tests/report/measured_sample.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <stdexcept>

namespace flexarm::report {
namespace {

using Complex = std::complex<double>;
using testing::HasSubstr;

/// 300 lines of a flat response with the values that the tests look at in between.
MeasuredResponse flat() {
  MeasuredResponse made{arm::parse_sensor("hub_angle"), {}, {}};
  made.averages = 11.0;
  for (int k = 0; k < 300; ++k) {
    made.frequency_Hz.push_back(0.1 * k);
    made.response.emplace_back(2.0, 0.0);
    made.relative_std.push_back(0.01);
    made.coherence.push_back(0.99);
  }
  return made;
}

TEST(Interval95, IsStudentsOfTheAveragesThatAreLeft) {
  auto measured = flat();
  measured.relative_std = std::vector<double>(300, 0.1);
  constexpr double kQuantile = 2.0859634;  // Student's t, 20 degrees of freedom, 97.5 %: tables
  EXPECT_NEAR(interval_95(measured).at(7), 0.1 * kQuantile, 1e-8);
  measured.averages = 0.0;
  EXPECT_TRUE(interval_95(measured).empty());
  measured = flat();
  measured.relative_std.assign(300, kNaN);
  EXPECT_TRUE(interval_95(measured).empty());
}

TEST(Interval95, HoldsTheResponseInNineteenOfTwentyEstimates) {
  constexpr int kRuns = 4000;
  constexpr int kAverages = 8;
  const Complex truth(1.5, -2.0);
  response::RandomNumbers random(5);
  const auto normal = [&] {
    const double real = random.normal();
    return Complex(real, random.normal());
  };
  int held = 0;
  for (int run = 0; run < kRuns; ++run) {
    double xx = 0.0;
    double yy = 0.0;
    Complex xy = 0.0;
    for (int k = 0; k < kAverages; ++k) {
      const Complex x = normal();
      const Complex y = truth * x + 0.5 * normal();
      xx += std::norm(x);
      yy += std::norm(y);
      xy += std::conj(x) * y;
    }
    const measured::FrequencyChannel channel{
        arm::parse_sensor("hub_angle"), {1.0}, {xy / xx}, {std::norm(xy) / (xx * yy)}};
    const auto measured = measured_response(channel, kAverages);
    const double interval = interval_95(measured).at(0);
    held += std::abs(std::abs(truth) / std::abs(measured.response[0]) - 1.0) < interval;
  }
  // Four standard deviations of a count, and what the curvature of |H| adds.
  EXPECT_NEAR(held / static_cast<double>(kRuns), 0.95, 4.0 * std::sqrt(0.05 * 0.95 / kRuns) + 2e-3);
}

TEST(FrequencyResponseFigure, HasMagnitudePhaseAndCoherenceWithUnits) {
  const Figure figure = frequency_response_figure(flat());
  const auto& panels = figure.stacks.at(0).panels;
  ASSERT_EQ(panels.size(), 3U);
  EXPECT_EQ(panels[0].y.unit, "rad/(N m)");
  EXPECT_EQ(panels[1].y.label, "phase");
  EXPECT_EQ(panels[2].y.label, "coherence");
  const Series* curve = find_series(panels[0], "measured");
  ASSERT_NE(curve, nullptr);
  EXPECT_EQ(curve->x.size(), 299U);  // no line 0

  MeasuredResponse without = flat();
  without.coherence.assign(300, kNaN);
  EXPECT_EQ(frequency_response_figure(without).stacks[0].panels.size(), 2U);
}

TEST(FrequencyResponseFigure, AnIntervalThatReachesZeroGoesToTheLowerEdge) {
  auto measured = flat();
  measured.relative_std[100] = 2.0;
  measured.relative_std[200] = kNaN;
  const Panel panel = frequency_response_figure(measured).stacks[0].panels[0];
  const Series* band = find_series(panel, "95 % interval");
  ASSERT_NE(band, nullptr);
  EXPECT_EQ(band->y[99], *panel.y.minimum);  // line 0 is left out
  EXPECT_GT(band->y_to[99], 2.0 * 3.0);
  EXPECT_TRUE(std::isnan(band->y[199]));
}

TEST(FrequencyResponseFigure, WhereNothingIsKnownNoScaleIsSetAndNoPhaseDrawn) {
  auto measured = flat();
  for (std::size_t k = 250; k < 300; ++k) {
    measured.response[k] = -1e8;
    measured.relative_std[k] = 5.0;
  }
  const auto panels = frequency_response_figure(measured).stacks[0].panels;
  EXPECT_LT(*panels[0].y.maximum, 100.0);
  const Series* phase = find_series(panels[1], "measured");
  ASSERT_NE(phase, nullptr);
  EXPECT_TRUE(std::isnan(phase->y.back()));
  EXPECT_EQ(phase->y.front(), 0.0);
}

TEST(FrequencyResponseFigure, OfASensorThatShowsNoiseAloneHasNoPhase) {
  auto measured = flat();
  measured.relative_std.assign(300, 1.0);
  const Figure figure = frequency_response_figure(measured);
  ASSERT_EQ(figure.stacks[0].panels.size(), 2U);
  EXPECT_EQ(figure.stacks[0].panels[1].y.label, "coherence");
  EXPECT_FALSE(to_svg(figure).empty());
}

TEST(FrequencyResponseFigure, OfOneFrequencyIsDrawn) {
  const auto channel = stepped_sine(measured::damped_paper_arm(), {}, 1, 1);
  EXPECT_FALSE(to_svg(frequency_response_figure(measured_response(channel, 10.0))).empty());
}

TEST(FrequencyResponseFigure, AnUnknownValueIsAGap) {
  auto measured = flat();
  measured.response[150] = Complex(kNaN, 0.0);
  const auto panels = frequency_response_figure(measured).stacks[0].panels;
  for (const std::size_t p : {0U, 1U}) {
    const Series* curve = find_series(panels[p], "measured");
    EXPECT_TRUE(std::isnan(curve->y[149]));
    EXPECT_FALSE(std::isnan(curve->y[150]));
  }
}

TEST(FrequencyResponseFigure, RefusesVectorsOfUnlikeLengthAndNothing) {
  auto measured = flat();
  measured.coherence.pop_back();
  EXPECT_THROW(frequency_response_figure(measured), std::invalid_argument);
  EXPECT_THROW(frequency_response_figure({}), std::invalid_argument);
  measured = flat();
  FrequencyResponsePlot plot;
  plot.analytical.push_back({"model", {1.0, 2.0}, {1.0}});
  EXPECT_THROW(frequency_response_figure(measured, plot), std::invalid_argument);
  measured.response.assign(300, Complex(kNaN, kNaN));
  EXPECT_THROW(frequency_response_figure(measured), std::invalid_argument);
}

TEST(FrequencyResponseFigure, OfManyLinesIsSmallAndKeepsThePeak) {
  MeasuredResponse measured{arm::parse_sensor("hub_angle"), many_frequencies_Hz(), {}};
  response::RandomNumbers random(8);
  for (const double size : many_values(7)) {
    measured.response.push_back(std::polar(size, 6.0 * random.uniform()));
    measured.relative_std.push_back(0.2 * random.uniform());
    measured.coherence.push_back(random.uniform());
  }
  measured.response[kPeakLine] = 1e6;
  measured.averages = 20.0;
  const Figure figure = frequency_response_figure(measured, {.frequency_scale = Scale::linear});
  EXPECT_THAT(gnuplot_script(figure, lay_out(figure)).text,
              HasSubstr(fmt::format("\n{} 1000000\n", measured.frequency_Hz[kPeakLine])));
  EXPECT_LT(to_svg(figure).size(), kMostBytes);
}

TEST(FrequencyResponseFigure, OfTheArmHasFitModelAndFeatures) {
  auto arm_case = sample_case();
  arm_case.sensors = measured::sensors_named({"hub_angle", "tip_acceleration"});
  arm_case.duration_s = 40.0;
  const std::array records = {measured::record_of(arm_case)};
  const auto estimate = measured::estimate_frequency_response(records[0]);
  const auto fit = measured::fit_modes(records, {.modes = 3});
  const auto features = measured::spectral_features(estimate);
  const auto stepped = stepped_sine(arm_case.arm, arm_case.sensors[1], 3);
  const Figure figure = frequency_response_figure(
      measured_response(estimate, 1),
      {.title = "Torque to tip_acceleration",
       .fit = fit.transfers[1],
       .analytical = {{"analytical", stepped.frequency_Hz, stepped.response}},
       .features = features[1].response,
       .analytical_poles_Hz = exact_poles_Hz(arm_case.arm, 3)});
  EXPECT_EQ(overlapping_labels(figure), 0);
  const Series* curve = find_series(figure.stacks[0].panels[0], "fit");
  ASSERT_NE(curve, nullptr);
  for (std::size_t i = 0; i < curve->x.size(); i += 50) {
    const Complex s(0.0, 2.0 * std::numbers::pi * curve->x[i]);
    EXPECT_DOUBLE_EQ(curve->y[i], std::abs(fit.transfers[1].value(s)));
  }
  const std::string svg = to_svg(figure);
  for (const char* text :
       {"magnitude [m/s²/(N m)]", "phase [deg]", "coherence", "frequency [Hz]", "measured",
        "95 % interval", "fit", "analytical", "analytical pole", "peak", "coherence threshold"}) {
    EXPECT_THAT(svg, HasSubstr(std::string("<text>") + text + "</text>")) << text;
  }
}

TEST(MeasuredResponse, OfARecordHasNoSpreadWithoutAverages) {
  const auto channel = stepped_sine(measured::damped_paper_arm(), {}, 1, 5);
  EXPECT_TRUE(measured_response(channel).relative_std.empty());
  EXPECT_EQ(measured_response(channel, 10.0).relative_std.size(), 5U);
  EXPECT_EQ(find_series(frequency_response_figure(measured_response(channel)).stacks[0].panels[0],
                        "95 % interval"),
            nullptr);
}

}  // namespace
}  // namespace flexarm::report
