// gauge_position against a gauge that is where it has been moved to.
#include "arm/input_error.hpp"
#include "diagnose/search/fit.hpp"
#include "effects/registry/vocabulary.hpp"
#include "laws/effect_arms.hpp"
#include "measured/files/arm_file.hpp"
#include "response/formulation_maker.hpp"
#include "tests/diagnose/start_on_grid.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace flexarm::effects {
namespace {

constexpr int kGaugeModes = 4;

arm::Arm moved(arm::Arm arm, double shift_m, const std::string& gauge) {
  put(arm, "gauge_position", {{"shift", shift_m}}, gauge);
  return arm;
}

TEST(GaugePosition, IsTheGaugeAtItsOtherPlaceInEveryFormulation) {
  const auto named = arm::parse_sensor("strain@0.0625");
  const auto there = arm::parse_sensor("strain@0.3125");  // 0.0625 + 0.25, exactly
  for (const auto name : response::kFormulationNames) {
    const auto plain = response::make_formulation(name, laws::damped_arm(), kGaugeModes);
    const auto shifted = response::make_formulation(
        name, moved(laws::damped_arm(), 0.25, "strain@0.0625"), kGaugeModes);
    const std::complex<double> s(-1.0, 55.0);
    EXPECT_EQ(response::transfer_function(shifted, named, s),
              response::transfer_function(plain, there, s))
        << name;
    EXPECT_EQ(response::zeros(shifted, named, 3).s_rad_per_s,
              response::zeros(plain, there, 3).s_rad_per_s)
        << name;
    EXPECT_EQ(response::poles(shifted, 3).omega_rad_per_s,
              response::poles(plain, 3).omega_rad_per_s)
        << name;
    const auto modes = response::modes(shifted, 2, std::array{named}, {});
    const auto expected = response::modes(plain, 2, std::array{there}, {});
    for (std::size_t i = 0; i < modes.size(); ++i) {
      EXPECT_EQ(modes[i].sensor_values, expected[i].sensor_values) << name;
    }
    // No other gauge moves.
    EXPECT_EQ(response::transfer_function(shifted, there, s),
              response::transfer_function(plain, there, s))
        << name;
  }
}

/// A free beam that turns slowly bends under its own inertia, M(x) = m alpha (l^3/3 - l^2 x/2 +
/// x^3/6): the ratio of two gauges is that of these moments.
TEST(GaugePosition, HasTheMomentOfSlowMotionAtItsPlace) {
  const arm::Arm arm = arm::paper_arm();
  const double l = arm.beam.length_m;
  const auto moment = [l](double x) { return l * l * l / 3.0 - l * l * x / 2.0 + x * x * x / 6.0; };
  const auto gauge = arm::parse_sensor("strain@0.1");
  const std::complex<double> slow(0.0, 0.05);  // 1e-3 of the first pole: an error of 1e-6
  for (const double shift_m : {-0.1, 0.04, 0.5}) {
    const auto ratio =
        response::transfer_function(
            response::make_formulation("exact_tf", moved(arm, shift_m, "strain@0.1"), 1), gauge,
            slow) /
        response::transfer_function(response::make_formulation("exact_tf", arm, 1), gauge, slow);
    EXPECT_NEAR(ratio.real() / (moment(0.1 + shift_m) / moment(0.1)), 1.0, 1e-5) << shift_m;
  }
}

TEST(GaugePosition, IsCountedFromTheTipForAGaugeThatTheTipCarriesAlong) {
  arm::Arm arm = moved(laws::damped_arm(), -0.01, "strain@0.96");
  put(arm, "beam_length", {{"factor", 1.1}});
  EXPECT_NEAR(arm::placed(arm::parse_sensor("strain@0.96"), arm).position_m, 1.1 * 0.96 - 0.01,
              1e-15);
  EXPECT_EQ(arm::placed(arm::parse_sensor("strain@0.5"), arm).position_m, 0.5);
}

TEST(GaugePosition, AtTheTipReadsNothingWithoutPayloadInertia) {
  EXPECT_TRUE(arm::is_responsive(arm::parse_sensor("strain@0.9"), arm::paper_arm()));
  const arm::Arm arm = moved(arm::paper_arm(), 0.0625, "strain@0.8975");
  EXPECT_FALSE(arm::is_responsive(arm::parse_sensor("strain@0.8975"), arm));
}

std::string refusal(const std::string& table) {
  const std::string beam =
      "[beam]\nlength = 0.96\nflexural_rigidity = 3.69\nlinear_density = 0.165\nthickness = "
      "0.0032\n[hub]\ninertia = 5.86e-4\n[effects.gauge_position]\n";
  try {
    measured::parse_arm(beam + table, "rig.toml", vocabulary());
  } catch (const arm::InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(GaugePosition, IsRefusedBeyondTheBeamAndForOtherSensors) {
  using testing::HasSubstr;
  EXPECT_EQ(refusal("shift = 0.01\n"), "no error");
  EXPECT_THAT(refusal("shift = -0.01\n"),
              HasSubstr("effects.gauge_position.sensor: sensor strain@0: is at -0.01 m; position "
                        "must be from 0 to the beam's length, 0.96 m"));
  EXPECT_THAT(refusal("shift = 0.5\nsensor = \"strain@0.5\"\n"), HasSubstr("is at 1 m; position"));
  EXPECT_THAT(refusal("shift = 0.01\nsensor = \"hub_angle\"\n"),
              HasSubstr("effects.gauge_position.sensor: hub_angle is no strain gauge; must be "
                        "strain@X"));
}

TEST(GaugePosition, IsFoundFromTheZerosOfAModalTable) {
  const arm::Arm truth = moved(laws::damped_arm(), 0.013, "strain@0.05");
  const auto model = response::make_formulation("fem", truth, kGaugeModes);
  measured::ModalTable table;
  const auto add = [&](std::optional<arm::Sensor> sensor, int order, double omega_rad_per_s) {
    measured::ModalEntry entry;
    entry.sensor = sensor;
    entry.feature = sensor ? measured::Feature::zero : measured::Feature::pole;
    entry.order = order;
    entry.frequency_Hz = omega_rad_per_s / (2.0 * std::numbers::pi);
    entry.frequency_std_Hz = 1e-4 * *entry.frequency_Hz;
    table.push_back(entry);
  };
  const auto poles = response::poles(model, 3).omega_rad_per_s;
  for (std::size_t i = 0; i < poles.size(); ++i) add({}, static_cast<int>(i) + 1, poles[i]);
  const auto gauge = arm::parse_sensor("strain@0.05");
  const auto zeros = response::zeros(model, gauge, 3).s_rad_per_s;
  for (std::size_t i = 0; i < zeros.size(); ++i) {
    add(gauge, static_cast<int>(i) + 1, std::abs(zeros[i]));
  }
  measured::Run run;
  run.id = "table";
  run.kind = measured::RunKind::modal;
  run.purpose = measured::Purpose::estimation;
  diagnose::Experiment experiment;
  experiment.arm = laws::damped_arm();
  experiment.runs.push_back({run, table});
  const auto all = diagnose::hypotheses(experiment);
  const auto hypothesis = std::ranges::find(all, "gauge_position", &diagnose::Hypothesis::effect);
  ASSERT_NE(hypothesis, all.end());
  const diagnose::Problem problem(experiment);
  const auto start = diagnose::Candidate{}.with(*hypothesis, {0.0});
  const auto found = diagnose::fit(problem, diagnose::start_on_grid(problem, start, 40));
  EXPECT_NEAR(found.candidate.values[0], 0.013, 1e-5);
}

}  // namespace
}  // namespace flexarm::effects
