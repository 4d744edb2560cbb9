// Torques that are recorded with noise.
#include "diagnose/search/torque_noise.hpp"

#include "diagnose/diagnosis.hpp"
#include "effects/registry/vocabulary.hpp"
#include "response/time/random_numbers.hpp"
#include "tests/diagnose/simulated_experiments.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace flexarm::diagnose {
namespace {

constexpr SimulatedRuns kShortRuns{.duration_s = 2.0};

double rms(const std::vector<double>& values) {
  double squares = 0.0;
  for (const double value : values) squares += value * value;
  return std::sqrt(squares / static_cast<double>(values.size()));
}

/// White noise of this part of its root mean square.
std::vector<double> with_noise(std::vector<double> torque_N_m, double part, std::uint64_t seed) {
  response::RandomNumbers random(seed);
  const double size_N_m = part * rms(torque_N_m);
  for (double& torque : torque_N_m) torque += size_N_m * random.normal();
  return torque_N_m;
}

/// The torques as a sensor with noise records them.
Experiment with_recorded_noise(Experiment experiment, double part) {
  std::uint64_t seed = 21;
  for (auto& run : experiment.runs) {
    auto& record = std::get<measured::TimeRecord>(run.data);
    record.torque_N_m = with_noise(record.torque_N_m, part, ++seed);
  }
  return experiment;
}

std::vector<double> sine(int samples) {
  std::vector<double> made;
  for (int k = 0; k < samples; ++k) made.push_back(0.3 * std::sin(0.02 * k));
  return made;
}

std::vector<double> square_wave(int samples) {
  std::vector<double> made;
  for (int k = 0; k < samples; ++k) made.push_back((k / 400) % 2 == 0 ? 0.2 : -0.2);
  return made;
}

TEST(TorqueNoise, IsThatOfATorqueThatIsSmoothOrJumps) {
  constexpr int kSamples = 4000;
  // Of both bounds, the median of 4000 changes and some bands of a periodogram.
  constexpr double kScatter = 0.1;
  for (const auto& torque_N_m : {sine(kSamples), square_wave(kSamples)}) {
    EXPECT_LE(torque_noise_N_m(torque_N_m), 1e-3 * rms(torque_N_m));
    const double made = torque_noise_N_m(with_noise(torque_N_m, 0.05, 3));
    EXPECT_NEAR(made / (0.05 * rms(torque_N_m)), 1.0, kScatter);
  }
}

TEST(TorqueNoise, IsNotSeenInATorqueThatFillsTheSpectrum) {
  EXPECT_EQ(torque_noise_N_m(with_noise(std::vector<double>(4000, 1e-9), 1e9, 4)), 0.0);
  EXPECT_EQ(torque_noise_N_m(std::vector<double>{0.1}), 0.0);
}

TEST(TorqueNoise, AddsToSimulationsWhatASimulationWithoutItIsWrongBy) {
  const Experiment clean = simulated_experiment({}, kShortRuns);
  EXPECT_FALSE(with_torque_noise(Problem(clean)));
  const Experiment noisy = with_recorded_noise(clean, 0.05);
  const Problem problem(noisy);
  ASSERT_TRUE(with_torque_noise(problem));
  const std::vector<double> expected = errors_of_torque(problem);
  const auto left =
      problem.residuals(problem.as_filed(), std::vector<bool>(noisy.runs.size(), true));
  ASSERT_TRUE(left);
  const auto& channels = problem.observations().channels;
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const double error = relative_error(problem.observations(), noisy, channels[c], *left);
    const double floor = std::hypot(expected[c], channels[c].noise);
    // One draw is the rms of few degrees of freedom where errors of the torque add up.
    EXPECT_GE(error, floor / 5.0) << channels[c].sensor << " of " << channels[c].run;
    EXPECT_LE(error, floor * 3.0) << channels[c].sensor << " of " << channels[c].run;
  }
}

TEST(TorqueNoise, LeavesACauseThatASimulationHides) {
  const arm::Effects hidden = {effects::named("hub_viscous_friction", {{"coefficient", 0.004}})};
  const Experiment experiment = with_recorded_noise(simulated_experiment(hidden, kShortRuns), 0.05);
  const auto tried =
      named(experiment, {"hub_viscous_friction", "coulomb_friction", "hub_spring", "hub_inertia"});
  const Diagnosis made = diagnose(experiment, tried, {}, {});
  EXPECT_EQ(made.verdict, Verdict::explained);
  EXPECT_EQ(made.predictor, PredictorKind::grey_box);
  EXPECT_NE(made.predictor_reason.find("the recorded torque has white noise"), std::string::npos);
  ASSERT_EQ(made.causes.size(), 1U);
  EXPECT_EQ(made.causes.front().effect, "hub_viscous_friction");
  const ParameterEstimate& coefficient = made.causes.front().parameters.front();
  EXPECT_NEAR(coefficient.value, 0.004, 4.0 * coefficient.std_error);
  EXPECT_LE(coefficient.std_error, 0.1 * 0.004);
  // A simulation is as wrong as before, about as much as the stated floor lets expect.
  EXPECT_LE(made.estimation.after, 2.0 * made.estimation.noise_floor);
}

TEST(TorqueNoise, OfTheArmAsFiledLeavesItAdequate) {
  const Experiment experiment = with_recorded_noise(simulated_experiment({}, kShortRuns), 0.05);
  const auto tried = named(experiment, {"hub_viscous_friction", "hub_spring", "hub_inertia"});
  EXPECT_EQ(diagnose(experiment, tried, {}, {}).verdict, Verdict::adequate);
}

/// What a controller makes of its sensors' noise is recorded as it was.
TEST(TorqueNoise, ThatMovedTheArmIsNoErrorOfTheRecord) {
  const Experiment clean = simulated_experiment({}, kShortRuns);
  const Experiment recorded = with_recorded_noise(clean, 0.05);
  const auto noisy = with_torque_noise(Problem(recorded));
  ASSERT_TRUE(noisy);
  EXPECT_TRUE(torque_noise_is_likely(*noisy, clean.arm));
  const std::vector<double> errors(noisy->observations().channels.size(), 0.0);
  const Problem as_it_was = Problem(clean).with_torque_noise(*noisy->predictor().noise(), errors);
  EXPECT_FALSE(torque_noise_is_likely(as_it_was, clean.arm));
}

/// Such noise is large enough to take up an error of the arm, by another size than the record
/// shows.
TEST(TorqueNoise, ThatMovedTheArmDoesNotHideACause) {
  const arm::Effects hidden = {effects::named("flexural_rigidity", {{"factor", 0.98}})};
  const Experiment experiment =
      simulated_experiment(hidden, {.duration_s = 2.0, .acting_noise = 0.02});
  ASSERT_TRUE(with_torque_noise(Problem(experiment)));
  const auto tried = named(experiment, {"flexural_rigidity", "hub_inertia", "hub_spring"});
  const Diagnosis made = diagnose(experiment, tried, {}, {});
  EXPECT_EQ(made.verdict, Verdict::explained);
  EXPECT_EQ(made.predictor, PredictorKind::output_error);
  ASSERT_EQ(made.causes.size(), 1U);
  EXPECT_EQ(made.causes.front().effect, "flexural_rigidity");
}

}  // namespace
}  // namespace flexarm::diagnose
