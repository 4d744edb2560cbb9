#include "tests/trials/frequency_simulation.hpp"

#include "exact_tf/exact_arm.hpp"
#include "response/frequency/frequency_response.hpp"
#include "tests/trials/experiment_plan.hpp"
#include "tests/trials/with_effects.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace flexarm::trials {
namespace {

constexpr int kFewLines = 12;
/// Of a frequency on 40 elements of degree 3: (beta h)^4/1440, 9e-6 for the fourth pole.
constexpr double kMeshError = 1e-5;
/// Of a response, which near a pole changes by up to 1/(2 zeta), some 10, times as much.
constexpr double kResponseError = 1e-4;

World lagging_world() {
  World world{trial_arms().front().arm};
  world.arm.payload.mass_kg = 0.05;
  world.hidden = {{"hub_radius", {{"radius", 0.04}}},
                  {"torque_gain", {{"factor", 0.7}}},
                  {"time_delay", {{"delay", 0.002}}},
                  {"actuator_lag", {{"time_constant", 0.003}}},
                  {"sensor_lag", {{"time_constant", 0.001}}, "tip_acceleration"}};
  return world;
}

TEST(FrequencySimulation, AgreesWithTheExactTransferFunctions) {
  const World world = lagging_world();
  const auto frequencies = planned_frequencies_Hz(trial_arms().front(), kFewLines);
  const auto& sensors = planned_sensors();
  const auto own = frequency_responses(world, sensors, frequencies);
  const response::ArmParts parts = response::take_apart(with_effects(world));
  const auto exact = response::frequency_response(
      exact_tf::ExactArm(parts.linear), response::linear_chain(parts), sensors, frequencies);
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    for (std::size_t k = 0; k < frequencies.size(); ++k) {
      EXPECT_LT(std::abs(own[i][k] - exact.values[i][k]),
                kResponseError * std::abs(exact.values[i][k]))
          << arm::to_string(sensors[i]) << " at " << frequencies[k] << " Hz";
    }
  }
}

TEST(FrequencySimulation, ATunedMassOfNoMassChangesNothing) {
  World world{trial_arms().front().arm};
  const auto frequencies = planned_frequencies_Hz(trial_arms().front(), kFewLines);
  const auto without = frequency_responses(world, planned_sensors(), frequencies);
  world.hidden = {
      {"tuned_mass",
       {{"mass", 1e-9}, {"frequency", 20.0}, {"damping_ratio", 0.02}, {"position", 0.96}}}};
  const auto with = frequency_responses(world, planned_sensors(), frequencies);
  // Of 1e-9 kg at its own resonance, 25 times as large, beside the beam's 0.16 kg.
  constexpr double kTiny = 1e-6;
  for (std::size_t i = 0; i < with.size(); ++i) {
    for (std::size_t k = 0; k < frequencies.size(); ++k) {
      EXPECT_LT(std::abs(with[i][k] - without[i][k]), kTiny * std::abs(without[i][k]));
    }
  }
}

TEST(FrequencySimulation, ATunedMassHoldsItsPlaceStillAtItsFrequency) {
  World world{trial_arms().front().arm};
  const double tip_m = world.arm.beam.length_m;
  const std::vector<arm::Sensor> tip = {{arm::SensorKind::tip_displacement, 0.0}};
  const std::vector<double> frequency = {20.0};
  const auto without = frequency_responses(world, tip, frequency);
  world.hidden = {
      {"tuned_mass",
       {{"mass", 0.2}, {"frequency", 20.0}, {"damping_ratio", 1e-6}, {"position", tip_m}}}};
  const auto with = frequency_responses(world, tip, frequency);
  EXPECT_LT(std::abs(with[0][0]), 1e-3 * std::abs(without[0][0]));
}

TEST(FrequencySimulation, PolesAndZerosAreTheExactOnes) {
  const World world = lagging_world();
  const exact_tf::ExactArm exact(response::take_apart(with_effects(world)).linear);
  const auto poles = exact.damped_poles(kModalOrders).flexible;
  const auto zeros = exact.zeros({arm::SensorKind::hub_angle, 0.0}, kModalOrders).s_rad_per_s;
  const auto table = poles_and_zeros(world, kModalOrders);
  ASSERT_EQ(table.size(), 2 * static_cast<std::size_t>(kModalOrders));
  for (std::size_t i = 0; i < poles.size(); ++i) {
    const std::complex<double> pole = poles[i].first_rad_per_s;
    EXPECT_NEAR(2.0 * std::numbers::pi * *table[i].frequency_Hz, std::abs(pole),
                kMeshError * std::abs(pole));
    EXPECT_NEAR(*table[i].damping_ratio, -pole.real() / std::abs(pole), kMeshError);
    const double zero = std::abs(zeros[i]);
    EXPECT_NEAR(2.0 * std::numbers::pi * *table[poles.size() + i].frequency_Hz, zero,
                kMeshError * zero);
  }
}

}  // namespace
}  // namespace flexarm::trials
