#include "damped_roots.hpp"
#include "effect_arms.hpp"
#include "arm/linear_arm.hpp"
#include "exact_tf/exact_arm.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <limits>
#include <vector>

namespace flexarm::exact_tf {
namespace {

using arm::SensorKind;

const arm::Sensor kTipDisplacement{SensorKind::tip_displacement};

constexpr int kModes = 10;
/// Relative to the larger diagonal entry: the rounding of sums of some thousand terms.
constexpr double kRounding = 1e-12;

/// A slender arm with the effects whose energies the sensors show.
arm::Arm sprung_arm() {
  arm::Arm arm = unit_arm(0.1, 0.5, 0.0);
  arm = with_effect(arm, "hub_radius", {{"radius", 0.2}});
  arm = with_effect(arm, "root_compliance", {{"stiffness", 8.0}});
  arm = with_effect(arm, "local_stiffness_loss", {{"position", 0.3}, {"stiffness", 3.0}});
  return with_effect(arm, "hub_spring", {{"stiffness", 0.7}});
}

double entry(const arm::ModalModel& model, std::size_t i, std::size_t j) {
  return model.damping_rad_per_s[i * model.modes.size() + j];
}

TEST(EffectModes, AreOrthogonalInTheMassThatAirDampingShows) {
  // With air damping alone D_ij I_T/ca is int phi_i phi_j dx; m = 1.
  constexpr double kAir = 0.25;
  const ExactArm exact(with_effect(sprung_arm(), "air_damping", {{"coefficient", kAir}}));
  const std::vector<arm::Sensor> sensors = {kHub, kTipDisplacement};
  const auto model = exact.modal_model(kModes, sensors, {});
  const double inertia = model.modal_mass_kg_m2;
  for (std::size_t i = 0; i < model.modes.size(); ++i) {
    for (std::size_t j = 0; j < model.modes.size(); ++j) {
      const auto& a = model.modes[i].sensor_values;
      const auto& b = model.modes[j].sensor_values;
      const double mass =
          entry(model, i, j) * inertia / kAir + 0.1 * a[0] * b[0] + 0.5 * a[1] * b[1];
      EXPECT_NEAR(mass / inertia, i == j ? 1.0 : 0.0, kRounding) << i << ", " << j;
    }
  }
}

TEST(EffectModes, AreOrthogonalInTheEnergyThatKelvinVoigtDampingShows) {
  // With it alone D_ij I_T/kv is EI int psi_i' psi_j' dx; springs hold the rest of
  // omega_i^2 I_T delta_ij.
  constexpr double kKelvinVoigt = 1e-4;
  arm::Arm arm = sprung_arm();
  arm.damping.kelvin_voigt_s = kKelvinVoigt;
  const ExactArm exact(arm);
  const std::vector<arm::Sensor> sensors = {
      kHub, {SensorKind::strain, 0.0}, {SensorKind::strain, 0.3}};
  const auto model = exact.modal_model(kModes, sensors, {});
  const double inertia = model.modal_mass_kg_m2;
  for (std::size_t i = 0; i < model.modes.size(); ++i) {
    for (std::size_t j = 0; j < model.modes.size(); ++j) {
      const auto& a = model.modes[i].sensor_values;
      const auto& b = model.modes[j].sensor_values;
      const double energy = entry(model, i, j) * inertia / kKelvinVoigt + 0.7 * a[0] * b[0] +
                            a[1] * b[1] / 8.0 + a[2] * b[2] / 3.0;
      const double size = model.modes[i].omega_rad_per_s * model.modes[j].omega_rad_per_s * inertia;
      EXPECT_NEAR(energy / size, i == j ? 1.0 : 0.0, kRounding) << i << ", " << j;
    }
  }
}

TEST(EffectModes, OfAFreeArmStartWithItsRotation) {
  arm::Arm arm =
      with_effect(stubby_arm(0.1, 0.5, 0.02, 0.0, 0.05), "hub_radius", {{"radius", 0.2}});
  arm = with_effect(arm, "air_damping", {{"coefficient", 0.3}});
  const std::vector<double> stations_m = {0.0, 0.4, 1.0};
  const std::vector<arm::Sensor> sensors = {
      kHub, kTipDisplacement, {SensorKind::tip_deflection}, {SensorKind::strain, 0.3}};
  const auto model = ExactArm(arm).modal_model(2, sensors, stations_m);
  const auto& rigid = model.modes[0];
  EXPECT_EQ(rigid.omega_rad_per_s, 0.0);
  EXPECT_EQ(rigid.damping_ratio, 0.0);
  EXPECT_NEAR(rigid.hub_slope, 1.0, kRounding);
  EXPECT_NEAR(rigid.sensor_values[1], 1.2, kRounding);
  EXPECT_NEAR(rigid.sensor_values[2], 0.0, kRounding);
  EXPECT_NEAR(rigid.sensor_values[3], 0.0, kRounding);
  for (std::size_t k = 0; k < stations_m.size(); ++k) {
    EXPECT_NEAR(rigid.displacement_m[k], 0.2 + stations_m[k], kRounding);
  }
  // c + ca int (a + x)^2 dx over I_T.
  const double air = 0.3 * (std::pow(1.2, 3) - std::pow(0.2, 3)) / 3.0;
  EXPECT_NEAR(entry(model, 0, 0) * model.modal_mass_kg_m2, 0.05 + air, kRounding);
}

/// The modes' answer at s: (s^2 + D s + Omega^2) q = theta/I_T, by Gauss's elimination with
/// pivoting.
std::complex<double> modal_sum(const arm::ModalModel& model, std::complex<double> s,
                               std::size_t sensor) {
  const std::size_t n = model.modes.size();
  std::vector<std::vector<std::complex<double>>> m(n, std::vector<std::complex<double>>(n + 1));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) m[i][j] = s * entry(model, i, j);
    const double omega = model.modes[i].omega_rad_per_s;
    m[i][i] += s * s + (i == 0 ? model.lowest_omega_squared_rad2_per_s2 : omega * omega);
    m[i][n] = model.modes[i].hub_slope / model.modal_mass_kg_m2;
  }
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < n; ++i) {
      if (std::abs(m[i][k]) > std::abs(m[pivot][k])) pivot = i;
    }
    std::swap(m[k], m[pivot]);
    for (std::size_t i = k + 1; i < n; ++i) {
      const auto factor = m[i][k] / m[k][k];
      for (std::size_t j = k; j <= n; ++j) m[i][j] -= factor * m[k][j];
    }
  }
  std::complex<double> sum = 0.0;
  std::vector<std::complex<double>> q(n);
  for (std::size_t i = n; i-- > 0;) {
    q[i] = m[i][n];
    for (std::size_t j = i + 1; j < n; ++j) q[i] -= m[i][j] * q[j];
    q[i] /= m[i][i];
    sum += q[i] * model.modes[i].sensor_values[sensor];
  }
  return sum;
}

