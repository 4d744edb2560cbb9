#include "damped_roots.hpp"
#include "effects/registry/vocabulary.hpp"
#include "exact_tf/exact_arm.hpp"
#include "sample_arms.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <limits>
#include <vector>

namespace flexarm::exact_tf {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

/// Conjugates with Im > 0 first, or two real ones with the nearer to 0 first; none twice.
void expect_sound(const arm::DampedPoleSet& set, int count) {
  ASSERT_EQ(std::ssize(set.flexible), count);
  EXPECT_TRUE(set.summary.converged);
  auto pairs = set.flexible;
  pairs.push_back(set.lowest);
  for (const auto& [first, second] : pairs) {
    if (first.imag() == 0.0) {
      EXPECT_EQ(second.imag(), 0.0);
      EXPECT_LE(std::abs(first), std::abs(second));
    } else {
      EXPECT_GT(first.imag(), 0.0);
      EXPECT_EQ(second, std::conj(first));
    }
  }
  const auto roots = all_roots(set);
  for (std::size_t i = 0; i < roots.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (i == 1 && roots[0] == 0.0 && roots[1] == 0.0) continue;
      EXPECT_GT(std::abs(roots[i] - roots[j]), 1e-6 * std::abs(roots[i])) << i << ", " << j;
    }
  }
}

/// 1/G changes sign within a part of 1e-12 of s: |1/G(s)| against its value that part away.
void expect_poles_of(const ExactArm& exact, const arm::DampedPoleSet& set) {
  const arm::Sensor hub{arm::SensorKind::hub_angle};
  for (const auto& s : all_roots(set)) {
    if (s == 0.0) continue;
    constexpr double kPart = 1e-10;
    const double here = std::abs(1.0 / exact.transfer_function(hub, s));
    const double beside = std::abs(1.0 / exact.transfer_function(hub, s * (1.0 + kPart)));
    EXPECT_LE(here, 1e-4 * beside) << "s = " << s;
  }
}

TEST(DampedPoles, WithoutDampingAreTheUndampedOnes) {
  const ExactArm exact(unit_arm(0.1, 0.5, 0.02));
  const auto set = exact.damped_poles(8);
  expect_sound(set, 8);
  EXPECT_EQ(set.lowest.first_rad_per_s, 0.0);
  EXPECT_EQ(set.lowest.second_rad_per_s, 0.0);
  const auto omega = exact.poles(8).omega_rad_per_s;
  for (std::size_t i = 0; i < omega.size(); ++i) {
    EXPECT_EQ(set.flexible[i].first_rad_per_s, std::complex<double>(0.0, omega[i]));
  }
}

TEST(DampedPoles, WithKelvinVoigtDampingSolveTheirQuadratics) {
  // omega_i = lambda_i^2: from underdamped to far overdamped.
  const double kv = 2e-3;
  const ExactArm exact(unit_arm(0.1, 0.5, 0.02, kv));
  const auto set = exact.damped_poles(15);
  expect_sound(set, 15);
  const auto omega = exact.poles(15).omega_rad_per_s;
  EXPECT_LT(omega.front() * kv, 2.0);
  EXPECT_GT(omega.back() * kv, 2.0);
  for (std::size_t i = 0; i < omega.size(); ++i) {
    for (const auto s : {set.flexible[i].first_rad_per_s, set.flexible[i].second_rad_per_s}) {
      const double square = omega[i] * omega[i];
      EXPECT_LE(std::abs(s * s + kv * square * s + square),
                8.0 * kEpsilon * (std::norm(s) + kv * square * std::abs(s) + square));
    }
  }
  EXPECT_EQ(set.flexible.back().first_rad_per_s.imag(), 0.0);
}

class DampedPolesWithFriction : public testing::TestWithParam<double> {};

