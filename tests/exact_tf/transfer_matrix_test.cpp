#include "arm/input_error.hpp"
#include "effect_arms.hpp"
#include "effects/registry/vocabulary.hpp"
#include "exact_tf/chain_count.hpp"
#include "exact_tf/chain_eigenvalues.hpp"
#include "exact_tf/exact_arm.hpp"
#include "exact_tf/plain_arm.hpp"
#include "exact_tf/root_count.hpp"
#include "exact_tf/transfer_matrix_arm.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace flexarm::exact_tf {
namespace {

std::vector<arm::Sensor> all_sensors() {
  std::vector<arm::Sensor> sensors;
  for (const char* name :
       {"hub_angle", "hub_velocity", "tip_acceleration", "tip_displacement", "tip_deflection"}) {
    sensors.push_back(arm::parse_sensor(name));
  }
  for (const double part : {0.0, 0.05, 0.31, 0.95}) {
    sensors.push_back({arm::SensorKind::strain, part});
  }
  return sensors;
}

double relative(std::complex<double> found, std::complex<double> wanted) {
  return std::abs(found - wanted) / std::abs(wanted);
}

/// Two ways to the same numbers: closed forms and transfer matrices, on plain arms of length 1 (the
/// paper's arm apart).
class PlainArmByTransferMatrices : public testing::TestWithParam<arm::Arm> {
 protected:
  arm::LinearArm linear_ = linear_arm(GetParam());
  PlainArm closed_{linear_};
  TransferMatrixArm segments_{linear_};
};

TEST_P(PlainArmByTransferMatrices, HasTheSamePolesAndZeros) {
  constexpr int kCount = 20;
  const auto wanted = closed_.poles(kCount);
  const auto found = segments_.poles(kCount);
  EXPECT_EQ(found.count.found, kCount);
  EXPECT_EQ(found.count.expected, kCount);
  EXPECT_EQ(found.lowest_omega_squared_rad2_per_s2, 0.0);
  for (std::size_t i = 0; i < kCount; ++i) {
    EXPECT_LE(relative(found.omega_rad_per_s[i], wanted.omega_rad_per_s[i]), kRelativeTolerance);
  }
  for (const auto& sensor : all_sensors()) {
    const auto closed = closed_.zeros(sensor, kCount);
    const auto zeros = segments_.zeros(sensor, kCount);
    EXPECT_EQ(zeros.count.found, kCount);
    EXPECT_EQ(zeros.count.expected, kCount);
    EXPECT_TRUE(zeros.summary.converged);
    for (std::size_t i = 0; i < kCount; ++i) {
      EXPECT_LE(relative(zeros.s_rad_per_s[i], closed.s_rad_per_s[i]), kRelativeTolerance)
          << to_string(sensor) << ", zero " << i + 1;
    }
  }
}

TEST_P(PlainArmByTransferMatrices, HasTheSameTransferFunction) {
  const auto sensors = all_sensors();
  for (const double size : {1e-3, 1.0, 30.0, 1e3, 1e5}) {
    for (const std::complex<double> s :
         {std::complex(0.0, size), std::complex(-0.3 * size, size), std::complex(size, 0.1)}) {
      const auto wanted = closed_.transfer_functions(sensors, s);
      const auto found = segments_.transfer_functions(sensors, s);
      ASSERT_EQ(found.size(), sensors.size());
      for (std::size_t j = 0; j < sensors.size(); ++j) {
        // Where the sensor hears next to nothing of the torque both lose what they cannot know.
        if (std::abs(wanted[j]) < 1e-280) continue;
        EXPECT_LE(relative(found[j], wanted[j]), kRelativeTolerance)
            << to_string(sensors[j]) << " at s = " << s;
      }
    }
  }
}

TEST_P(PlainArmByTransferMatrices, HasTheSameModalModel) {
  constexpr int kCount = 12;
  const auto sensors = all_sensors();
  const std::vector<double> stations_m = {0.0, 0.2, 0.9};
  const auto wanted = closed_.modal_model(kCount, sensors, stations_m);
  const auto found = segments_.modal_model(kCount, sensors, stations_m);
  ASSERT_EQ(found.modes.size(), wanted.modes.size());
  EXPECT_EQ(found.modal_mass_kg_m2, wanted.modal_mass_kg_m2);
  for (std::size_t i = 0; i < found.modes.size(); ++i) {
    const double omega = wanted.modes[i].omega_rad_per_s;
    EXPECT_NEAR(found.modes[i].omega_rad_per_s, omega, kRelativeTolerance * omega);
    EXPECT_NEAR(found.modes[i].damping_ratio, wanted.modes[i].damping_ratio,
                kRelativeTolerance * wanted.modes[i].damping_ratio);
    for (std::size_t k = 0; k < sensors.size(); ++k) {
      // EI int psi'^2 dx = omega^2 I_T; at the root without hub inertia the strain is 0.
      const double value = wanted.modes[i].sensor_values[k];
      const double size = sensors[k].kind == arm::SensorKind::strain
                              ? 0.5 * *linear_.thickness_m * omega *
                                    std::sqrt(wanted.modal_mass_kg_m2 /
                                              (linear_.flexural_rigidity_N_m2 * linear_.length_m))
                              : std::abs(value);
      EXPECT_NEAR(found.modes[i].sensor_values[k], value, kRelativeTolerance * size)
          << to_string(sensors[k]) << ", mode " << i;
    }
    for (std::size_t k = 0; k < stations_m.size(); ++k) {
      EXPECT_NEAR(found.modes[i].displacement_m[k], wanted.modes[i].displacement_m[k],
                  kRelativeTolerance * std::max(1.0, std::abs(wanted.modes[i].sensor_values[2])));
    }
  }
  for (std::size_t i = 0; i < found.modes.size(); ++i) {
    for (std::size_t j = 0; j < found.modes.size(); ++j) {
      const auto entry = i * found.modes.size() + j;
      const double diagonal = std::max(wanted.damping_rad_per_s[i * (found.modes.size() + 1)],
                                       wanted.damping_rad_per_s[j * (found.modes.size() + 1)]);
      EXPECT_NEAR(found.damping_rad_per_s[entry], wanted.damping_rad_per_s[entry],
                  kRelativeTolerance * diagonal);
    }
  }
}

TEST_P(PlainArmByTransferMatrices, CountsTheSameRootsBelowAnyFrequency) {
  const auto units = in_beam_units<Real>(linear_);
  const auto ratios = inertia_ratios(linear_);
  for (int i = 1; i < 3000; ++i) {
    const Real lambda = 0.0171L * i;
    const Real z = lambda * lambda * lambda * lambda;
    const auto count = count_below(TransferChain<Real>(units, undamped_at(units, z)));
    ASSERT_EQ(count.hub_held, count_hub_zeros_below(ratios, lambda)) << lambda;
    ASSERT_EQ(count.poles - 1, count_poles_below(ratios, lambda)) << lambda;
  }
}

std::vector<arm::Arm> plain_arms() {
  auto arms = undamped_arms();
  arms.push_back(unit_arm(0.1, 0.5, 0.02, 1e-3, 0.2));
  return arms;
}

INSTANTIATE_TEST_SUITE_P(Arms, PlainArmByTransferMatrices, testing::ValuesIn(plain_arms()),
                         [](const auto& each) { return "arm" + std::to_string(each.index); });

TEST(TransferMatrices, FindTheDampedPolesOfTheClosedForm) {
  const auto linear = linear_arm(unit_arm(0.1, 0.5, 0.02, 1e-3, 0.2));
  const auto wanted = PlainArm(linear).damped_poles(12);
  const auto found = TransferMatrixArm(linear).damped_poles(12);
  EXPECT_TRUE(found.summary.converged);
  EXPECT_LE(relative(found.lowest.second_rad_per_s, wanted.lowest.second_rad_per_s),
            kRelativeTolerance);
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_LE(relative(found.flexible[i].first_rad_per_s, wanted.flexible[i].first_rad_per_s),
              kRelativeTolerance);
  }
}

