#include "laws/subjects.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <vector>

namespace flexarm::laws {
namespace {

using arm::Arm;
using arm::Sensor;
using arm::SensorKind;
using Complex = std::complex<double>;

constexpr Sensor kTipDisplacement{SensorKind::tip_displacement, 0.0};
constexpr Sensor kTipDeflection{SensorKind::tip_deflection, 0.0};

class ResponseLaws : public testing::TestWithParam<Subject> {
 protected:
  Complex response(const Arm& arm, const Sensor& sensor, Complex s) const {
    return response::transfer_function(GetParam().make(arm), sensor, s);
  }
};

std::vector<Arm> damped_arms() {
  auto arms = varied_arms();
  for (auto& arm : arms) {
    arm.damping.kelvin_voigt_s = 1.2e-4;
    arm.hub.viscous_friction_N_m_s_per_rad = 2e-3;
  }
  return arms;
}

void expect_close(Complex actual, Complex expected, double tolerance) {
  EXPECT_LE(std::abs(actual - expected), tolerance * std::abs(expected))
      << actual << " instead of " << expected;
}

TEST_P(ResponseLaws, SlowMotionIsThatOfTheRigidArm) {
  for (const auto& arm : varied_arms()) {
    const double inertia = arm::total_inertia_kg_m2(arm);
    const Complex s(0.0, 1e-3);
    // The next term is of the order (s/omega_1)^2, below 1e-8 here.
    constexpr double kSecondTerm = 1e-7;
    expect_close(response(arm, kHubAngle, s) * s * s, 1.0 / inertia, kSecondTerm);
    expect_close(response(arm, kTipAcceleration, s), arm.beam.length_m / inertia, kSecondTerm);
  }
}

TEST_P(ResponseLaws, HubFrictionAloneTurnsTheRigidArmIntoAFirstOrderLag) {
  for (const auto& arm : damped_arms()) {
    const double inertia = arm::total_inertia_kg_m2(arm);
    const double friction = arm.hub.viscous_friction_N_m_s_per_rad;
    const Complex s(0.0, friction / inertia);
    constexpr double kSecondTerm = 1e-5;
    expect_close(response(arm, kHubVelocity, s), 1.0 / (inertia * s + friction), kSecondTerm);
  }
}

TEST_P(ResponseLaws, SensorsAreEachOthersDerivativesAndDifferences) {
  for (const auto& arm : damped_arms()) {
    const Complex s(-1.0, 45.0);
    const Complex angle = response(arm, kHubAngle, s);
    const Complex tip = response(arm, kTipDisplacement, s);
    // Rounding of a solve with a condition of some thousands.
    constexpr double kRounding = 1e-11;
    expect_close(response(arm, kHubVelocity, s), s * angle, kRounding);
    expect_close(response(arm, kTipAcceleration, s), s * s * tip, kRounding);
    expect_close(response(arm, kTipDeflection, s), tip - arm.beam.length_m * angle, kRounding);
  }
}

TEST_P(ResponseLaws, ARealSystemAnswersConjugatedAtTheConjugate) {
  for (const auto& arm : damped_arms()) {
    for (const auto& sensor : {kHubAngle, kTipAcceleration, Sensor{SensorKind::strain, 0.25}}) {
      const Complex s(2.0, 130.0);
      constexpr double kRounding = 1e-13;
      expect_close(response(arm, sensor, std::conj(s)), std::conj(response(arm, sensor, s)),
                   kRounding);
    }
  }
}

TEST_P(ResponseLaws, ADampedArmTakesPowerFromTheMotorAtEveryFrequency) {
  for (const auto& arm : damped_arms()) {
    for (double f = 0.3; f < 60.0; f *= 1.31) {
      const Complex s(0.0, 2.0 * std::numbers::pi * f);
      EXPECT_GT(response(arm, kHubVelocity, s).real(), 0.0) << f << " Hz";
    }
  }
}

TEST_P(ResponseLaws, AnUndampedArmTakesNoPower) {
  for (const auto& arm : varied_arms()) {
    const Complex velocity = response(arm, kHubVelocity, {0.0, 40.0});
    EXPECT_LE(std::abs(velocity.real()), 1e-12 * std::abs(velocity));
  }
}

TEST_P(ResponseLaws, StrainAtTheRootIsTheMomentTheHubPassesOn) {
  // EI y''(0) = Ih s^2 theta - tau on the undamped arm.
  for (const auto& arm : varied_arms()) {
    const Complex s(3.0, 50.0);
    const Complex moment = arm.hub.inertia_kg_m2 * s * s * response(arm, kHubAngle, s) - 1.0;
    const double to_strain = *arm.beam.thickness_m / 2.0 / arm.beam.flexural_rigidity_N_m2();
    // y'' of a cubic element's end is of second order in h: (lambda h)^2 at 200 elements.
    const double tolerance = GetParam().root_tolerance > 1e-9 ? 1e-3 : 1e-7;
    expect_close(response(arm, {SensorKind::strain, 0.0}, s), to_strain * moment, tolerance);
  }
}

TEST_P(ResponseLaws, PartialFractionsWithManyModesTendToTheExactValue) {
  Arm arm = varied_arms()[2];
  const Complex s(1.0, 60.0);
  const double inertia = arm::total_inertia_kg_m2(arm);
  const auto model = GetParam().make(arm);
  const std::vector<Sensor> sensors = {kHubAngle, kTipDisplacement};
  const auto modes = response::modes(model, 12, sensors, {});
  for (std::size_t k = 0; k < sensors.size(); ++k) {
    const double rigid = k == 0 ? 1.0 : arm.beam.length_m;
    const Complex exact = response::transfer_function(model, sensors[k], s);
    Complex sum = rigid / (inertia * s * s);
    double before = std::abs(sum - exact);
    for (std::size_t i = 0; i < modes.size(); ++i) {
      sum += modes[i].sensor_values[k] * modes[i].hub_slope /
             (inertia * (s * s + modes[i].omega_rad_per_s * modes[i].omega_rad_per_s));
      if (i == 3) before = std::abs(sum - exact);
    }
    // Terms fall as omega_n^-2 ~ n^-4 (hub slopes fall with a payload's inertia): from 4 modes to
    // 12 the rest falls by 3^3 = 27 or more.
    EXPECT_LT(std::abs(sum - exact), before / 20.0);
    EXPECT_LT(std::abs(sum - exact), 1e-3 * std::abs(exact));
  }
}

/// A shape of the arm: its values at equal distances from root to tip, and its slopes at the ends.
struct Shape {
  std::vector<double> y_m;
  double hub_slope = 0.0;
  double tip_slope = 0.0;
};

/// int m a b dx + Ih a'(0) b'(0) + Mp a(l) b(l) + Ip a'(l) b'(l), by Simpson's rule.
double modal_mass(const Arm& arm, const Shape& a, const Shape& b) {
  const std::size_t n = a.y_m.size() - 1;
  double sum = 0.0;
  for (std::size_t i = 0; i <= n; ++i) {
    const bool end = i == 0 || i == n;
    sum += (end ? 1.0 : (i % 2 == 1 ? 4.0 : 2.0)) * a.y_m[i] * b.y_m[i];
  }
  const double h = arm.beam.length_m / static_cast<double>(n);
  return arm.beam.linear_density_kg_per_m() * sum * h / 3.0 +
         arm.hub.inertia_kg_m2 * a.hub_slope * b.hub_slope +
         arm.payload.mass_kg * a.y_m[n] * b.y_m[n] +
         arm.payload.inertia_kg_m2 * a.tip_slope * b.tip_slope;
}

TEST_P(ResponseLaws, ModesAndTheRigidRotationAreOrthogonalWithTheModalMassOfTheRigidArm) {
  constexpr std::size_t kIntervals = 2000;
  for (const auto& arm : varied_arms()) {
    const double h = arm.beam.length_m / static_cast<double>(kIntervals);
    std::vector<double> stations;
    for (std::size_t i = 0; i < kIntervals; ++i) stations.push_back(h * static_cast<double>(i));
    stations.push_back(arm.beam.length_m);

    std::vector<Shape> shapes = {{stations, 1.0, 1.0}};
    for (const auto& mode : response::modes(GetParam().make(arm), 3, {}, stations)) {
      EXPECT_GT(mode.hub_slope, 0.0);
      const auto& y = mode.displacement_m;
      const std::size_t n = kIntervals;
      // Third-order one-sided difference.
      const double tip_slope =
          (11.0 * y[n] - 18.0 * y[n - 1] + 9.0 * y[n - 2] - 2.0 * y[n - 3]) / (6.0 * h);
      shapes.push_back({y, mode.hub_slope, tip_slope});
    }
    const double inertia = arm::total_inertia_kg_m2(arm);
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      for (std::size_t j = 0; j <= i; ++j) {
        // Simpson: (lambda h)^4/180, below 1e-8; the discrete shapes' own error beside it.
        EXPECT_NEAR(modal_mass(arm, shapes[i], shapes[j]) / inertia, i == j ? 1.0 : 0.0,
                    1e-7 + 100.0 * GetParam().root_tolerance)
            << "shapes " << i << " and " << j;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(EveryFormulation, ResponseLaws, testing::ValuesIn(every_formulation()),
                         [](const auto& subject) { return subject.param.name; });

}  // namespace
}  // namespace flexarm::laws
