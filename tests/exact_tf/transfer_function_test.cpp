#include "arm/input_error.hpp"
#include "ball.hpp"
#include "effects/registry/vocabulary.hpp"
#include "exact_tf/complex_frequency.hpp"
#include "exact_tf/exact_arm.hpp"
#include "sample_arms.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace flexarm::exact_tf {
namespace {

using arm::Sensor;
using arm::SensorKind;

/// The response of a sensor to a torque of 1 at s, in balls: the boundary conditions of
/// arm/arm.hpp as a linear system for
///     y = c1 exp(i u x) + c2 exp(i u (l - x)) + c3 exp(-u x) + c4 exp(-u (l - x)),
/// u^4 = -m s^2/kappa, solved at a precision that absorbs its condition.
class BoundaryValueProblem {
 public:
  BoundaryValueProblem(const arm::Arm& arm, const Ball& s) : l_(arm.beam.length_m) {
    const Ball kappa = Ball(arm.beam.flexural_rigidity_N_m2()) *
                       (Ball(1.0) + Ball(arm.damping.kelvin_voigt_s) * s);
    u_ = sqrt(sqrt(-Ball(arm.beam.linear_density_kg_per_m()) * s * s / kappa));
    const Ball hub =
        Ball(arm.hub.inertia_kg_m2) * s * s + Ball(arm.hub.viscous_friction_N_m_s_per_rad) * s;
    const Ball mass = Ball(arm.payload.mass_kg) * s * s;
    const Ball inertia = Ball(arm.payload.inertia_kg_m2) * s * s;
    acb_mat_t matrix;
    acb_mat_t right;
    acb_mat_init(matrix, 4, 4);
    acb_mat_init(right, 4, 1);
    acb_one(acb_mat_entry(right, 1, 0));
    for (int j = 0; j < 4; ++j) {
      const auto set = [&](int row, const Ball& value) {
        acb_set(acb_mat_entry(matrix, row, j), value.get());
      };
      set(0, basis(j, 0, 0.0));
      set(1, hub * basis(j, 1, 0.0) - kappa * basis(j, 2, 0.0));
      set(2, kappa * basis(j, 3, l_) - mass * basis(j, 0, l_));
      set(3, kappa * basis(j, 2, l_) + inertia * basis(j, 1, l_));
    }
    acb_mat_solve(right, matrix, right, Ball::precision_bits);
    for (int j = 0; j < 4; ++j) {
      acb_set(coefficients_[static_cast<std::size_t>(j)].get(), acb_mat_entry(right, j, 0));
    }
    acb_mat_clear(matrix);
    acb_mat_clear(right);
  }

  /// The derivative of y of that order.
  Ball y(int order, const Ball& x) const {
    Ball sum;
    for (int j = 0; j < 4; ++j) {
      sum = sum + coefficients_[static_cast<std::size_t>(j)] * basis(j, order, x);
    }
    return sum;
  }

 private:
  Ball basis(int j, int order, const Ball& x) const {
    const Ball i(std::complex<double>(0.0, 1.0));
    const std::array<Ball, 4> rates = {i * u_, -(i * u_), -u_, u_};
    const Ball rate = rates[static_cast<std::size_t>(j)];
    Ball value = exp(rate * (j % 2 == 0 ? x : x - l_));
    for (int k = 0; k < order; ++k) value = value * rate;
    return value;
  }

