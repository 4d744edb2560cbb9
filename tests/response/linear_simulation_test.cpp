// The linear time response against the exact transfer function, and the formulations against each
// other.
#include "exact_tf/exact_arm.hpp"
#include "response/any_formulation.hpp"
#include "response/formulation_maker.hpp"
#include "response/residual_mode.hpp"
#include "response/time/step_check.hpp"
#include "tests/response/simulation_models.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>

namespace flexarm::response {
namespace {

using Complex = std::complex<double>;

/// What 20 modes and their residual leave out at 20 Hz: (f/f_21)^2 = 3e-5 of the part of the modes
/// left out in the static strain near the root, some 1e-3 of it; less in all others.
constexpr double kTruncation = 1e-7;
/// The formulations' modes agree to some 1e-12; phases of 6000 rad/s run for 2 s.
constexpr double kPhaseRounding = 1e-10;

/// The paper's arm with damping that lets transients die in some seconds.
arm::Arm settling_arm() {
  arm::Arm arm = arm::paper_arm();
  arm.damping.kelvin_voigt_s = 4e-4;
  arm.hub.viscous_friction_N_m_s_per_rad = 0.1;
  return arm;
}

std::vector<arm::Sensor> every_sensor() {
  std::vector<arm::Sensor> sensors;
  for (const char* name : {"hub_angle", "hub_velocity", "tip_acceleration", "tip_displacement",
                           "tip_deflection", "strain@0.05"}) {
    sensors.push_back(arm::parse_sensor(name));
  }
  return sensors;
}

/// A periodic torque: odd harmonics with random phases.
struct SteadyMultisine {
  static constexpr int kSamples = 4096;  ///< a period
  static constexpr double kPeriod_s = 2.0;
  static constexpr int kHighestHarmonic = 41;  ///< 20 Hz; the mode 20 of the arm is at 3300 Hz

  SteadyMultisine() {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> phase(0.0, 2.0 * std::numbers::pi);
    for (int k = 1; k <= kHighestHarmonic; k += 2) {
      harmonics.push_back(k);
      amplitudes.push_back(std::polar(0.01, phase(random)));
    }
  }

  std::vector<double> samples(int periods) const {
    std::vector<double> torque(static_cast<std::size_t>(periods * kSamples));
    for (std::size_t i = 0; i < torque.size(); ++i) {
      for (std::size_t h = 0; h < harmonics.size(); ++h) {
        const double angle =
            2.0 * std::numbers::pi * harmonics[h] * static_cast<double>(i % kSamples) / kSamples;
        torque[i] += 2.0 * (amplitudes[h] * std::polar(1.0, angle)).real();
      }
    }
    return torque;
  }

