#include "measured/modal/nyquist_circle.hpp"

#include "exact_tf/exact_arm.hpp"
#include "tests/measured/simulated_record.hpp"

#include <gtest/gtest.h>

namespace flexarm::measured {
namespace {

using Complex = std::complex<double>;

Complex normal_pair(response::RandomNumbers& random) {
  const double real = random.normal();
  return {real, random.normal()};
}

TEST(FitCircle, OfPointsOnACircleIsThatCircle) {
  for (const double arc : {0.3, 2.0, 6.0}) {
    std::vector<Complex> points;
    for (int i = 0; i < 20; ++i) {
      points.push_back(Complex(3.0, -40.0) + std::polar(2.5, 1.0 + arc * i / 19.0));
    }
    const auto found = fit_circle(points);
    EXPECT_TRUE(found.converged);
    // A short arc tells the radius from its sagitta, radius arc^2/8.
    EXPECT_LT(std::abs(found.centre - Complex(3.0, -40.0)), 1e-11) << arc;
    EXPECT_NEAR(found.radius, 2.5, 1e-11) << arc;
    EXPECT_LT(found.rms_distance, 1e-12);
  }
}

TEST(FitCircle, IsTheLeastSquareOfDistances) {
  response::RandomNumbers random(3);
  std::vector<Complex> points;
  for (int i = 0; i < 40; ++i) {
    points.push_back(std::polar(1.0, 0.08 * i) + 0.02 * normal_pair(random));
  }
  const auto found = fit_circle(points);
  ASSERT_TRUE(found.converged);
  const auto sum = [&](Complex centre, double radius) {
    double total = 0.0;
    for (const auto& point : points) total += std::pow(std::abs(point - centre) - radius, 2);
    return total;
  };
  const double least = sum(found.centre, found.radius);
  EXPECT_NEAR(found.rms_distance, std::sqrt(least / 40.0), 1e-14);
  for (const double step : {-1e-4, 1e-4}) {
    EXPECT_GT(sum(found.centre + step, found.radius), least);
    EXPECT_GT(sum(found.centre + Complex(0.0, step), found.radius), least);
    EXPECT_GT(sum(found.centre, found.radius + step), least);
  }
}

TEST(FitCircle, RefusesLinesAndTooFewPoints) {
  EXPECT_THROW(fit_circle(std::vector<Complex>{0.0, 1.0}), std::invalid_argument);
  EXPECT_THROW(fit_circle(std::vector<Complex>{0.0, 1.0, 2.0, 5.0}), std::invalid_argument);
  EXPECT_THROW(fit_circle(std::vector<Complex>{1.0, 1.0, 1.0}), std::invalid_argument);
}

constexpr double kNatural_Hz = 12.0;

/// One mode, seen by a sensor of that kind, with a constant in velocity form for all others.
FrequencyChannel one_mode(const char* sensor, double zeta, double residue, Complex rest) {
  FrequencyChannel channel{arm::parse_sensor(sensor), {}, {}, {}};
  const double omega_n = kTwoPi * kNatural_Hz;
  for (int i = -200; i <= 200; ++i) {
    const double f_Hz = kNatural_Hz * (1.0 + 4.0 * zeta * i / 200.0);
    const Complex s(0.0, kTwoPi * f_Hz);
    const Complex velocity =
        residue * s / (s * s + 2.0 * zeta * omega_n * s + omega_n * omega_n) + rest;
    channel.frequency_Hz.push_back(f_Hz);
    channel.response.push_back(velocity * std::pow(s, arm::derivative_order(channel.sensor) - 1));
    channel.coherence.push_back(1.0);
  }
  return channel;
}

TEST(NyquistCircleOfOneMode, IsDrawnOnceFromARaggedPeak) {
  auto channel = one_mode("hub_velocity", 0.02, 1.0, 0.0);
  // Two points near the top are lost: two peaks of one resonance.
  for (const std::size_t k : {197U, 203U}) channel.response[k] *= 0.3;
  const auto found = nyquist_circles(channel);
  ASSERT_EQ(found.circles.size(), 1U);
  EXPECT_NEAR(found.circles[0].natural_frequency_Hz, kNatural_Hz, 0.02 * kNatural_Hz);
}

TEST(NyquistCircleOfOneMode, IsExactInEverySensorsForm) {
  for (const char* sensor : {"hub_angle", "hub_velocity", "tip_acceleration"}) {
    for (const double zeta : {1e-3, 0.02, 0.15}) {
      for (const Complex rest : {Complex(0.0), Complex(0.05, -0.1)}) {
        const auto channel =
            one_mode(sensor, zeta, -3.0, rest * 3.0 / (2.0 * zeta * kTwoPi * 12.0));
        const auto found = nyquist_circles(channel, {.near_Hz = {kNatural_Hz}});
        ASSERT_EQ(found.circles.size(), 1U) << sensor << zeta;
        const auto& circle = found.circles[0];
        constexpr double kRounding = 1e-9;
        EXPECT_NEAR(circle.natural_frequency_Hz, kNatural_Hz, kRounding);
        EXPECT_NEAR(circle.damping_ratio / zeta, 1.0, kRounding);
        EXPECT_LT(circle.damping_ratio_std / zeta, kRounding);
        EXPECT_LT(std::abs(circle.modal_constant + 3.0), 3.0 * kRounding);
        // The points' own differences reach over a twentieth of them.
        EXPECT_NEAR(circle.fastest_Hz / kNatural_Hz, 1.0, 0.05 * zeta);
        EXPECT_GT(circle.pairs, 100);
      }
    }
  }
}

TEST(NyquistCircleOfOneMode, StatesTheSpreadThatNoiseMakes) {
  constexpr double kZeta = 0.01;
  constexpr int kRuns = 200;
  const auto clean = one_mode("hub_velocity", kZeta, 1.0, 0.0);
  const double size = 1.0 / (2.0 * kZeta * kTwoPi * kNatural_Hz);
  double square = 0.0;
  double stated = 0.0;
  double damping = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    response::RandomNumbers random(static_cast<std::uint64_t>(run));
    auto noisy = clean;
    for (auto& value : noisy.response) value += 0.01 * size * normal_pair(random);
    const auto found = nyquist_circles(noisy, {.near_Hz = {kNatural_Hz}});
    ASSERT_EQ(found.circles.size(), 1U);
    square += std::pow(found.circles[0].natural_frequency_Hz - kNatural_Hz, 2);
    stated += found.circles[0].natural_frequency_std_Hz;
    damping += found.circles[0].damping_ratio / kRuns;
    EXPECT_LT(std::abs(found.circles[0].damping_ratio - kZeta),
              4.0 * found.circles[0].damping_ratio_std);
  }
  // The angles share the error of the circle's centre, which the least squares do not know of.
  const double ratio = std::sqrt(square / kRuns) / (stated / kRuns);
  EXPECT_GT(ratio, 0.8);
  EXPECT_LT(ratio, 1.6);
  EXPECT_NEAR(damping / kZeta, 1.0, 5e-3);
}

/// The paper's arm as its stepped sine saw it: 0.001 Hz apart around a resonance.
TEST(NyquistCirclesOfTheArm, AreItsPolesButForTheSlopeOfOtherModes) {
  arm::Arm arm = arm::paper_arm();
  arm.damping.kelvin_voigt_s = 1e-4;
  arm.hub.viscous_friction_N_m_s_per_rad = 2e-4;
  const exact_tf::ExactArm exact(arm);
  const auto poles = exact.damped_poles(2).flexible;
  const auto sensors =
      sensors_named({"hub_angle", "hub_velocity", "tip_acceleration", "strain@0.05"});
  const auto modes = exact.modal_model(2, sensors, {});
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    FrequencyChannel channel{sensors[i], {}, {}, {}};
    for (const auto& pole : poles) {
      const double centre_Hz = pole.first_rad_per_s.imag() / kTwoPi;
      for (int k = -1000; k <= 1000; ++k) {
        channel.frequency_Hz.push_back(centre_Hz + 0.001 * k);
        channel.response.push_back(exact.transfer_function(
            sensors[i], Complex(0.0, kTwoPi * channel.frequency_Hz.back())));
        channel.coherence.push_back(1.0);
      }
    }
    const auto found = nyquist_circles(channel);
    ASSERT_EQ(found.circles.size(), 2U) << arm::to_string(sensors[i]);
    for (std::size_t mode = 0; mode < 2; ++mode) {
      const auto& circle = found.circles[mode];
      const auto pole = poles[mode].first_rad_per_s;
      const double zeta = -pole.real() / std::abs(pole);
      EXPECT_EQ(circle.order, static_cast<int>(mode) + 1);
      // Damping ratios are 0.5 % and 1.1 %: squares of them.
      EXPECT_NEAR(circle.natural_frequency_Hz / (std::abs(pole) / kTwoPi), 1.0, 2e-4);
      EXPECT_NEAR(circle.damping_ratio / zeta, 1.0, 2e-2);
      EXPECT_LT(std::abs(circle.damping_ratio / zeta - 1.0),
                5.0 * circle.damping_ratio_std / zeta + 1e-4);
      const double residue = modes.modes[mode + 1].sensor_values[i] *
                             modes.modes[mode + 1].hub_slope / modes.modal_mass_kg_m2;
      EXPECT_LT(std::abs(circle.modal_constant / residue - 1.0), 0.05)
          << arm::to_string(sensors[i]) << mode;
    }
  }
}

