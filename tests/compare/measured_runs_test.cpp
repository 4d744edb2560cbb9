#include "compare/measured_runs.hpp"

#include "arm/input_error.hpp"
#include "effects/registry/vocabulary.hpp"
#include "response/arm_parts.hpp"
#include "response/formulation_maker.hpp"
#include "response/time/random_numbers.hpp"
#include "response/time/simulation.hpp"
#include "response/time/time_model.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace flexarm::compare {
namespace {

constexpr double kPeriod_s = 2e-3;
constexpr int kModes = 40;
/// Root mean square of what modes beyond those of the overlay leave of these signals, with room.
constexpr double kMostTruncation_percent = 0.05;

arm::Arm damped_arm() {
  arm::Arm arm = arm::paper_arm();
  arm.damping.kelvin_voigt_s = 1.2e-4;
  arm.hub.viscous_friction_N_m_s_per_rad = 2e-3;
  return arm;
}

/// Steps of random size and length.
std::vector<double> torque_steps_N_m(std::size_t samples) {
  response::RandomNumbers numbers(7);
  std::vector<double> torque;
  while (torque.size() < samples) {
    torque.insert(torque.end(), 50 + torque.size() % 37, 0.1 * numbers.normal());
  }
  torque.resize(samples);
  return torque;
}

/// A run of hub angle and tip displacement from rest, the first `skipped` samples left away.
measured::MeasuredRun recorded(const arm::Arm& arm, std::size_t samples, std::size_t skipped = 0) {
  const std::vector<arm::Sensor> sensors = {{arm::SensorKind::hub_angle},
                                            {arm::SensorKind::tip_displacement}};
  const auto parts = response::take_apart(arm);
  const auto model = response::time_model(
      response::make_formulation("exact_tf", parts.linear, kModes), parts, kModes, sensors);
  const auto torque = torque_steps_N_m(samples);
  const auto made = response::simulate(model, parts, sensors, torque,
                                       {.sample_time_s = kPeriod_s, .energy = false});
  const auto rest = [&](const std::vector<double>& values) {
    return std::vector<double>(values.begin() + static_cast<std::ptrdiff_t>(skipped), values.end());
  };
  measured::TimeRecord record{rest(made.time_s), rest(torque), {}};
  for (std::size_t j = 0; j < sensors.size(); ++j) {
    record.channels.push_back({sensors[j], rest(made.channels[j])});
  }
  measured::MeasuredRun run;
  run.run.id = "steps";
  run.data = std::move(record);
  return run;
}

measured::TimeRecord& record_in(measured::MeasuredRun& run) {
  return std::get<measured::TimeRecord>(run.data);
}

void expect_same(const MeasuredTimeRun& compared) {
  for (const auto& signal : compared.signals) {
    EXPECT_LT(signal.nrmse_percent, kMostTruncation_percent) << signal.sensor;
  }
}

TEST(MeasuredRuns, TheArmOfTheRecordFitsIt) {
  const auto compared = run_beside_simulation(damped_arm(), recorded(damped_arm(), 2000));
  EXPECT_EQ(compared.run, "steps");
  ASSERT_EQ(compared.signals.size(), 2U);
  EXPECT_EQ(compared.signals[0].sensor, "hub_angle");
  EXPECT_EQ(compared.signals[1].unit, "m");
  EXPECT_FALSE(compared.free_start);
  expect_same(compared);
}

TEST(MeasuredRuns, TheFitIsThatOfMatlabsCompare) {
  auto run = recorded(damped_arm(), 500);
  const std::vector<double> original = record_in(run).channels[0].values;
  for (double& value : record_in(run).channels[0].values) value = 2.0 * value + 0.3;
  const auto signal = run_beside_simulation(damped_arm(), run).signals[0];
  const auto& y = record_in(run).channels[0].values;
  double mean = 0.0;
  for (const double value : y) mean += value / static_cast<double>(y.size());
  double error = 0.0;
  double spread = 0.0;
  for (std::size_t k = 0; k < y.size(); ++k) {
    error += std::pow(y[k] - original[k], 2);
    spread += std::pow(y[k] - mean, 2);
  }
  const double nrmse_percent = 100.0 * std::sqrt(error / spread);
  EXPECT_NEAR(signal.nrmse_percent, nrmse_percent, kMostTruncation_percent);
  EXPECT_DOUBLE_EQ(signal.fit_percent(), 100.0 - signal.nrmse_percent);
}

TEST(MeasuredRuns, ARunHasItsOwnPayload) {
  arm::Arm loaded = damped_arm();
  loaded.payload = {0.08, 1e-5};
  auto run = recorded(loaded, 1000);
  EXPECT_GT(run_beside_simulation(damped_arm(), run).signals[0].nrmse_percent, 5.0);
  run.run.payload = loaded.payload;
  const auto compared = run_beside_simulation(damped_arm(), run);
  EXPECT_EQ(compared.payload, loaded.payload);
  expect_same(compared);
}

TEST(MeasuredRuns, EffectsOfTheArmAreSimulated) {
  arm::Arm rubbing = damped_arm();
  effects::put(rubbing, "coulomb_friction", {{"torque", 0.02}});
  const auto run = recorded(rubbing, 1500);
  expect_same(run_beside_simulation(rubbing, run));
  EXPECT_GT(run_beside_simulation(damped_arm(), run).signals[0].nrmse_percent, 5.0);
}

TEST(MeasuredRuns, SamplesThatAreLeftOutDoNotCount) {
  auto run = recorded(damped_arm(), 800);
  auto& channel = record_in(run).channels[0];
  for (const std::size_t k : {100U, 101U, 500U}) {
    channel.values[k] = 50.0;
    channel.left_out.push_back(k);
  }
  expect_same(run_beside_simulation(damped_arm(), run));
}

TEST(MeasuredRuns, AFreeStartIsEstimated) {
  // The record begins in motion; a run from rest is far off.
  auto run = recorded(damped_arm(), 1500, 400);
  EXPECT_GT(run_beside_simulation(damped_arm(), run).signals[0].nrmse_percent, 20.0);
  run.run.initial = measured::InitialState::free;
  const auto compared = run_beside_simulation(damped_arm(), run);
  EXPECT_TRUE(compared.free_start);
  // Modes that the overlay does not have move at the start.
  for (const auto& signal : compared.signals) EXPECT_LT(signal.nrmse_percent, 0.5);
}

TEST(MeasuredRuns, AFreeStartWithFrictionAndLeftOutSamplesIsEstimated) {
  arm::Arm rubbing = damped_arm();
  effects::put(rubbing, "coulomb_friction", {{"torque", 0.01}});
  auto run = recorded(rubbing, 1500, 400);
  run.run.initial = measured::InitialState::free;
  auto& channel = record_in(run).channels[0];
  for (std::size_t k = 3; k < 9; ++k) {
    channel.values[k] = -50.0;
    channel.left_out.push_back(k);
  }
  for (const auto& signal : run_beside_simulation(rubbing, run).signals) {
    EXPECT_LT(signal.nrmse_percent, 2.0) << signal.sensor;
  }
}

TEST(MeasuredRuns, AConstantSignalHasNoFit) {
  auto run = recorded(damped_arm(), 300);
  record_in(run).channels[0].values.assign(300, 0.1);  // its mean is rounded
  EXPECT_TRUE(std::isnan(run_beside_simulation(damped_arm(), run).signals[0].fit_percent()));
}

TEST(MeasuredRuns, ATorqueThatIsLoggedLateActsEarlier) {
  auto run = recorded(damped_arm(), 1200);
  auto& torque = record_in(run).torque_N_m;
  torque.insert(torque.begin(), 0.0);
  torque.pop_back();
  arm::Arm early = damped_arm();
  effects::put(early, "time_delay", {{"delay", -kPeriod_s}});
  const double off = run_beside_simulation(damped_arm(), run).signals[1].nrmse_percent;
  const double same = run_beside_simulation(early, run).signals[1].nrmse_percent;
  EXPECT_LT(same, 0.1 * off);
}

TEST(MeasuredRuns, AnErrorNamesTheRun) {
  auto run = recorded(damped_arm(), 300);
  record_in(run).channels[0].sensor = {arm::SensorKind::strain, 9.0};
  try {
    run_beside_simulation(damped_arm(), run);
    FAIL();
  } catch (const arm::InputError& error) {
    EXPECT_EQ(std::string(error.what()).substr(0, 11), "run steps: ");
  }
}

TEST(MeasuredRuns, AreNotSimulatedAfterTheDeadline) {
  EXPECT_THROW(run_beside_simulation(damped_arm(), recorded(damped_arm(), 300),
                                     std::chrono::steady_clock::now()),
               arm::Cancelled);
}

}  // namespace
}  // namespace flexarm::compare
