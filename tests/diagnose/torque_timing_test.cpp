#include "diagnose/search/torque_timing.hpp"

#include "diagnose/diagnosis.hpp"
#include "effects/registry/vocabulary.hpp"
#include "tests/diagnose/simulated_experiments.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <variant>
#include <vector>

namespace flexarm::diagnose {
namespace {

constexpr double kLate = 0.06;  // of a sampling period

/// The experiment with torques in its files that acted late from the part `from` of each run on.
Experiment with_late_torque(Experiment experiment, double from) {
  for (auto& run : experiment.runs) {
    auto& torque_N_m = std::get<measured::TimeRecord>(run.data).torque_N_m;
    const auto first = static_cast<std::size_t>(from * static_cast<double>(torque_N_m.size()));
    double before = first > 0 ? torque_N_m[first - 1] : 0.0;
    for (std::size_t k = first; k < torque_N_m.size(); ++k) {
      torque_N_m[k] = (torque_N_m[k] - kLate * before) / (1.0 - kLate);
      before = torque_N_m[k];
    }
  }
  return experiment;
}

TEST(TorqueTiming, IsFoundStretchByStretch) {
  const Experiment experiment = with_late_torque(simulated_experiment({}), 0.8);
  const Problem problem(experiment);
  const TorqueTiming timing = torque_timing(problem, fit(problem, problem.as_filed()));
  EXPECT_GT(timing.share, 0.9);
  // Each stretch of 50 samples by itself is known to a hundredth of a period or so.
  const auto& late = timing.late[1];
  EXPECT_NEAR(late.head(30).mean(), 0.0, 0.01);
  EXPECT_NEAR(late.tail(7).mean(), kLate, 0.01);
}

TEST(TorqueTiming, ThatChangesAlongTheRunsIsNoCause) {
  const Experiment experiment = with_late_torque(simulated_experiment({}), 0.8);
  const Diagnosis made = diagnose(experiment, named(experiment, {"time_delay", "payload_mass"}));
  EXPECT_EQ(made.verdict, Verdict::adequate);
  ASSERT_FALSE(made.notices.empty());
  EXPECT_THAT(made.notices.back(), testing::HasSubstr("of a sampling period"));
}

TEST(TorqueTiming, OfADelayIsLeftToTheDelay) {
  // A torque whose samples are averaged is nearly one that is late.
  const Experiment experiment = with_late_torque(simulated_experiment({}), 0.0);
  const Diagnosis made = diagnose(experiment, named(experiment, {"time_delay", "payload_mass"}));
  ASSERT_EQ(made.causes.size(), 1U);
  EXPECT_EQ(made.causes[0].effect, "time_delay");
  EXPECT_NEAR(made.causes[0].parameters[0].value, kLate * 2e-3, 0.05 * kLate * 2e-3);
}

TEST(TorqueTiming, LeavesACauseBesideItToBeFoundUnbiased) {
  constexpr double kTruth_kg = 0.01;
  const Experiment experiment = with_late_torque(
      simulated_experiment({effects::named("payload_mass", {{"mass", kTruth_kg}})}), 0.8);
  const Diagnosis made = diagnose(experiment, named(experiment, {"time_delay", "payload_mass"}));
  EXPECT_EQ(made.verdict, Verdict::explained);
  ASSERT_EQ(made.causes.size(), 1U);
  const ParameterEstimate& mass = made.causes[0].parameters[0];
  EXPECT_NEAR(mass.value, kTruth_kg, 5.0 * mass.std_error);
  EXPECT_LE(made.estimation.after, 1.05 * made.estimation.noise_floor);
}

}  // namespace
}  // namespace flexarm::diagnose