TEST(NyquistCircles, RefuseWhatIsNoCircle) {
  auto coarse = one_mode("hub_angle", 0.01, 1.0, 0.0);
  FrequencyChannel few{coarse.sensor, {}, {}, {}};
  for (std::size_t k = 0; k < coarse.frequency_Hz.size(); k += 100) {
    few.frequency_Hz.push_back(coarse.frequency_Hz[k]);
    few.response.push_back(coarse.response[k]);
    few.coherence.push_back(1.0);
  }
  const auto found = nyquist_circles(few, {.near_Hz = {kNatural_Hz}});
  EXPECT_TRUE(found.circles.empty());
  ASSERT_EQ(found.refused.size(), 1U);
  EXPECT_NE(found.refused[0].reason.find("points on the arc"), std::string::npos);

  response::RandomNumbers random(1);
  for (auto& value : coarse.response) value = normal_pair(random);
  EXPECT_TRUE(nyquist_circles(coarse, {.near_Hz = {kNatural_Hz}}).circles.empty());
}

TEST(ModalTableOfCircles, HasTheirPoles) {
  const auto channel = one_mode("hub_angle", 0.01, 1.0, 0.0);
  const auto found = nyquist_circles(channel);
  const auto table = modal_table(channel.sensor, found.circles);
  ASSERT_EQ(table.size(), 1U);
  EXPECT_EQ(table[0].feature, Feature::pole);
  EXPECT_EQ(table[0].frequency_Hz, found.circles[0].natural_frequency_Hz);
  EXPECT_EQ(table[0].damping_ratio, found.circles[0].damping_ratio);
}

}  // namespace
}  // namespace flexarm::measured
