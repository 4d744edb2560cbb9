// Runs that are too long for a search, with a bound of some hundred samples in place of 25,000.
#include "diagnose/long_runs.hpp"

#include "diagnose/diagnosis.hpp"
#include "effects/registry/vocabulary.hpp"
#include "tests/diagnose/simulated_experiments.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>
#include <vector>

namespace flexarm::diagnose {
namespace {

using measured::InitialState;
using measured::Purpose;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr std::size_t kStretch = 100;
const LongRunOptions kShort{.longest_run = 600, .stretch = kStretch};

/// At 1 kHz, a torque of one amplitude per stretch, and a sensor that follows it.
measured::MeasuredRun run_with(const std::vector<double>& amplitudes, const std::string& id = "a") {
  measured::TimeRecord record;
  record.channels = {{arm::parse_sensor("hub_angle"), {}}};
  for (const double amplitude : amplitudes) {
    for (std::size_t k = 0; k < kStretch; ++k) {
      const double angle = 0.3 * static_cast<double>(k + 1);
      record.time_s.push_back(1e-3 * static_cast<double>(record.time_s.size()));
      record.torque_N_m.push_back(amplitude * std::sin(angle));
      record.channels[0].values.push_back((1.0 + amplitude) * std::cos(angle));
    }
  }
  measured::MeasuredRun made;
  made.run.id = id;
  made.data = record;
  return made;
}

std::vector<std::string> ids_for(const std::vector<measured::MeasuredRun>& runs, Purpose purpose) {
  std::vector<std::string> ids;
  for (const auto& run : runs) {
    if (run.run.purpose == purpose) ids.push_back(run.run.id);
  }
  return ids;
}

TEST(LongRuns, HaveStretchesThatDifferForEstimationAndLaterOnesForValidation) {
  // Of the first six, but the gap, the strongest and those farthest from what is taken.
  std::vector runs = {run_with({1.0, 1.01, 1.02, 8.0, 3.0, 1.04, 5.0, 5.01, 2.0})};
  const auto said = cut_long_runs(runs, kShort);
  EXPECT_THAT(ids_for(runs, Purpose::estimation),
              ElementsAre("a@0s", "a@0.2s", "a@0.3s", "a@0.4s"));
  EXPECT_THAT(ids_for(runs, Purpose::validation), ElementsAre("a@0.7s", "a@0.8s"));
  ASSERT_EQ(said.size(), 1U);
  EXPECT_THAT(said[0], HasSubstr("4 for estimation (0 to 0.099 s, 0.2 to 0.299 s"));
  EXPECT_THAT(said[0], HasSubstr("2 for validation (0.7 to 0.799 s, 0.8 to 0.899 s)"));
  EXPECT_THAT(said[0], HasSubstr("300 samples are not used"));
  for (const auto& run : runs) {
    const auto& record = std::get<measured::TimeRecord>(run.data);
    EXPECT_EQ(record.time_s.size(), kStretch);
    const bool is_first = record.time_s.front() == 0.0;
    EXPECT_EQ(run.run.initial, is_first ? InitialState::rest : InitialState::free) << run.run.id;
  }
}

TEST(LongRuns, AreUsedWholeUpToTheBound) {
  std::vector runs = {run_with({1.0, 2.0, 3.0, 4.0, 5.0, 6.0})};
  EXPECT_TRUE(cut_long_runs(runs, kShort).empty());
  ASSERT_EQ(runs.size(), 1U);
  EXPECT_FALSE(runs[0].run.purpose);
}

TEST(LongRuns, BeginAtRestWhereTheTorqueDoes) {
  std::vector runs = {run_with({0.0, 0.0, 1.0, 1.1, 1.2, 1.3, 1.4, 1.5, 1.6})};
  cut_long_runs(runs, kShort);
  EXPECT_EQ(runs[0].run.id, "a@0.199s");  // the last sample at rest
  EXPECT_EQ(runs[0].run.initial, InitialState::rest);
}

TEST(LongRuns, LeavePausesOut) {
  std::vector runs = {run_with({1.0, 0.0, 0.01, 2.0, 0.0, 0.02, 3.0, 0.0})};
  const auto said = cut_long_runs(runs, kShort);
  EXPECT_THAT(ids_for(runs, Purpose::estimation), ElementsAre("a@0s", "a@0.3s"));
  EXPECT_THAT(ids_for(runs, Purpose::validation), ElementsAre("a@0.6s"));
}

TEST(LongRuns, KeepTheirPurposeAndShareTheStretches) {
  const std::vector<double> amplitudes = {1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0};
  std::vector runs = {run_with(amplitudes, "a"), run_with({1.0}, "short"),
                      run_with(amplitudes, "b"), run_with(amplitudes, "c")};
  for (auto& run : runs) run.run.purpose = Purpose::estimation;
  runs[3].run.purpose = Purpose::validation;
  EXPECT_EQ(cut_long_runs(runs, kShort).size(), 3U);
  EXPECT_THAT(ids_for(runs, Purpose::estimation),
              ElementsAre("a@0s", "a@0.6s", "short", "b@0s", "b@0.6s"));
  EXPECT_THAT(ids_for(runs, Purpose::validation), ElementsAre("c@0s", "c@0.6s"));
}

TEST(LongRuns, InAnUnknownStateHaveNoStretchAtRest) {
  std::vector runs = {run_with({1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0})};
  runs[0].run.initial = InitialState::free;
  EXPECT_THAT(cut_long_runs(runs, kShort)[0], HasSubstr("initial state of a stretch is estimated"));
  EXPECT_TRUE(std::ranges::all_of(
      runs, [](const auto& run) { return run.run.initial == InitialState::free; }));
}

TEST(LongRuns, UnderAControllerWithAnIntegralAreUsedFromTheBeginning) {
  std::vector runs = {run_with({1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0})};
  runs[0].run.controller = arm::Controller{.sensors = {arm::parse_sensor("hub_angle")},
                                           .law = arm::PidController{.kp = 1.0, .ki = 1.0}};
  EXPECT_THAT(cut_long_runs(runs, kShort)[0], HasSubstr("internal state"));
  ASSERT_EQ(runs.size(), 1U);
  EXPECT_EQ(std::get<measured::TimeRecord>(runs[0].data).time_s.size(), kShort.longest_run);
}

TEST(LongRuns, BeginWhereTheirControllerReads) {
  std::vector runs = {run_with({1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0})};
  runs[0].run.controller = arm::Controller{.sensors = {arm::parse_sensor("hub_angle")},
                                           .law = arm::PidController{.kp = 1.0},
                                           .sample_time_s = 7e-3};
  cut_long_runs(runs, kShort);
  for (const auto& run : runs) {
    const double first_s = std::get<measured::TimeRecord>(run.data).time_s.front();
    EXPECT_NEAR(std::remainder(first_s, 7e-3), 0.0, 1e-9) << run.run.id;
  }
}

TEST(LongRuns, ShowTheirFriction) {
  constexpr double kFriction_N_m = 0.01;
  Experiment experiment = simulated_experiment(
      {effects::named("coulomb_friction", {{"torque", kFriction_N_m}})}, {.duration_s = 30.0});
  experiment.runs.resize(1);
  experiment.runs[0].run.purpose.reset();
  const auto said = cut_long_runs(experiment.runs, {.longest_run = 10'000, .stretch = 1500});
  ASSERT_EQ(said.size(), 1U);
  ASSERT_EQ(experiment.runs.size(), 6U);
  const auto made = diagnose(
      experiment, named(experiment, {"coulomb_friction", "torque_gain", "hub_viscous_friction"}));
  EXPECT_EQ(made.verdict, Verdict::explained);
  ASSERT_EQ(made.causes.size(), 1U);
  EXPECT_EQ(made.causes[0].effect, "coulomb_friction");
  EXPECT_NEAR(made.causes[0].parameters[0].value, kFriction_N_m, 0.02 * kFriction_N_m);
  ASSERT_TRUE(made.validation);
  EXPECT_LT(made.validation->after, 1.5 * made.validation->noise_floor);
}

}  // namespace
}  // namespace flexarm::diagnose