class ArmWithEffects : public testing::TestWithParam<arm::Arm> {};

TEST_P(ArmWithEffects, HasEveryRootOfItsCount) {
  const ExactArm exact(GetParam());
  const auto units = in_beam_units<Real>(exact.linear());
  constexpr int kCount = 60;
  const auto poles = find_chain_poles(units, kCount);
  const auto zeros = find_chain_hub_zeros(units, kCount + 1);
  EXPECT_EQ(poles.count.found, kCount);
  EXPECT_EQ(poles.count.expected, kCount);
  EXPECT_EQ(zeros.count.expected, kCount + 1);
  // Poles and zeros of a collocated sensor interlace, the lowest pole first.
  for (std::size_t i = 0; i <= kCount; ++i) {
    EXPECT_LT(poles.omega_squared[i], zeros.omega_squared[i]);
    if (i > 0) {
      EXPECT_LT(zeros.omega_squared[i - 1], poles.omega_squared[i]);
    }
  }
  // The count steps at each root and nowhere else.
  std::size_t passed_poles = 1;
  std::size_t passed_zeros = 0;
  for (int i = 1; i < 4000; ++i) {
    const Real lambda = 0.02003L * i;
    const Real square = lambda * lambda * lambda * lambda;
    while (passed_poles <= kCount && poles.omega_squared[passed_poles] < square) ++passed_poles;
    while (passed_zeros <= kCount && zeros.omega_squared[passed_zeros] < square) ++passed_zeros;
    if (passed_poles > kCount || passed_zeros > kCount) break;
    if (poles.omega_squared[0] >= square) continue;
    const auto count = count_below(TransferChain<Real>(units, undamped_at(units, square)));
    ASSERT_EQ(count.poles, static_cast<int>(passed_poles)) << lambda;
    ASSERT_EQ(count.hub_held, static_cast<int>(passed_zeros)) << lambda;
  }
}