TEST_P(DampedPolesWithFriction, AreZerosOfTheInverseTransferFunction) {
  for (const double hub_inertia : {0.02, 0.1, 3.0}) {
    for (const double kv : {0.0, 1e-4, 4e-3}) {
      const ExactArm exact(unit_arm(hub_inertia, 0.5, 0.02, kv, GetParam()));
      const auto set = exact.damped_poles(12);
      SCOPED_TRACE(testing::Message() << "hub inertia " << hub_inertia << ", kv " << kv);
      expect_sound(set, 12);
      expect_poles_of(exact, set);
      EXPECT_EQ(set.lowest.first_rad_per_s, 0.0);
      EXPECT_LT(set.lowest.second_rad_per_s.real(), 0.0);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Frictions, DampedPolesWithFriction,
                         testing::Values(1e-3, 0.1, 1.0, 3.0, 30.0));

TEST(ModalModel, CouplesModesByHubFrictionAlone) {
  const ExactArm exact(unit_arm(0.1, 0.5, 0.02, 1e-3, 0.3));
  const std::vector<arm::Sensor> sensors = {{arm::SensorKind::hub_angle},
                                            {arm::SensorKind::tip_acceleration},
                                            {arm::SensorKind::tip_deflection}};
  const std::vector<double> stations_m = {0.0, 0.25, 1.0};
  const auto model = exact.modal_model(4, sensors, stations_m);
  ASSERT_EQ(model.modes.size(), 5U);
  ASSERT_EQ(model.damping_rad_per_s.size(), 25U);
  EXPECT_EQ(model.modal_mass_kg_m2, arm::total_inertia_kg_m2(exact.arm()));
  EXPECT_EQ(model.lowest_omega_squared_rad2_per_s2, 0.0);
  EXPECT_EQ(model.modes[0].sensor_values, (std::vector<double>{1.0, 1.0, 0.0}));
  EXPECT_EQ(model.modes[0].displacement_m, stations_m);
  const auto modes = exact.modes(4, sensors, stations_m);
  for (std::size_t i = 0; i < 5; ++i) {
    if (i > 0) {
      EXPECT_EQ(model.modes[i].omega_rad_per_s, modes[i - 1].omega_rad_per_s);
      EXPECT_EQ(model.modes[i].sensor_values, modes[i - 1].sensor_values);
    }
    for (std::size_t j = 0; j < 5; ++j) {
      const double omega = model.modes[i].omega_rad_per_s;
      const double expected =
          (i == j ? 1e-3 * omega * omega : 0.0) +
          0.3 * model.modes[i].hub_slope * model.modes[j].hub_slope / model.modal_mass_kg_m2;
      EXPECT_NEAR(model.damping_rad_per_s[5 * i + j], expected, 8.0 * kEpsilon * expected);
      EXPECT_EQ(model.damping_rad_per_s[5 * i + j], model.damping_rad_per_s[5 * j + i]);
    }
  }
}

/// The same numbers, once in the arm and once by its effects.
TEST(ExactArm, HonoursTheEffectsThatChangeNumbersOnly) {
  arm::Arm by_effects = unit_arm(0.1, 0.2, 0.01, 1e-4, 0.01);
  effects::put(by_effects, "hub_inertia", {{"factor", 2.0}});
  effects::put(by_effects, "flexural_rigidity", {{"factor", 0.5}});
  effects::put(by_effects, "linear_density", {{"factor", 4.0}});
  effects::put(by_effects, "payload_mass", {{"mass", 0.25}});
  effects::put(by_effects, "payload_inertia", {{"inertia", 0.03125}});
  effects::put(by_effects, "hub_viscous_friction", {{"coefficient", 0.25}});
  effects::put(by_effects, "structural_damping", {{"time", 1e-3}});
  arm::Arm by_numbers = by_effects;
  by_numbers.effects.clear();
  by_numbers.beam.given_flexural_rigidity_N_m2 = 0.5;
  by_numbers.beam.given_linear_density_kg_per_m = 4.0;
  by_numbers.hub = {0.2, 0.26};
  by_numbers.payload = {0.45, 0.04125};
  by_numbers.damping.kelvin_voigt_s = 1.1e-3;
  const ExactArm a(by_effects);
  const ExactArm b(by_numbers);
  EXPECT_EQ(a.poles(5).omega_rad_per_s, b.poles(5).omega_rad_per_s);
  const std::complex<double> s(-0.5, 3.0);
  for (const char* name : {"hub_angle", "tip_acceleration", "strain@0.25"}) {
    const auto sensor = arm::parse_sensor(name);
    EXPECT_EQ(a.zeros(sensor, 5).s_rad_per_s, b.zeros(sensor, 5).s_rad_per_s);
    const auto value = b.transfer_function(sensor, s);
    EXPECT_LE(std::abs(a.transfer_function(sensor, s) - value), 16.0 * kEpsilon * std::abs(value));
  }
}

}  // namespace
}  // namespace flexarm::exact_tf
