// What dry friction and clipping make of a sine: closed forms.
#include "response/time/stepped_sine_response.hpp"
#include "tests/response/simulation_models.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

namespace flexarm::response {
namespace {

using Complex = std::complex<double>;
constexpr double kPi = std::numbers::pi;
constexpr double kTwoPi = 2.0 * kPi;

SteppedSine one_frequency(double frequency_Hz) {
  SteppedSine sine;
  sine.bands = {{frequency_Hz, frequency_Hz}};
  return sine;
}

/// I theta'' + F sign(theta') = A sin(omega t), A above 1.86 F: the hub never rests. Its speed is
/// odd over half a period and turns at t_0 = acos(pi F/(2 A))/omega, from the momentum of a half
/// period, 2 A cos(omega t_0)/omega = F pi/omega. A square wave F of that phase has the fundamental
/// 4 F/pi, so that I theta'' has
///
///     A sin(omega t) - (4 F/pi) sin(omega (t - t_0)).
TEST(SteppedSineInCoulombFriction, HasTheFundamentalOfItsSquareWave) {
  constexpr double kInertia = 0.05;
  constexpr double kFriction_N_m = 0.02;
  const auto model = oscillator(kInertia, 0.0);
  const auto parts = coulomb(kFriction_N_m);
  const auto sensors = hub_sensors();
  for (const double frequency_Hz : {0.5, 3.0, 40.0}) {
    const auto sine = one_frequency(frequency_Hz);
    const auto made = measure_stepped_sine(model, parts, sensors, sine);
    const double omega = kTwoPi * frequency_Hz;
    const double late = std::acos(kPi * kFriction_N_m / (2.0 * sine.amplitude_N_m));
    const Complex torque =
        1.0 - 4.0 / kPi * kFriction_N_m / sine.amplitude_N_m * std::polar(1.0, -late);
    const Complex s(0.0, omega);
    // Harmonics n - 1 and n + 1 of the speed are 1/n^2 of the first of friction's part each.
    const double images = 2.0 / (255.0 * 255.0);
    EXPECT_LT(std::abs(made.values[1][0] * kInertia * s - torque), images) << frequency_Hz;
    EXPECT_LT(std::abs(made.values[0][0] * kInertia * s * s - torque), images) << frequency_Hz;
    EXPECT_EQ(made.summary.stops, 0);
    EXPECT_EQ(made.summary.reversals, 2 * sine.cycles);
    EXPECT_EQ(made.summary.unsettled, 0);
  }
}

TEST(SteppedSineInCoulombFriction, DoesNotMoveAHubThatItHolds) {
  auto sine = one_frequency(3.0);
  sine.amplitude_N_m = 0.019;
  const auto made =
      measure_stepped_sine(two_masses(0.01, 0.05, 3.0), coulomb(0.02), hub_sensors(), sine);
  EXPECT_EQ(made.values[0][0], 0.0);
  EXPECT_EQ(made.values[1][0], 0.0);
  EXPECT_EQ(made.summary.unsettled, 0);
  EXPECT_NEAR(made.summary.stick_time_s, 4.0 / 3.0, 1e-12);
}

/// The paper's bias: where it keeps the hub turning one way, friction is a constant and the
/// response that of the arm without.
TEST(SteppedSineInCoulombFriction, IsTheArmsOwnWhileAnOffsetKeepsTheHubTurning) {
  auto model = oscillator(0.05, 0.0, 0.05);
  auto sine = one_frequency(3.0);
  sine.amplitude_N_m = 0.01;
  sine.offset_N_m = 0.05;  // 0.6 rad/s, of which the sine takes 0.01
  const auto parts = coulomb(0.02);
  const auto made = measure_stepped_sine(model, parts, hub_sensors(), sine);
  const Complex s(0.0, kTwoPi * 3.0);
  const Complex expected = 1.0 / (0.05 * s + 0.05);
  EXPECT_LT(std::abs(made.values[1][0] - expected), 1e-9 * std::abs(expected));
  EXPECT_EQ(made.summary.reversals, 0);
}

/// A sine clipped at L = A sin(a) has the fundamental (2/pi)(a + sin(a) cos(a)) A.
TEST(SteppedSineThatSaturates, HasTheFundamentalOfAClippedSine) {
  ArmParts parts;
  parts.linear = arm::paper_arm();
  put(parts, "torque_saturation", {{"limit", 0.03}});
  put(parts, "time_delay", {{"delay", 0.0371}});
  const auto made =
      measure_stepped_sine(oscillator(0.05, 0.0, 0.05), parts, hub_sensors(), one_frequency(3.0));
  const double angle = std::asin(0.6);
  const double left = 2.0 / kPi * (angle + std::sin(angle) * std::cos(angle));
  const Complex s(0.0, kTwoPi * 3.0);
  const Complex expected = left * std::exp(-s * 0.0371) / (0.05 * s + 0.05);
  // The polygon through 256 points lies up to (2 pi/256)^2/8 below the sine.
  EXPECT_LT(std::abs(made.values[1][0] - expected), 1e-4 * std::abs(expected));
  EXPECT_EQ(made.summary.unsettled, 0);
}

TEST(SteppedSineInCoulombFriction, FindsTheSteadyStateOfAnArmWithModesFromAnyState) {
  const auto model = two_masses(0.01, 0.05, 30.0);
  const auto parts = coulomb(0.01);
  SteppedSine sine;
  sine.bands = {{4.0, 20.0}};
  sine.step_Hz = 1.0;
  const auto steady = measure_stepped_sine(model, parts, hub_sensors(), sine);
  sine.settle_s = 60.0;
  const auto waited = measure_stepped_sine(model, parts, hub_sensors(), sine);
  EXPECT_EQ(steady.summary.unsettled, 0) << steady.summary.largest_change;
  for (std::size_t k = 0; k < steady.frequency_Hz.size(); ++k) {
    EXPECT_LT(std::abs(steady.values[1][k] - waited.values[1][k]),
              1e-6 * std::abs(steady.values[1][k]))
        << steady.frequency_Hz[k];
  }
}

}  // namespace
}  // namespace flexarm::response
