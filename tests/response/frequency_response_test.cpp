#include "response/frequency/frequency_response.hpp"

#include "arm/input_error.hpp"
#include "effects/registry/vocabulary.hpp"
#include "tests/response/models.hpp"

#include <gtest/gtest.h>

#include <array>

namespace flexarm::response {
namespace {

using Complex = std::complex<double>;

constexpr double kResponseRounding = 1e-14;  // some forty epsilon: a handful of complex operations

arm::Arm arm_with_a_chain() {
  arm::Arm arm = damped_arm();
  effects::put(arm, "torque_gain", {{"factor", 1.25}});
  effects::put(arm, "actuator_lag", {{"time_constant", 2e-3}});
  effects::put(arm, "time_delay", {{"delay", 3e-3}});
  effects::put(arm, "sensor_lag", {{"time_constant", 4e-3}});
  effects::put(arm, "torque_dead_zone", {{"width", 0.01}});
  effects::put(arm, "torque_bias", {{"torque", 0.02}});
  return arm;
}

TEST(FrequencyResponse, TheChainIsTheSameForEveryFormulation) {
  const auto chain = linear_chain(take_apart(arm_with_a_chain()));
  const std::array sensors = {arm::Sensor{arm::SensorKind::hub_angle},
                              arm::Sensor{arm::SensorKind::tip_acceleration}};
  const std::array frequency_Hz = {0.7, 13.0, 61.0};
  for (const char* formulation : kFormulations) {
    const auto model = make_formulation(formulation, arm_with_a_chain(), 5);
    const auto response = frequency_response(model, chain, sensors, frequency_Hz);
    for (std::size_t i = 0; i < frequency_Hz.size(); ++i) {
      const Complex s = on_imaginary_axis(frequency_Hz[i]);
      const Complex torque = 1.25 * std::exp(-3e-3 * s) / (1.0 + 2e-3 * s);
      const Complex hub = transfer_function(model, sensors[0], s) * torque;
      const Complex tip = transfer_function(model, sensors[1], s) * torque / (1.0 + 4e-3 * s);
      EXPECT_LT(std::abs(response.values[0][i] - hub), kResponseRounding * std::abs(hub));
      EXPECT_LT(std::abs(response.values[1][i] - tip), kResponseRounding * std::abs(tip));
    }
  }
}

TEST(FrequencyResponse, ThreeFormulationsAgree) {
  constexpr double kAgreement = 1e-9;  // poles and zeros at these settings are within 1e-10
  const auto chain = linear_chain(take_apart(arm_with_a_chain()));
  const std::array frequency_Hz = {0.3, 5.0, 23.0, 70.0};
  const auto by = [&](const char* formulation) {
    return frequency_response(make_formulation(formulation, arm_with_a_chain(), 8), chain,
                              every_sensor(), frequency_Hz);
  };
  const auto exact = by("exact_tf");
  for (const char* formulation : {"fem", "assumed_modes"}) {
    const auto other = by(formulation);
    for (std::size_t k = 0; k < exact.values.size(); ++k) {
      for (std::size_t i = 0; i < frequency_Hz.size(); ++i) {
        EXPECT_LT(std::abs(other.values[k][i] - exact.values[k][i]),
                  kAgreement * std::abs(exact.values[k][i]))
            << formulation << " " << arm::to_string(exact.sensors[k]) << " " << frequency_Hz[i];
      }
    }
  }
}

TEST(FrequencyResponse, OnlyTheSensorThatIsNamedLags) {
  const LinearChain chain{
      .sensor_chains = {{.sensor = {arm::SensorKind::strain, 0.05}, .lag_s = 0.1}}};
  const Complex s(0.0, 10.0);
  EXPECT_EQ(reading_response(chain, {arm::SensorKind::strain, 0.05}, s), 1.0 / (1.0 + 0.1 * s));
  EXPECT_EQ(reading_response(chain, {arm::SensorKind::strain, 0.06}, s), 1.0);
  EXPECT_EQ(reading_response(chain, {arm::SensorKind::hub_angle}, s), 1.0);
}

TEST(FrequencyResponse, NonlinearEffectsAndABiasAreNotInTheChain) {
  arm::Arm nonlinear = arm::paper_arm();
  effects::put(nonlinear, "torque_dead_zone", {{"width", 0.01}});
  effects::put(nonlinear, "torque_bias", {{"torque", 0.02}});
  EXPECT_EQ(linear_chain(take_apart(nonlinear)), LinearChain{});
  EXPECT_EQ(nonlinear_effects(arm_with_a_chain()), std::vector<std::string>{"torque_dead_zone"});
}

TEST(FrequencyResponse, FrequenciesOutOfOrderAndSensorsOffTheArmAreRefused) {
  const auto model = make_formulation("exact_tf", arm::paper_arm(), 1);
  const std::array angle = {arm::Sensor{arm::SensorKind::hub_angle}};
  EXPECT_THROW(frequency_response(model, {}, angle, std::array{2.0, 1.0}), arm::InputError);
  EXPECT_THROW(frequency_response(model, {}, angle, std::array{0.0, 1.0}), arm::InputError);
  const std::array beyond = {arm::Sensor{arm::SensorKind::strain, 2.0}};
  EXPECT_THROW(frequency_response(model, {}, beyond, std::array{1.0}), arm::InputError);
}

}  // namespace
}  // namespace flexarm::response