  Ball l_;
  Ball u_;
  std::array<Ball, 4> coefficients_;
};

Ball response(const arm::Arm& arm, const Sensor& sensor, const Ball& s) {
  const BoundaryValueProblem problem(arm, s);
  const Ball l(arm.beam.length_m);
  switch (sensor.kind) {
    case SensorKind::hub_angle:
      return problem.y(1, 0.0);
    case SensorKind::hub_velocity:
      return s * problem.y(1, 0.0);
    case SensorKind::tip_displacement:
      return problem.y(0, l);
    case SensorKind::tip_acceleration:
      return s * s * problem.y(0, l);
    case SensorKind::tip_deflection:
      return problem.y(0, l) - l * problem.y(1, 0.0);
    case SensorKind::strain:
      return Ball(arm.beam.thickness_m.value() / 2.0) * problem.y(2, sensor.position_m);
  }
  return {};
}

std::vector<Sensor> all_sensors(double length_m) {
  return {{SensorKind::hub_angle},
          {SensorKind::hub_velocity},
          {SensorKind::tip_acceleration},
          {SensorKind::tip_displacement},
          {SensorKind::tip_deflection},
          {SensorKind::strain, 0.0},
          {SensorKind::strain, 1e-6 * length_m},
          {SensorKind::strain, 0.26 * length_m},
          {SensorKind::strain, 0.99 * length_m}};
}

std::vector<arm::Arm> all_arms() {
  auto arms = undamped_arms();
  arms.push_back(unit_arm(0.1, 0.5, 0.02, 1e-3, 0.0));
  arms.push_back(unit_arm(0.1, 0.5, 0.02, 0.0, 0.3));
  arms.push_back(unit_arm(0.0, 0.2, 0.0, 1e-5, 2.0));
  return arms;
}

class TransferFunction : public testing::TestWithParam<arm::Arm> {};

// The bound: the result is rounded to double once (each part to 2^-53). Before that, the long
// double arithmetic moves the phases lambda and lambda xi by a few units of 2^-64 of themselves,
// and s by as much, which the relative slope s T'(s)/T(s) turns into an error of the value: a few
// 1e-13 at lambda = 1e6, off the resonances and zeros.
constexpr double kResultRounding = 2.0 * 0x1p-53;
constexpr double kArgumentRounding = 4.0 * 0x1p-64;
/// Below this Arb's magnitudes are not told apart as doubles.
constexpr double kSmallest = 0x1p-1000;

TEST_P(TransferFunction, AgreesWithBallArithmeticFromLambda1em6To1e6) {
  const ExactArm exact(GetParam());
  const double scale = arm::omega_scale_rad_per_s(exact.arm());
  std::mt19937 random(20240712);
  std::uniform_real_distribution<double> log_lambda(-6.0, 6.0);
  std::uniform_real_distribution<double> angle(-std::numbers::pi, std::numbers::pi);
  Ball::precision_bits = 1024;
  for (int trial = 0; trial < 60; ++trial) {
    const double lambda = std::pow(10.0, log_lambda(random));
    const double omega = scale * lambda * lambda;
    // A third of the points on either axis of s, the rest in all its quadrants.
    const std::complex<double> s = trial % 3 == 0   ? std::complex<double>(0.0, omega)
                                   : trial % 6 == 1 ? std::complex<double>(-omega, 0.0)
                                   : trial % 6 == 4 ? std::complex<double>(omega, 0.0)
                                                    : std::polar(omega, angle(random));
    for (const auto& sensor : all_sensors(exact.arm().beam.length_m)) {
      const Ball at_s(s);
      const Ball expected = response(exact.arm(), sensor, at_s);
      if (upper_bound(expected) <= kSmallest) {
        EXPECT_LE(std::abs(exact.transfer_function(sensor, s)), kSmallest);
        continue;
      }
      constexpr double kStep = 0x1p-200;
      const Ball moved = response(exact.arm(), sensor, at_s + at_s * Ball(kStep));
      const double slope = relative_distance(moved, expected) / kStep;
      const double bound = kResultRounding + kArgumentRounding * (1.0 + lambda + slope);
      EXPECT_LE(relative_distance(Ball(exact.transfer_function(sensor, s)), expected), bound)
          << to_string(sensor) << " at s = " << s << ", slope " << slope;
    }
  }
}

TEST_P(TransferFunction, IsRealOnTheRealAxisAndConjugateSymmetric) {
  const ExactArm exact(GetParam());
  for (const auto& sensor : all_sensors(exact.arm().beam.length_m)) {
    EXPECT_EQ(exact.transfer_function(sensor, 3.7).imag(), 0.0);
    const std::complex<double> s(-0.4, 12.3);
    EXPECT_EQ(exact.transfer_function(sensor, std::conj(s)),
              std::conj(exact.transfer_function(sensor, s)));
  }
}

INSTANTIATE_TEST_SUITE_P(AllArms, TransferFunction, testing::ValuesIn(all_arms()),
                         [](const auto& each) { return "arm" + std::to_string(each.index); });

TEST(ExactArm, RefusesWhatItCannotAnswer) {
  EXPECT_THROW(ExactArm(arm::paper_arm()).transfer_function({SensorKind::hub_angle}, 0.0),
               std::domain_error);
  EXPECT_THROW(ExactArm(arm::paper_arm()).poles(0), arm::InputError);
  EXPECT_THROW(ExactArm(arm::paper_arm()).transfer_function({SensorKind::strain, 2.0}, 1.0),
               arm::InputError);
  arm::Arm arm = arm::paper_arm();
  arm.payload.mass_kg = -1.0;
  EXPECT_THROW(ExactArm{arm}, arm::InputError);
}

TEST(ExactArm, RefusesEffectsThatItDoesNotHonourByName) {
  for (const auto& definition : effects::vocabulary()) {
    if (definition->is_of_linear_arm()) continue;
    arm::Arm arm = arm::paper_arm();
    arm.beam.shear_modulus_Pa = 2.6e10;
    arm.effects[definition->name] = effects::example(definition);
    try {
      ExactArm{arm};
      ADD_FAILURE() << definition->name << " was accepted";
    } catch (const arm::InputError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(definition->name));
      EXPECT_THAT(error.what(), testing::HasSubstr("exact_tf"));
    }
  }
}

TEST(ExactArm, StaysFreeOfTrapsWhereKelvinVoigtPolesAccumulate) {
  const arm::Arm arm = unit_arm(0.1, 0.0, 0.0, 1.0 / 128.0);
  const auto value = ExactArm(arm).transfer_function({SensorKind::hub_angle}, -128.0);
  EXPECT_FALSE(std::isfinite(std::abs(value)));
}

}  // namespace
}  // namespace flexarm::exact_tf