class EffectModalModel : public testing::TestWithParam<arm::Arm> {};

TEST_P(EffectModalModel, AnswersAsTheTransferFunctionDoes) {
  const ExactArm exact(GetParam());
  const std::vector<arm::Sensor> sensors = {kHub, kTipDisplacement, {SensorKind::tip_deflection}};
  const auto half = exact.modal_model(30, sensors, {});
  const auto model = exact.modal_model(60, sensors, {});
  // The tail behind 60 modes: at a root that loses energy the moment has another phase than in any
  // mode, beside a much smaller response of the tip near its zero.
  const double figure = arm::linear_arm(GetParam()).root_retardation_s > 0.0 ? 2e-4 : 2e-5;
  for (const std::complex<double> s : {std::complex(-0.2, 1.3), {0.0, 9.0}, {0.5, 0.0}}) {
    for (std::size_t k = 0; k < sensors.size(); ++k) {
      const auto wanted = exact.transfer_function(sensors[k], s);
      // Kelvin-Voigt damping beside springs that lose nothing gives the moment at the spring
      // another phase than any mode has: the tail then falls as 1/n, otherwise faster.
      const double coarse = std::abs(modal_sum(half, s, k) - wanted);
      const double error = std::abs(modal_sum(model, s, k) - wanted);
      EXPECT_LE(error, figure * std::abs(wanted)) << to_string(sensors[k]) << " at s = " << s;
      EXPECT_LE(error, 0.6 * coarse + 1e-11 * std::abs(wanted))
          << to_string(sensors[k]) << " at s = " << s;
    }
  }
}

