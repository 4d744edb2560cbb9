// A linear arm under a stepped sine against the response that frequency_response states.
#include "arm/input_error.hpp"
#include "effects/registry/vocabulary.hpp"
#include "measured/modal/nyquist_circle.hpp"
#include "response/frequency/frequency_response.hpp"
#include "response/frequency/modal_response.hpp"
#include "response/time/stepped_sine_response.hpp"
#include "response/time/time_model.hpp"
#include "tests/response/models.hpp"
#include "tests/response/simulation_models.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>

namespace flexarm::response {
namespace {

using Complex = std::complex<double>;
using testing::HasSubstr;

/// Rounding of e^(A h), of 64 steps of it and of the sum of the modes, over the condition of
/// 1 - e^(A T), which is 1/(2 pi zeta), some 100 here: 1e-16 * 64 * 100, and a sum whose terms
/// cancel to a hundredth near the zeros.
constexpr double kSteadyRounding = 1e-10;
/// With every mode of the mesh the modal sum is the mesh's own response, which its transfer
/// function has from its matrices: condition 1e9 of those of 30 degrees of freedom or more, times
/// epsilon.
constexpr double kMeshRounding = 1e-8;

SteppedSine stepped(double from_Hz, double to_Hz, double step_Hz) {
  SteppedSine sine;
  sine.bands = {{from_Hz, to_Hz}};
  sine.step_Hz = step_Hz;
  return sine;
}

/// All arms are damped: the paper's, and others with what is linear between torque and reading.
std::vector<std::pair<std::string, arm::Arm>> linear_arms() {
  const arm::Arm damped = damped_arm();
  arm::Arm free = damped;  // its angle drifts
  free.hub.viscous_friction_N_m_s_per_rad = 0.0;
  arm::Arm sprung = damped;
  effects::put(sprung, "hub_spring", {{"stiffness", 0.3}});
  arm::Arm late = damped;
  effects::put(late, "time_delay", {{"delay", 0.0123}});
  effects::put(late, "torque_gain", {{"factor", -0.8}});
  effects::put(late, "actuator_lag", {{"time_constant", 0.004}});
  effects::put(late, "sensor_lag", {{"time_constant", 0.002}});
  effects::put(late, "torque_bias", {{"torque", 0.01}});
  arm::Arm read_wrongly = damped;
  effects::put(read_wrongly, "sensor_gain", {{"factor", 1.3}}, "hub_angle");
  effects::put(read_wrongly, "sensor_delay", {{"delay", 0.0071}}, "tip_acceleration");
  effects::put(read_wrongly, "sensor_offset", {{"value", 0.05}}, "hub_velocity");
  return {{"damped", damped},
          {"free", free},
          {"sprung", sprung},
          {"late", late},
          {"read wrongly", read_wrongly}};
}

double worst(const SteppedSineResponse& made, std::size_t sensor,
             const std::vector<Complex>& expected) {
  double largest = 0.0;
  for (std::size_t k = 0; k < expected.size(); ++k) {
    largest =
        std::max(largest, std::abs(made.values[sensor][k] - expected[k]) / std::abs(expected[k]));
  }
  return largest;
}

TEST(SteppedSineOfALinearArm, IsTheFrequencyResponseOfItsMesh) {
  for (const auto& [name, arm] : linear_arms()) {
    const auto parts = take_apart(arm);
    const AnyFormulation mesh = fem::FemArm(parts.linear, {.mesh = {.elements = 2}, .degree = 7});
    auto sensors = every_sensor();
    sensors.pop_back();  // strain: the mesh has it by equilibrium, and modes reach that slowly
    const auto model = time_model(mesh, parts, degrees_of_freedom(mesh) - 1, sensors);
    auto sine = stepped(1.0, 40.0, 1.3);
    sine.offset_N_m = 0.02;
    const auto made = measure_stepped_sine(model, parts, sensors, sine);
    const auto expected = frequency_response(mesh, linear_chain(parts), sensors, made.frequency_Hz);
    for (std::size_t j = 0; j < sensors.size(); ++j) {
      EXPECT_LT(worst(made, j, expected.values[j]), kMeshRounding)
          << name << ", " << arm::to_string(sensors[j]);
    }
    EXPECT_EQ(made.summary.unsettled, 0) << name << made.summary.largest_change;
  }
}

TEST(SteppedSineOfALinearArm, IsTheSumOfItsModes) {
  for (const auto& [name, arm] : linear_arms()) {
    const auto parts = take_apart(arm);
    const auto formulation = make_formulation("exact_tf", parts.linear, 5);
    const auto sensors = every_sensor();
    const auto model = time_model(formulation, parts, 5, sensors);
    const auto made = measure_stepped_sine(model, parts, sensors, stepped(10.0, 14.0, 0.1));
    const auto chain = linear_chain(parts);
    for (std::size_t j = 0; j < sensors.size(); ++j) {
      std::vector<Complex> expected;
      for (const double f : made.frequency_Hz) {
        const Complex s = on_imaginary_axis(f);
        expected.push_back(modal_response(model, sensors, s)[j] * actuator_response(chain, s) *
                           reading_response(chain, sensors[j], s));
      }
      EXPECT_LT(worst(made, j, expected), kSteadyRounding)
          << name << ", " << arm::to_string(sensors[j]);
    }
  }
}

/// Nothing but the polygon's harmonics, 1/255^2 of the torque and more at the resonances beside
/// them, tells a torque that saturates at just more than its peak from one that does not. Here the
/// dead zone has no width to speak of, and the command is still taken through points.
TEST(SteppedSineOfALinearArm, IsTheSameThroughPointsOfAPolygonButForItsImages) {
  constexpr double kImages = 2.0 / (255.0 * 255.0);
  arm::Arm arm = damped_arm();
  effects::put(arm, "time_delay", {{"delay", 0.0123}});
  auto parts = take_apart(arm);
  const auto formulation = make_formulation("exact_tf", parts.linear, 3);
  const auto sensors = hub_sensors();
  const auto model = time_model(formulation, parts, 3, sensors);
  const auto sine = stepped(10.0, 14.0, 0.5);
  const auto through_sine = measure_stepped_sine(model, parts, sensors, sine);
  put(parts, "torque_dead_zone", {{"width", 1e-12}});
  const auto through_points = measure_stepped_sine(model, parts, sensors, sine);
  EXPECT_EQ(through_sine.summary.most_samples_per_period, 64);
  EXPECT_EQ(through_points.summary.least_samples_per_period, 256);
  for (std::size_t j = 0; j < sensors.size(); ++j) {
    EXPECT_LT(worst(through_points, j, through_sine.values[j]), kImages);
    EXPECT_GT(worst(through_points, j, through_sine.values[j]), 0.0);
  }
}

/// I theta'' + c theta' = T from rest at 2 Hz: theta' = -A/(omega I) (cos - 1) is off by its mean,
/// which decays as exp(-c t/I).
TEST(SteppedSineThatSettles, KeepsWhatIsLeftOfTheTransientAndSaysSo) {
  const auto model = oscillator(0.05, 0.0, 0.1);  // 2 1/s
  ArmParts parts;
  parts.linear = arm::paper_arm();
  const auto sensors = hub_sensors();
  auto sine = stepped(2.0, 2.0, 1.0);
  const Complex s = on_imaginary_axis(2.0);
  const Complex expected = 1.0 / (0.05 * s + 0.1);
  double last = 1.0;
  for (const double settle_s : {0.0, 4.0, 8.0}) {
    sine.settle_s = settle_s;
    const auto made = measure_stepped_sine(model, parts, sensors, sine);
    const double off = std::abs(made.values[1][0] - expected) / std::abs(expected);
    EXPECT_GT(off, 1e-12) << settle_s;
    EXPECT_LT(off, last) << settle_s;
    EXPECT_EQ(made.summary.unsettled, settle_s < 8.0 ? 1 : 0);
    EXPECT_GT(made.summary.largest_change, 0.01 * off);
    // In 4 s a transient of 2 1/s shrinks to 3e-4.
    last = 4e-4 * off;
  }
  sine.settle_s.reset();
  const auto steady = measure_stepped_sine(model, parts, sensors, sine);
  EXPECT_LT(std::abs(steady.values[1][0] - expected), kSteadyRounding * std::abs(expected));
  EXPECT_EQ(steady.summary.unsettled, 0);
}

TEST(SteppedSineWithNoise, HasTheSpreadAndTheCoherenceOfItsCycles) {
  const auto model = oscillator(0.05, 20.0, 0.1);
  ArmParts parts;
  parts.linear = arm::paper_arm();
  const auto sensors = hub_sensors();
  auto sine = stepped(2.0, 5.0, 0.005);
  sine.cycles = 8;
  const auto clean = measure_stepped_sine(model, parts, sensors, sine);
  SteppedSineOptions options;
  options.imperfections = {{.relative_noise = 0.0, .noise = 0.01, .quantisation = 0.0}, {}};
  const auto noisy = measure_stepped_sine(model, parts, sensors, sine, options);
  EXPECT_EQ(noisy.values[1], clean.values[1]);
  EXPECT_TRUE(std::isnan(noisy.coherence[1][7]));
  EXPECT_TRUE(std::isnan(clean.coherence[0][7]));
  EXPECT_EQ(noisy.noise_deviation, (std::vector<double>{0.01, 0.0}));
  double square = 0.0;
  double left = 0.0;
  double expected_left = 0.0;
  const auto count = static_cast<double>(clean.frequency_Hz.size());
  // Least squares over N samples: 2/N of the noise's variance in each of both parts.
  const double deviation = 0.01 * std::sqrt(2.0 / (8 * 64)) / sine.amplitude_N_m;
  for (std::size_t k = 0; k < clean.frequency_Hz.size(); ++k) {
    square += std::norm(noisy.values[0][k] - clean.values[0][k]) / (2.0 * count);
    ASSERT_LE(noisy.coherence[0][k], 1.0);
    ASSERT_GT(noisy.coherence[0][k], 0.0);
    left += 1.0 - noisy.coherence[0][k];
    // A cycle has 8 times the variance, of which 7/8 lies about the cycles' mean.
    const double noise = 2.0 * 8.0 * deviation * deviation;
    expected_left += 7.0 / 8.0 * noise / (noise + std::norm(clean.values[0][k]));
  }
  // 601 complex values: a standard error of 3 %; the trend takes 1/(1 - 6/(8 pi)^2), 1 % more.
  EXPECT_NEAR(std::sqrt(square) / deviation, 1.0, 0.1);
  EXPECT_NEAR(left / expected_left, 1.0, 0.1);

  options.imperfections[0] = {.relative_noise = 0.02, .noise = 0.0, .quantisation = 0.0};
  const auto relative = measure_stepped_sine(model, parts, sensors, sine, options);
  double power = 0.0;
  for (const auto& value : clean.values[0]) {
    power += 0.5 * std::norm(value * sine.amplitude_N_m) / count;
  }
  EXPECT_NEAR(relative.noise_deviation[0] / (0.02 * std::sqrt(power)), 1.0, 1e-12);
}

/// The paper's way: 0.001 Hz apart around a resonance, then a Nyquist circle.
TEST(SteppedSineOfThePapersArm, GivesTheFrequencyAndDampingOfItsPoles) {
  arm::Arm arm = arm::paper_arm();
  arm.damping.kelvin_voigt_s = 1e-4;
  arm.hub.viscous_friction_N_m_s_per_rad = 2e-4;
  const auto parts = take_apart(arm);
  const auto formulation = make_formulation("exact_tf", parts.linear, 5);
  const auto sensors = every_sensor();
  const auto model = time_model(formulation, parts, 5, sensors);
  const auto pole = damped_poles(formulation, 1).flexible.front().first_rad_per_s;
  const double f_Hz = std::abs(pole) / (2.0 * std::numbers::pi);
  const double zeta = -pole.real() / std::abs(pole);
  const auto sine = stepped(f_Hz - 0.3, f_Hz + 0.3, 0.001);
  const auto made = measure_stepped_sine(model, parts, sensors, sine);
  for (std::size_t j = 0; j < sensors.size(); ++j) {
    const measured::FrequencyChannel channel{sensors[j], made.frequency_Hz, made.values[j],
                                             made.coherence[j]};
    const auto found = measured::nyquist_circles(channel, {.near_Hz = {f_Hz}});
    ASSERT_EQ(found.circles.size(), 1U) << arm::to_string(sensors[j]);
    // What the slope of the other modes leaves: tests/measured/nyquist_circle_test.cpp.
    EXPECT_NEAR(found.circles[0].natural_frequency_Hz / f_Hz, 1.0, 2e-4)
        << arm::to_string(sensors[j]);
    EXPECT_NEAR(found.circles[0].damping_ratio / zeta, 1.0, 2e-2) << arm::to_string(sensors[j]);
  }
}

TEST(SteppedSine, RefusesWhatHasNoSteadyStateOrNoSense) {
  ArmParts parts;
  parts.linear = arm::paper_arm();
  const auto sensors = hub_sensors();
  const auto error_of = [&](const arm::ModalModel& model, const SteppedSine& sine) {
    try {
      measure_stepped_sine(model, parts, sensors, sine);
    } catch (const arm::InputError& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_THAT(error_of(oscillator(0.05, -1.0), stepped(1.0, 2.0, 0.5)), HasSubstr("unstable"));
  auto none = stepped(1.0, 2.0, 0.5);
  none.amplitude_N_m = 0.0;
  EXPECT_THAT(error_of(oscillator(0.05, 1.0), none), HasSubstr("stepped-sine.amplitude = 0 N m"));
}

TEST(SteppedSine, EndsWhereItIsCancelled) {
  ArmParts parts;
  parts.linear = arm::paper_arm();
  const auto made = measure_stepped_sine(oscillator(0.05, 20.0, 0.1), parts, hub_sensors(),
                                         stepped(1.0, 2.0, 0.1), {},
                                         [](double fraction) { return fraction < 0.25; });
  EXPECT_FALSE(made.summary.completed);
  EXPECT_EQ(made.frequency_Hz, (std::vector<double>{1.0, 1.1, 1.2}));
  EXPECT_EQ(made.values[0].size(), 3U);
}

}  // namespace
}  // namespace flexarm::response
