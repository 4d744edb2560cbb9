#include "response/state_space.hpp"

#include "response/frequency/frequency_response.hpp"
#include "response/frequency/modal_response.hpp"
#include "response/residual_mode.hpp"
#include "tests/response/models.hpp"

#include <Eigen/Eigenvalues>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <stdexcept>

namespace flexarm::response {
namespace {

using Complex = std::complex<double>;
using testing::ElementsAre;

arm::ModalModel model_of(const char* formulation, const arm::Arm& arm, int modes) {
  return modal_model(make_formulation(formulation, arm, modes + 1), modes, every_sensor(), {});
}

/// Largest distance of the state space from the modal sum with its chain, relative to the sensor's
/// largest term.
double distance(const StateSpace& system, const arm::ModalModel& model, const LinearChain& chain,
                Complex s) {
  const auto by_states = frequency_response(system, s);
  const auto by_modes = modal_response(model, every_sensor(), s);
  double largest = 0.0;
  for (std::size_t k = 0; k < by_modes.size(); ++k) {
    const Complex expected =
        by_modes[k] * actuator_response(chain, s) * reading_response(chain, every_sensor()[k], s);
    largest = std::max(largest, std::abs(by_states[k] - expected) / std::abs(expected));
  }
  return largest;
}

TEST(StateSpace, IsTheModalSum) {
  // Elimination in 2n unknowns whose stiffnesses span four decades.
  constexpr double kElimination = 1e-10;
  for (const char* formulation : kFormulations) {
    const auto model = model_of(formulation, damped_arm(), 6);
    const auto system = state_space(model, every_sensor());
    for (const Complex s : {Complex(0.0, 1.0), Complex(0.0, 80.0), Complex(3.0, 400.0),
                            Complex(-2.0, 1234.0), Complex(50.0, 0.0)}) {
      EXPECT_LT(distance(system, model, {}, s), kElimination) << formulation << " " << s;
    }
  }
}

TEST(StateSpace, LagsAreStatesAndDelaysStandBeside) {
  constexpr double kElimination = 1e-10;
  const LinearChain chain{
      .gain = 1.3,
      .delay_s = 2e-3,
      .lag_s = 5e-3,
      .sensor_chains = {{.sensor = {arm::SensorKind::tip_acceleration},
                         .gain = 0.8,
                         .delay_s = 4e-3,
                         .lag_s = 1e-3},
                        {.sensor = {arm::SensorKind::hub_angle}, .gain = -1.2}}};
  const auto model = model_of("exact_tf", damped_arm(), 3);
  const auto system = state_space(model, every_sensor(), chain);
  EXPECT_THAT(system.states, ElementsAre("q_0", "q_0'", "q_1", "q_1'", "q_2", "q_2'", "q_3", "q_3'",
                                         "hub torque", "reading of tip_acceleration"));
  EXPECT_EQ(system.a.rows(), 10);
  EXPECT_EQ(system.delay_s, 2e-3);
  for (std::size_t k = 0; k < system.sensors.size(); ++k) {
    const bool is_late = system.sensors[k].kind == arm::SensorKind::tip_acceleration;
    EXPECT_EQ(system.output_delay_s(static_cast<Eigen::Index>(k)), is_late ? 4e-3 : 0.0);
  }
  EXPECT_TRUE(system.d.isZero(0.0)) << "nothing passes two lags at once";
  for (const double omega : {0.5, 60.0, 700.0}) {
    EXPECT_LT(distance(system, model, chain, Complex(0.0, omega)), kElimination);
  }
}

TEST(StateSpace, TheTipsAccelerationHasAFeedthrough) {
  const auto model = model_of("exact_tf", damped_arm(), 3);
  const auto system = state_space(model, every_sensor(), {.gain = 2.0});
  double expected = 0.0;
  for (const auto& mode : model.modes) {
    expected += 2.0 * mode.sensor_values[2] * mode.hub_slope / model.modal_mass_kg_m2;
  }
  EXPECT_DOUBLE_EQ(system.d(2, 0), expected);
  for (const Eigen::Index k : {0, 1, 3, 4, 5}) EXPECT_EQ(system.d(k, 0), 0.0);
}

TEST(StateSpace, TheRigidBodyModeIsADoubleIntegratorAndFlexibleOnesAreOscillators) {
  const auto model = model_of("exact_tf", arm::paper_arm(), 2);
  const auto system = state_space(model, every_sensor());
  Eigen::Matrix<double, 6, 6> expected = Eigen::Matrix<double, 6, 6>::Zero();
  for (Eigen::Index i = 0; i < 3; ++i) {
    const double omega = model.modes[static_cast<std::size_t>(i)].omega_rad_per_s;
    expected(2 * i, 2 * i + 1) = 1.0;
    expected(2 * i + 1, 2 * i) = -omega * omega;
  }
  EXPECT_EQ(system.a, expected);
  EXPECT_EQ(system.b(1, 0), 1.0 / model.modal_mass_kg_m2);
}

TEST(StateSpace, AgreesWithTheTransferFunctionWhereItsModesSuffice) {
  // Between 20 modes and a pseudo-mode, at a tenth of the first pole left out, strain is the worst:
  // what is left out of it falls as 1/n, times 1e-2.
  constexpr double kLeftOut = 1e-4;
  for (const char* name : kFormulations) {
    const auto formulation = make_formulation(name, damped_arm(), 42);
    const auto model = with_residual_mode(
        formulation, modal_model(formulation, 20, every_sensor(), {}), every_sensor());
    const auto system = state_space(model, every_sensor());
    for (const double frequency_Hz : {0.2, 7.0, 30.0, 100.0}) {
      const Complex s = on_imaginary_axis(frequency_Hz);
      const auto by_states = frequency_response(system, s);
      for (std::size_t k = 0; k < by_states.size(); ++k) {
        const Complex exact = transfer_function(formulation, every_sensor()[k], s);
        EXPECT_LT(std::abs(by_states[k] - exact), kLeftOut * std::abs(exact))
            << name << " " << arm::to_string(every_sensor()[k]) << " " << frequency_Hz;
      }
    }
  }
}

TEST(StateSpace, FlexibleEigenvaluesAreDamped) {
  const auto system = state_space(model_of("fem", damped_arm(), 5), every_sensor());
  const Eigen::VectorXcd poles = system.a.eigenvalues();
  for (const Complex pole : poles) EXPECT_LE(pole.real(), 1e-9);
}

TEST(StateSpace, DampingThatFeedsEnergyInIsRefused) {
  auto model = model_of("exact_tf", damped_arm(), 3);
  EXPECT_NO_THROW(state_space(model, every_sensor()));
  for (double& entry : model.damping_rad_per_s) entry = -entry;
  EXPECT_THROW(state_space(model, every_sensor()), std::invalid_argument);

  model = model_of("exact_tf", damped_arm(), 3);
  model.damping_rad_per_s[1] += 1.0;  // not symmetric
  EXPECT_THROW(state_space(model, every_sensor()), std::invalid_argument);

  model = model_of("exact_tf", damped_arm(), 3);
  model.damping_rad_per_s.pop_back();
  EXPECT_THROW(state_space(model, every_sensor()), std::invalid_argument);
  EXPECT_THROW(state_space(model_of("exact_tf", damped_arm(), 3), {}), std::invalid_argument);
}

TEST(StateSpace, AFlippedSignOfDampingShowsInTheResponse) {
  const auto model = model_of("exact_tf", damped_arm(), 3);
  auto system = state_space(model, every_sensor());
  for (Eigen::Index i = 0; i < 4; ++i) {
    for (Eigen::Index j = 0; j < 4; ++j) system.a(2 * i + 1, 2 * j + 1) *= -1.0;
  }
  const Complex s(0.0, model.modes[1].omega_rad_per_s);
  EXPECT_GT(distance(system, model, {}, s), 1.0);
}

}  // namespace
}  // namespace flexarm::response
