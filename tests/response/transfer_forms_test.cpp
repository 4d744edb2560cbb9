#include "response/frequency/transfer_forms.hpp"

#include "exact_tf/partial_fractions.hpp"
#include "exact_tf/product_form.hpp"
#include "tests/response/models.hpp"

#include <gtest/gtest.h>

#include <cmath>

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

TEST(TransferForms, TheProductIsThatOfTheExactForm) {
  constexpr double kRounding = 1e-12;  // of some 20 factors and the gain
  const exact_tf::ExactArm exact(without_damping(damped_arm()));
  for (const auto& sensor : every_sensor()) {
    const auto factors = product_factors(exact, sensor, 6);
    const exact_tf::ProductForm reference(exact, sensor, 6);
    for (const Complex s : {Complex(0.0, 7.0), Complex(0.0, 150.0), Complex(30.0, 40.0)}) {
      const Complex expected = reference(s);
      EXPECT_LT(std::abs(value(factors, s) - expected), kRounding * std::abs(expected))
          << arm::to_string(sensor) << " " << s;
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

TEST(TransferForms, PartialFractionsAreThoseOfTheExactForm) {
  constexpr double kRounding = 1e-12;
  arm::Arm arm = damped_arm();
  arm.hub.viscous_friction_N_m_s_per_rad = 0.0;  // couples modes, which single terms cannot
  const exact_tf::ExactArm exact(arm);
  const auto model = modal_model(exact, 6, every_sensor(), {});
  for (std::size_t k = 0; k < every_sensor().size(); ++k) {
    const exact_tf::PartialFractions reference(exact, every_sensor()[k], 6);
    for (const Complex s : {Complex(0.0, 7.0), Complex(0.0, 150.0), Complex(30.0, 40.0)}) {
      Complex sum = 0.0;
      for (const auto& term : partial_fractions(model, k)) {
        sum += term.residue / (s * s + term.damping_rad_per_s * s + term.omega_squared_rad2_per_s2);
      }
      for (int i = 0; i < arm::derivative_order(every_sensor()[k]); ++i) sum *= s;
      const Complex expected = reference(s);
      EXPECT_LT(std::abs(sum - expected), kRounding * std::abs(expected))
          << arm::to_string(every_sensor()[k]);
    }
  }
}

}  // namespace
}  // namespace flexarm::response
