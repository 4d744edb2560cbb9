#include "diagnose/formulation_check.hpp"
#include "diagnose/symptoms/band_errors.hpp"
#include "diagnose/symptoms/error_trends.hpp"
#include "diagnose/symptoms/frequency_bands.hpp"
#include "diagnose/symptoms/symptoms.hpp"
#include "effects/registry/vocabulary.hpp"
#include "tests/diagnose/symptoms_fixture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace flexarm::diagnose {
namespace {

using testing::HasSubstr;

TEST(FrequencyBands, FollowEachOtherFromZeroToTheTopAroundTheModes) {
  const auto bands = frequency_bands(arm::paper_arm(), 250.0);
  ASSERT_EQ(bands.size(), 6U);
  EXPECT_EQ(bands.front().from_Hz, 0.0);
  EXPECT_EQ(bands.back().to_Hz, 250.0);
  for (std::size_t b = 1; b < bands.size(); ++b) EXPECT_EQ(bands[b].from_Hz, bands[b - 1].to_Hz);
  // Table 1 of the paper, the right theory: 11.862 and 32.261 Hz.
  EXPECT_LT(bands[1].from_Hz, 11.862);
  EXPECT_GT(bands[1].to_Hz, 11.862);
  EXPECT_EQ(bands[2].name, "around mode 2");
  EXPECT_LT(bands[2].from_Hz, 32.261);
  EXPECT_GT(bands[2].to_Hz, 32.261);
}

TEST(FrequencyBands, WithoutAModeBelowTheTopAreOne) {
  EXPECT_EQ(frequency_bands(arm::paper_arm(), 5.0).size(), 1U);
}

TEST(BandPowers, OfASineAreInItsBandAndHalfItsSquare) {
  constexpr double kPeriod_s = 1e-3;
  std::vector<double> samples(1000);
  for (std::size_t k = 0; k < samples.size(); ++k) {
    samples[k] = 3.0 * std::sin(2.0 * std::numbers::pi * 50.0 * kPeriod_s * static_cast<double>(k));
  }
  const std::vector<FrequencyBand> bands = {
      {"low", 0.0, 40.0}, {"sine", 40.0, 60.0}, {"high", 60.0, 500.0}};
  const auto powers = band_powers(samples, kPeriod_s, bands);
  constexpr double kRounding = 1e-12;
  EXPECT_NEAR(powers[1].mean_square, 4.5, kRounding);
  EXPECT_NEAR(powers[0].mean_square + powers[2].mean_square, 0.0, kRounding);
  EXPECT_EQ(powers[0].lines + powers[1].lines + powers[2].lines, 500.0);
}

TEST(NoiseProbability, IsThatOfChance) {
  std::mt19937_64 numbers(3);
  std::normal_distribution<double> normal;
  constexpr int kTrials = 2000;
  constexpr int kFreedom = 20;
  int below = 0;
  for (int i = 0; i < kTrials; ++i) {
    double squares = 0.0;
    for (int k = 0; k < kFreedom; ++k) squares += std::pow(normal(numbers), 2);
    below += noise_probability(squares / kFreedom, kFreedom) < 0.05 ? 1 : 0;
  }
  // Less often than the level, as the noise's own error is allowed for; 5 standard deviations.
  EXPECT_LT(below, 0.05 * kTrials + 5.0 * std::sqrt(0.05 * kTrials));
  EXPECT_GT(below, 0.02 * kTrials);
}

TEST(ErrorSymptoms, SayWhichSensorsMissTheSignal) {
  const Symptomatic data(simulated_experiment({effects::named("hub_inertia", {{"factor", 1.5}})},
                                              {.duration_s = 2.0}));
  const auto errors = band_errors(data.input());
  const auto told = significant(error_symptoms(data.input(), errors));
  ASSERT_EQ(told.size(), 4U);
  EXPECT_EQ(told.front().sensor, "hub_angle");
  EXPECT_THAT(told.front().text, HasSubstr("NRMSE"));
}

TEST(ErrorSymptoms, AddUpToTheErrorOfTheChannel) {
  // What the window weighs otherwise than the signal: the error of a random run is much the same
  // all along.
  constexpr double kWindow = 0.3;
  const Symptomatic data(simulated_experiment({effects::named("hub_inertia", {{"factor", 1.5}})}));
  const auto& observations = data.problem().observations();
  const auto errors = band_errors(data.input());
  for (const ObservedChannel& channel : observations.channels) {
    double squares = 0.0;
    for (const BandError& error : errors) {
      if (error.run == channel.run && error.sensor == channel.sensor) {
        squares += error.before * error.before;
      }
    }
    const double whole =
        channel.noise *
        std::sqrt(data.input().before.segment(channel.first, channel.count).squaredNorm() /
                  static_cast<double>(channel.count));
    EXPECT_NEAR(std::sqrt(squares), whole, kWindow * whole) << channel.sensor;
  }
}

TEST(ErrorTrends, FallWithTheTorqueWhereFrictionIsMissing) {
  const Symptomatic data(
      simulated_experiment({effects::named("coulomb_friction", {{"torque", 0.01}})}));
  const auto told = significant(trend_symptoms(data.input()));
  ASSERT_FALSE(told.empty());
  EXPECT_THAT(told.front().text, HasSubstr("does not scale with amplitude"));
}

TEST(ErrorTrends, AreNoneWithTheTorqueWhereALinearCauseIsMissing) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const Symptomatic data(
        simulated_experiment({effects::named("hub_inertia", {{"factor", 1.5}})}, {.seed = seed}));
    for (const Symptom& one : significant(trend_symptoms(data.input()))) {
      EXPECT_THAT(one.text, HasSubstr("with payload")) << seed;
    }
  }
}

TEST(SymptomsOfNothing, AreNotSignificant) {
  for (const std::uint64_t seed : {11U, 12U, 13U, 14U}) {
    const Symptomatic data(simulated_experiment({}, {.seed = seed}));
    for (const Symptom& one : symptoms_of(data.input(), std::nullopt).statements) {
      EXPECT_FALSE(one.is_significant) << seed << ": " << one.text;
    }
  }
}

TEST(SymptomsOfNothing, EndAtTheDeadlineWithWhatThereIs) {
  const Symptomatic data(simulated_experiment({}));
  const Deadline past = std::chrono::steady_clock::now();
  const Symptoms made = symptoms_of(data.input(), std::nullopt, past);
  EXPECT_FALSE(made.is_complete);
  EXPECT_TRUE(made.bands.empty());
  EXPECT_TRUE(symptoms_of(data.input(), std::nullopt).is_complete);
}

TEST(FormulationCheck, IsRefusedAfterTheDeadline) {
  const std::vector<arm::Sensor> sensors = {{arm::SensorKind::hub_angle, 0.0}};
  const FormulationCheck made =
      check_formulations(arm::paper_arm(), sensors, std::chrono::steady_clock::now());
  EXPECT_EQ(made.refused, "the time limit left no time for it");
  EXPECT_EQ(check_formulations(arm::paper_arm(), sensors).refused, "");
}

}  // namespace
}  // namespace flexarm::diagnose
