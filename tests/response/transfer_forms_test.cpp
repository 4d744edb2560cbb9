#include "response/frequency/transfer_forms.hpp"

#include "exact_tf/exact_arm.hpp"
#include "tests/response/models.hpp"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <vector>

namespace flexarm::response {
namespace {

using Complex = std::complex<double>;

int rigid_power(const arm::Sensor& sensor) {
  const bool bends =
      sensor.kind == arm::SensorKind::tip_deflection || sensor.kind == arm::SensorKind::strain;
  return arm::derivative_order(sensor) - (bends ? 0 : 2);
}

TEST(TransferForms, GainAndPowerOfAnArmThatTurnsFreely) {
  constexpr double kCircle = 1e-11;  // rounding of the discrete models on the circle
  arm::Arm arm = damped_arm();
  const double inertia = arm::total_inertia_kg_m2(arm);
  const double length = arm.beam.length_m;
  for (const char* name : kFormulations) {
    const auto formulation = make_formulation(name, arm, 6);
    for (const auto& sensor : every_sensor()) {
      const auto factors = product_factors(formulation, sensor, 4);
      EXPECT_EQ(factors.power, rigid_power(sensor)) << name << " " << arm::to_string(sensor);
      EXPECT_TRUE(factors.turns_freely);
      const bool tip = sensor.kind == arm::SensorKind::tip_acceleration ||
                       sensor.kind == arm::SensorKind::tip_displacement;
      if (!tip && !arm::is_collocated(sensor)) continue;
      const double expected = (tip ? length : 1.0) / inertia;
      EXPECT_NEAR(factors.gain, expected, kCircle * expected) << name << arm::to_string(sensor);
    }
  }
}

TEST(TransferForms, TheProductIsTheResponseAtLowFrequencies) {
  // Cut off after 6 pairs: the tail of sum (1/z_pole - 1/z_zero), |z_i| ~ (pi i)^4.
  constexpr double kTail = 2e-3;
  for (const char* name : kFormulations) {
    const auto formulation = make_formulation(name, without_damping(damped_arm()), 8);
    for (const auto& sensor : every_sensor()) {
      const auto factors = product_factors(formulation, sensor, 6);
      const Complex s(0.0, 20.0);
      const Complex exact = transfer_function(formulation, sensor, s);
      EXPECT_LT(std::abs(value(factors, s) - exact), kTail * std::abs(exact))
          << name << " " << arm::to_string(sensor);
    }
  }
}

/// Below the first flexible pole of the arms here, off both axes.
constexpr Complex kFrequency(-0.3, 2.1);

/// A beam of unit length, rigidity and linear density.
arm::Arm unit_arm(double hub_inertia_kg_m2) {
  arm::Arm arm;
  arm.beam = arm::Beam::from_rigidity(1.0, 1.0, 1.0);
  arm.beam.thickness_m = 0.01;
  arm.hub.inertia_kg_m2 = hub_inertia_kg_m2;
  return arm;
}

Complex product(const arm::Arm& arm, const arm::Sensor& sensor, int count, Complex s) {
  return value(product_factors(exact_tf::ExactArm(arm), sensor, count), s);
}

Complex sum(const arm::Arm& arm, const arm::Sensor& sensor, int count, Complex s) {
  const auto model = exact_tf::ExactArm(arm).modal_model(count, std::array{sensor}, {});
  Complex total = 0.0;
  for (const auto& term : partial_fractions(model, 0)) {
    total += term.residue / (s * s + term.damping_rad_per_s * s + term.omega_squared_rad2_per_s2);
  }
  for (int i = 0; i < arm::derivative_order(sensor); ++i) total *= s;
  return total;
}

/// The power of the count with which a form tends to the exact transfer function.
template <class Form>
double fitted_power(const Form& form, const arm::Arm& arm, const arm::Sensor& sensor,
                    const std::vector<int>& counts) {
  const Complex expected = exact_tf::ExactArm(arm).transfer_function(sensor, kFrequency);
  Eigen::MatrixX2d powers(counts.size(), 2);
  Eigen::VectorXd errors(counts.size());
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double error = std::abs(form(arm, sensor, counts[i], kFrequency) / expected - 1.0);
    // Far above the rounding of the sums, so that the slope is that of the method.
    EXPECT_GT(error, 1e-13) << counts[i];
    powers.row(static_cast<Eigen::Index>(i)) << 1.0, std::log(counts[i]);
    errors(static_cast<Eigen::Index>(i)) = std::log(error);
  }
  return powers.colPivHouseholderQr().solve(errors)(1);
}

/// Orders are those of the tail for many terms; at the counts fitted the next power still shows.
constexpr double kPowerTolerance = 0.2;

/// The relative error of n factors is the tail of sum (1/z_pole - 1/z_zero), |z_i| ~ i^4. Poles and
/// zeros of the hub angle pair off: n^-4; with hub inertia, once lambda^3 > 1/epsilon, they are
/// some 1/(epsilon lambda^3) apart: n^-7.
TEST(TransferForms, TheProductTendsToTheExactValueInItsOrder) {
  const arm::Sensor hub_angle{arm::SensorKind::hub_angle};
  EXPECT_NEAR(fitted_power(product, unit_arm(0.0), hub_angle, {10, 20, 40, 80}), -4.0,
              kPowerTolerance);
  EXPECT_NEAR(fitted_power(product, unit_arm(0.5), hub_angle, {4, 8, 12, 16}), -7.0,
              kPowerTolerance);
}

/// A term of the hub angle is of order i^-8 with hub inertia (phi_i'(0) ~ i^-2) and i^-2 without.
/// Terms at the tip alternate in sign: n^-6 and n^-3.
TEST(TransferForms, TheSumTendsToTheExactValueInItsOrder) {
  const arm::Sensor hub_angle{arm::SensorKind::hub_angle};
  const arm::Sensor tip{arm::SensorKind::tip_acceleration};
  EXPECT_NEAR(fitted_power(sum, unit_arm(0.0), hub_angle, {20, 40, 80, 160}), -1.0,
              kPowerTolerance);
  EXPECT_NEAR(fitted_power(sum, unit_arm(0.5), hub_angle, {4, 8, 12, 16}), -7.0, kPowerTolerance);
  EXPECT_NEAR(fitted_power(sum, unit_arm(0.0), tip, {10, 20, 40, 80}), -3.0, kPowerTolerance);
  EXPECT_NEAR(fitted_power(sum, unit_arm(0.5), tip, {6, 12, 18, 24}), -6.0, kPowerTolerance);
}

TEST(TransferForms, TheSumIsExactWithKelvinVoigtDamping) {
  constexpr int kCount = 200;
  // The tail of the slowest, the strain: terms phi''(X) phi'(0)/omega^2 ~ i^-4 of changing sign, at
  // most a sum of order n^-3.
  constexpr double kTail = 1.0 / (kCount * kCount * kCount);
  arm::Arm arm = unit_arm(0.3);
  arm.payload = {0.4, 0.05};
  arm.damping.kelvin_voigt_s = 2e-3;
  const exact_tf::ExactArm exact(arm);
  for (const auto& sensor : every_sensor()) {
    for (const Complex s : {kFrequency, Complex(0.0, 30.0), Complex(-3.0, 100.0), Complex(4.0)}) {
      const Complex expected = exact.transfer_function(sensor, s);
      EXPECT_LE(std::abs(sum(arm, sensor, kCount, s) - expected), kTail * std::abs(expected))
          << arm::to_string(sensor) << " at " << s;
    }
  }
}

}  // namespace
}  // namespace flexarm::response