  std::vector<int> harmonics;
  std::vector<Complex> amplitudes;  ///< half of each sine's
};

/// The coefficient of harmonic k in the last period.
Complex coefficient(const std::vector<double>& values, int k) {
  Complex sum = 0.0;
  const std::size_t first = values.size() - SteadyMultisine::kSamples;
  for (std::size_t i = 0; i < SteadyMultisine::kSamples; ++i) {
    sum +=
        values[first + i] * std::polar(1.0, -2.0 * std::numbers::pi * k * static_cast<double>(i) /
                                                SteadyMultisine::kSamples);
  }
  return sum / static_cast<double>(SteadyMultisine::kSamples);
}

/// What samples show of harmonic k: a torque that is linear between samples has the harmonics
/// k + m N too, each sinc^2(pi (k + m N)/N) of the samples' amplitude, and sampling folds them
/// back.
Complex exact_coefficient(const exact_tf::ExactArm& exact, const arm::Sensor& sensor, int k,
                          Complex amplitude) {
  constexpr int kImages = 20;
  Complex sum = 0.0;
  for (int m = -kImages; m <= kImages; ++m) {
    const double harmonic = k + static_cast<double>(m) * SteadyMultisine::kSamples;
    const double x = std::numbers::pi * harmonic / SteadyMultisine::kSamples;
    const double sinc = std::sin(x) / x;
    sum += amplitude * sinc * sinc *
           exact.transfer_function(sensor, Complex(0.0, 2.0 * std::numbers::pi * harmonic /
                                                            SteadyMultisine::kPeriod_s));
  }
  return sum;
}

TEST(LinearSimulation, OfAMultisineShowsTheExactTransferFunctionAtEverySensor) {
  const auto arm = settling_arm();
  const auto sensors = every_sensor();
  const AnyFormulation formulation = make_formulation("exact_tf", arm, 20);
  const auto model =
      with_residual_mode(formulation, modal_model(formulation, 20, sensors, {}), sensors);
  ArmParts parts;
  parts.linear = arm;
  const SteadyMultisine torque;
  constexpr int kPeriods = 20;
  const auto made =
      simulate(model, parts, sensors, torque.samples(kPeriods),
               {.sample_time_s = SteadyMultisine::kPeriod_s / SteadyMultisine::kSamples,
                .hold = TorqueHold::first,
                .energy = false});
  const exact_tf::ExactArm exact(arm);
  for (std::size_t j = 0; j < sensors.size(); ++j) {
    double worst = 0.0;
    for (std::size_t h = 0; h < torque.harmonics.size(); ++h) {
      const int k = torque.harmonics[h];
      const Complex expected = exact_coefficient(exact, sensors[j], k, torque.amplitudes[h]);
      const Complex found = coefficient(made.channels[j], k);
      worst = std::max(worst, std::abs(found - expected) / std::abs(expected));
    }
    EXPECT_LT(worst, kTruncation) << arm::to_string(sensors[j]);
  }
}

/// + - 0: the arm turns and comes to rest but for its vibration.
std::vector<double> bang_bang() {
  std::vector<double> torque = step_torque(0.05, 500);
  torque.resize(1000, -0.05);
  torque.resize(2000, 0.0);
  return torque;
}

Simulation bang_bang_run(const char* formulation, const ArmParts& parts, std::size_t& samples) {
  const auto sensors = every_sensor();
  const AnyFormulation made = make_formulation(formulation, parts.linear, 10);
  const auto torque = bang_bang();
  samples = torque.size();
  return simulate(modal_model(made, 10, sensors, {}), parts, sensors, torque,
                  {.sample_time_s = 1e-3, .energy = false});
}

void expect_formulations_agree(const ArmParts& parts) {
  std::size_t samples = 0;
  const Simulation exact = bang_bang_run("exact_tf", parts, samples);
  ASSERT_EQ(exact.time_s.size(), samples);
  for (const char* name : {"fem", "assumed_modes"}) {
    const Simulation other = bang_bang_run(name, parts, samples);
    for (std::size_t j = 0; j < exact.channels.size(); ++j) {
      double peak = 0.0;
      double difference = 0.0;
      for (std::size_t k = 0; k < samples; ++k) {
        peak = std::max(peak, std::abs(exact.channels[j][k]));
        difference = std::max(difference, std::abs(exact.channels[j][k] - other.channels[j][k]));
      }
      EXPECT_LT(difference, kPhaseRounding * peak)
          << name << ", " << arm::to_string(every_sensor()[j]);
    }
  }
}

TEST(ThreeFormulations, RespondAlikeToBangBang) {
  ArmParts parts;
  parts.linear = arm::paper_arm();
  expect_formulations_agree(parts);
}

TEST(ThreeFormulations, RespondAlikeToBangBangWithCoulombFriction) {
  ArmParts parts;
  parts.linear = arm::paper_arm();
  parts.linear.damping.kelvin_voigt_s = 2e-5;
  put(parts, "coulomb_friction", {{"torque", 0.01}});
  expect_formulations_agree(parts);
}

TEST(StepCheckTest, ShowsRoundingForTheLinearArmAndTheErrorOfVaryingFriction) {
  const auto run = [](const ArmParts& parts) {
    const auto sensors = hub_sensors();
    const auto model = two_masses(0.01, 0.05, 3.0);
    const auto torque = step_torque(0.2, 200);
    const SimulationOptions options{.sample_time_s = 0.02};
    const auto made = simulate(model, parts, sensors, torque, options);
    const auto check = check_step(made, model, parts, sensors, torque, options);
    EXPECT_EQ(check.relative_difference.size(), 2U);
    return *std::ranges::max_element(check.relative_difference);
  };
  EXPECT_LT(run(coulomb(0.0)), 1e-12);
  ArmParts varying = coulomb(0.0);
  put(varying, "stribeck_friction", {{"torque", 0.05}, {"static_torque", 0.09}, {"velocity", 0.5}});
  EXPECT_GT(run(varying), 1e-12);
  EXPECT_LT(run(varying), 1e-4);
}

}  // namespace
}  // namespace flexarm::response