TEST_P(EffectModalModel, HasTheDampedPolesOfTheTransferFunction) {
  const ExactArm exact(GetParam());
  const auto set = exact.damped_poles(kModes);
  EXPECT_TRUE(set.summary.converged);
  ASSERT_EQ(std::ssize(set.flexible), kModes);
  const auto roots = all_roots(set);
  for (std::size_t i = 0; i < roots.size(); ++i) {
    if (roots[i] == 0.0) {
      EXPECT_TRUE(exact.linear().turns_freely());
      EXPECT_EQ(i, 0U);
      continue;
    }
    // 1/G here against its value a part of 1e-10 away.
    constexpr double kPart = 1e-10;
    const double here = std::abs(1.0 / exact.transfer_function(kHub, roots[i]));
    const double beside = std::abs(1.0 / exact.transfer_function(kHub, roots[i] * (1.0 + kPart)));
    EXPECT_LE(here, 1e-4 * beside) << "s = " << roots[i];
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_GT(std::abs(roots[i] - roots[j]), 1e-6 * std::abs(roots[i])) << i << ", " << j;
    }
  }
}

TEST_P(EffectModalModel, DampingRatiosAreTheProjectedOnesOfLightDamping) {
  const ExactArm exact(GetParam());
  const auto model = exact.modal_model(3, {}, {});
  const auto set = exact.damped_poles(3);
  for (std::size_t i = 1; i < model.modes.size(); ++i) {
    const double omega = model.modes[i].omega_rad_per_s;
    const double projected = entry(model, i, i);
    EXPECT_NEAR(model.modes[i].damping_ratio, projected / (2.0 * omega), 1e-15);
    // Coupling enters to second order.
    EXPECT_NEAR(-2.0 * set.flexible[i - 1].first_rad_per_s.real(), projected,
                projected * projected / omega * 4.0 + 0.05 * projected);
  }
}

INSTANTIATE_TEST_SUITE_P(Arms, EffectModalModel, testing::ValuesIn(arms_without_closed_form()),
                         [](const auto& each) { return "arm" + std::to_string(each.index); });

TEST(EffectModes, OfAHeldArmAnswerAtRest) {
  const ExactArm exact(sprung_arm());
  EXPECT_NEAR(exact.transfer_function(kHub, 0.0).real(), 1.0 / 0.7, kRounding);
  EXPECT_NEAR(exact.transfer_function(kTipDisplacement, 0.0).real(), 1.2 / 0.7, kRounding);
  EXPECT_EQ(exact.transfer_function({SensorKind::tip_acceleration}, 0.0), 0.0);
  EXPECT_NEAR(std::abs(exact.transfer_function({SensorKind::tip_deflection}, 0.0)), 0.0, kRounding);
  EXPECT_NEAR(std::abs(exact.transfer_function({SensorKind::strain, 0.4}, 0.0)), 0.0, kRounding);
}

TEST(EffectModes, DampedPolesOfStrongHubSpringsAndFrictionsAreFollowed) {
  for (const double stiffness : {1e-3, 0.7, 50.0}) {
    for (const double friction : {0.01, 1.0, 20.0}) {
      arm::Arm arm = unit_arm(0.1, 0.5, 0.02, 1e-3, friction);
      arm = with_effect(arm, "hub_spring", {{"stiffness", stiffness}});
      arm = with_effect(arm, "air_damping", {{"coefficient", 0.5}});
      SCOPED_TRACE(testing::Message() << "stiffness " << stiffness << ", friction " << friction);
      const ExactArm exact(arm);
      const auto set = exact.damped_poles(kModes);
      EXPECT_TRUE(set.summary.converged);
      for (const auto& s : all_roots(set)) {
        constexpr double kPart = 1e-10;
        EXPECT_LT(s.real(), 0.0);
        EXPECT_LE(std::abs(1.0 / exact.transfer_function(kHub, s)),
                  1e-4 * std::abs(1.0 / exact.transfer_function(kHub, s * (1.0 + kPart))));
      }
    }
  }
}

}  // namespace
}  // namespace flexarm::exact_tf
