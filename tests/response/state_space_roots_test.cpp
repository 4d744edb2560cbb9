#include "response/state_space_roots.hpp"

#include "arm/input_error.hpp"
#include "response/residual_mode.hpp"
#include "tests/response/models.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace flexarm::response {
namespace {

using Complex = std::complex<double>;
using testing::SizeIs;

/// Of eigenvalues whose sizes span three decades, relative to the largest.
constexpr double kEigenvalues = 1e-10;

StateSpace system_of(const char* formulation, const arm::Arm& arm, int modes,
                     const LinearChain& chain = {}) {
  return state_space(
      modal_model(make_formulation(formulation, arm, modes + 1), modes, every_sensor(), {}),
      every_sensor(), chain);
}

TEST(StateSpaceRoots, PolesAreTheDampedPolesOfTheArm) {
  // Finite elements of which all modes are kept: the state space is the whole model.
  for (const char* formulation : kFormulations) {
    const auto made = make_formulation(formulation, damped_arm(), 4);
    const auto found = poles(system_of(formulation, damped_arm(), 40));
    // Modes are coupled by damping, so that leaving some out moves the others.
    constexpr double kOmittedModes = 1e-4;
    for (const auto& pair : damped_poles(made, 3).flexible) {
      for (const Complex s : {pair.first_rad_per_s, pair.second_rad_per_s}) {
        const double nearest =
            std::abs(*std::ranges::min_element(found, {}, [&](const Complex one) {
              return std::abs(one - s);
            }) - s);
        EXPECT_LT(nearest, kOmittedModes * std::abs(s)) << formulation << " " << s;
      }
    }
  }
}

TEST(StateSpaceRoots, TheResponseVanishesAtZeros) {
  const LinearChain chain{.gain = 1.3, .delay_s = 2e-3, .lag_s = 5e-3};
  for (const LinearChain& one : {LinearChain(), chain}) {
    const auto system = system_of("exact_tf", damped_arm(), 5, one);
    const double fastest = std::abs(poles(system).back());
    for (std::size_t k = 0; k < system.sensors.size(); ++k) {
      const auto found = zeros(system, system.sensors[k]);
      EXPECT_FALSE(found.empty());
      for (const Complex s : found) {
        if (std::abs(s) < 1e-6 * fastest) continue;  // of a velocity or acceleration, at rest
        // Its size at a place as far from all zeros as this one is from the origin.
        const double beside = std::abs(frequency_response(system, s * Complex(1.05, 0.05))[k]);
        EXPECT_LT(std::abs(frequency_response(system, s)[k]), 1e-6 * beside)
            << arm::to_string(system.sensors[k]) << " " << s;
      }
    }
  }
}

TEST(StateSpaceRoots, ZerosConvergeToThoseOfTheArm) {
  arm::Arm arm = arm::paper_arm();
  const auto made = make_formulation("exact_tf", arm, 4);
  const arm::Sensor hub{arm::SensorKind::hub_angle};
  const auto found = zeros(system_of("exact_tf", arm, 60), hub);
  // Collocated: an error of some 1/modes^3, as of the static response of the omitted ones.
  constexpr double kOmittedModes = 1e-3;
  const auto exact = zeros(made, hub, 2).s_rad_per_s;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    EXPECT_NEAR(std::abs(found[2 * i]), std::abs(exact[i]), kOmittedModes * std::abs(exact[i]));
  }
}

TEST(StateSpaceRoots, ASecondOrderSystemHasThoseOfItsPolynomials) {
  // y = (2 s + 3)/(s^2 + 4 s + 5) u in controllable form, and 1 more with feedthrough.
  StateSpace system;
  system.a = (Eigen::MatrixXd(2, 2) << 0.0, 1.0, -5.0, -4.0).finished();
  system.b = (Eigen::MatrixXd(2, 1) << 0.0, 1.0).finished();
  system.c = (Eigen::MatrixXd(1, 2) << 3.0, 2.0).finished();
  system.d = Eigen::MatrixXd::Zero(1, 1);
  system.sensors = {{arm::SensorKind::hub_angle}};
  const auto expect_pair = [](const std::vector<Complex>& roots, Complex upper) {
    ASSERT_THAT(roots, SizeIs(2));
    EXPECT_LT(std::abs(roots[0] - upper), kEigenvalues);
    EXPECT_LT(std::abs(roots[1] - std::conj(upper)), kEigenvalues);
  };
  expect_pair(poles(system), {-2.0, 1.0});
  const auto of_numerator = zeros(system, system.sensors[0]);
  ASSERT_THAT(of_numerator, SizeIs(1));
  EXPECT_LT(std::abs(of_numerator[0] - Complex(-1.5)), kEigenvalues);
  system.d(0, 0) = 1.0;  // s^2 + 6 s + 8
  const auto of_both = zeros(system, system.sensors[0]);
  ASSERT_THAT(of_both, SizeIs(2));
  EXPECT_LT(std::abs(of_both[0] - Complex(-2.0)), kEigenvalues);
  EXPECT_LT(std::abs(of_both[1] - Complex(-4.0)), kEigenvalues);
  system.d(0, 0) = 0.0;
  system.c.setZero();
  EXPECT_THAT(zeros(system, system.sensors[0]), SizeIs(0));
}

TEST(StateSpaceRoots, AnotherSensorIsNamed) {
  StateSpace system;
  system.sensors = {{arm::SensorKind::hub_angle}};
  try {
    zeros(system, {arm::SensorKind::tip_acceleration});
    FAIL();
  } catch (const arm::InputError& error) {
    EXPECT_STREQ(error.what(), "tip_acceleration: not among the sensors of the state space");
  }
}

}  // namespace
}  // namespace flexarm::response