TEST_P(ArmWithEffects, HasZerosAtWhichTheSensorIsStill) {
  // The undamped arm.
  arm::Arm arm = GetParam();
  arm.damping.kelvin_voigt_s = 0.0;
  arm.hub.viscous_friction_N_m_s_per_rad = 0.0;
  const std::vector<std::pair<std::string, std::string>> dampings = {
      {"air_damping", "coefficient"},
      {"drive_compliance", "time"},
      {"root_damping", "time"},
      {"tuned_mass", "damping_ratio"}};
  for (const auto& [name, parameter] : dampings) {
    if (arm.effects.contains(name)) effects::put(arm, name, {{parameter, 0.0}});
  }
  const ExactArm exact(arm);
  constexpr int kCount = 10;
  for (const auto& sensor : all_sensors()) {
    const auto set = exact.zeros(sensor, kCount);
    ASSERT_EQ(std::ssize(set.s_rad_per_s), kCount) << to_string(sensor);
    EXPECT_TRUE(set.summary.converged) << to_string(sensor);
    EXPECT_EQ(set.count.expected, kCount);
    for (const auto& s : set.s_rad_per_s) {
      // H changes by its own size over 1e-3 s; a rounding of s is 1e-13 of that.
      const double step = 1e-3;
      const auto scale = std::max(std::abs(exact.transfer_function(sensor, s * (1.0 - step))),
                                  std::abs(exact.transfer_function(sensor, s * (1.0 + step))));
      EXPECT_LE(std::abs(exact.transfer_function(sensor, s)), 1e-10 * scale)
          << to_string(sensor) << " at s = " << s;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Arms, ArmWithEffects, testing::ValuesIn(arms_without_closed_form()),
                         [](const auto& each) { return "arm" + std::to_string(each.index); });

TEST(TransferMatrices, ReachHighModesWithoutOverflow) {
  const arm::Arm arm = with_effect(with_effect(stubby_arm(0.1, 0.5, 0.02), "local_stiffness_loss",
                                               {{"position", 0.37}, {"stiffness", 2.0}}),
                                   "root_compliance", {{"stiffness", 5.0}});
  const ExactArm exact(arm);
  constexpr int kCount = 200;
  const auto poles = exact.poles(kCount);
  EXPECT_EQ(poles.count.found, kCount);
  EXPECT_EQ(poles.count.expected, kCount);
  EXPECT_TRUE(poles.summary.converged);
  const std::vector<arm::Sensor> sensors = {{arm::SensorKind::tip_displacement},
                                            {arm::SensorKind::strain, 0.0}};
  const auto last = exact.modes(kCount, sensors, {}).back();
  // Between the soft root and the tip a high mode is a wave of an amplitude that its mass sets.
  const double inertia = arm::total_inertia_kg_m2(arm);
  const double omega = last.omega_rad_per_s;
  EXPECT_LT(std::abs(last.sensor_values[0]), 3.0 * std::sqrt(inertia));
  // M(0) = -Ih omega^2 theta, and strain = thickness/2 psi'.
  EXPECT_NEAR(last.sensor_values[1] / (0.1 * (-0.1 * omega * omega * last.hub_slope)), 1.0, 1e-12);
  EXPECT_TRUE(std::isfinite(
      std::abs(exact.transfer_function({arm::SensorKind::tip_displacement}, {1e7, 1e7}))));
}

TEST(TransferMatrices, SayWhatTheyCannotAnswer) {
  const arm::Arm soft = with_effect(unit_arm(0.1, 0.0, 0.0), "root_compliance", {{"stiffness", 5}});
  const ExactArm exact(soft);
  EXPECT_THROW(exact.poles(TransferMatrixArm::kMostRoots + 1), arm::InputError);
  EXPECT_THROW(exact.transfer_function({arm::SensorKind::hub_angle}, 0.0), std::domain_error);
  try {
    exact.pole_lambdas(3);
    ADD_FAILURE() << "a closed form was found";
  } catch (const arm::InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("root_compliance"));
  }
}

TEST(TransferMatrices, RefuseAStandingArmThatBuckles) {
  const auto standing = [](double acceleration) {
    return with_effect(unit_arm(0.1, 0.0, 0.0), "gravity", {{"acceleration", acceleration}});
  };
  EXPECT_NO_THROW(ExactArm{standing(-15.0)});
  try {
    ExactArm{standing(-60.0)};
    ADD_FAILURE() << "a buckled beam was accepted";
  } catch (const arm::InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("effects.gravity.acceleration = -60 m/s^2"));
    EXPECT_THAT(error.what(), testing::HasSubstr("buckling limit"));
  }
}

}  // namespace
}  // namespace flexarm::exact_tf
