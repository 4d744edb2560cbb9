#include "exact_tf/complex_frequency.hpp"
#include "exact_tf/exact_arm.hpp"
#include "exact_tf/mode_shape.hpp"
#include "exact_tf/root_search.hpp"
#include "sample_arms.hpp"

#include <boost/math/quadrature/gauss.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

namespace flexarm::exact_tf {
namespace {

using arm::SensorKind;

/// int_0^l f(x) dx by 20-point Gauss on equal panels: exact to rounding when a panel is shorter
/// than a third of a wavelength.
double integral(const std::function<double(double)>& f, double length_m, int panels) {
  double sum = 0.0;
  for (int i = 0; i < panels; ++i) {
    sum += boost::math::quadrature::gauss<double, 20>::integrate(f, length_m * i / panels,
                                                                 length_m * (i + 1) / panels);
  }
  return sum;
}

/// A mode with what the orthogonality integrals need; the rigid-body mode is phi_0 = x.
struct TestMode {
  double omega_rad_per_s;
  double hub_slope;
  double tip;
  double tip_slope;
  std::function<double(double)> displacement;
  std::function<double(double)> curvature;
};

TestMode rigid_body_mode(const arm::Arm& arm) {
  return {0.0, 1.0, arm.beam.length_m, 1.0, [](double x) { return x; }, [](double) { return 0.0; }};
}

TestMode flexible_mode(const arm::Arm& arm, Real lambda) {
  const ModeShape shape(linear_arm(arm), inertia_ratios(linear_arm(arm)), lambda);
  const double omega =
      static_cast<double>(lambda * lambda * frequency_scale_rad_per_s(linear_arm(arm)));
  const double l = arm.beam.length_m;
  // From EI phi''(l) = omega^2 Ip phi'(l); without payload inertia no formula below asks for it.
  const double inertia = arm.payload.inertia_kg_m2;
  const double tip_slope = inertia == 0.0 ? 0.0
                                          : arm.beam.flexural_rigidity_N_m2() *
                                                static_cast<double>(shape.curvature_per_m(l)) /
                                                (inertia * omega * omega);
  return {omega,
          static_cast<double>(shape.hub_slope()),
          static_cast<double>(shape.tip_displacement_m()),
          tip_slope,
          [shape](double x) { return static_cast<double>(shape.displacement_m(x)); },
          [shape](double x) { return static_cast<double>(shape.curvature_per_m(x)); }};
}

/// The left-hand side of (24), put right: m, not M, under the integral.
double mass_product(const arm::Arm& arm, const TestMode& a, const TestMode& b, int panels) {
  return arm.beam.linear_density_kg_per_m() *
             integral([&](double x) { return a.displacement(x) * b.displacement(x); },
                      arm.beam.length_m, panels) +
         arm.hub.inertia_kg_m2 * a.hub_slope * b.hub_slope + arm.payload.mass_kg * a.tip * b.tip +
         arm.payload.inertia_kg_m2 * a.tip_slope * b.tip_slope;
}

/// The left-hand side of (25).
double stiffness_product(const arm::Arm& arm, const TestMode& a, const TestMode& b, int panels) {
  return arm.beam.flexural_rigidity_N_m2() *
         integral([&](double x) { return a.curvature(x) * b.curvature(x); }, arm.beam.length_m,
                  panels);
}

/// Relative to I_T, (25) also to the frequencies: the rounding of some hundred terms in double.
constexpr double kOrthogonality = 1e-12;

class Modes : public testing::TestWithParam<arm::Arm> {};

TEST_P(Modes, AreOrthogonalAndScaledToTheTotalInertia) {
  const arm::Arm& arm = GetParam();
  const double inertia = arm::total_inertia_kg_m2(arm);
  constexpr int kCount = 12;
  std::vector<TestMode> modes = {rigid_body_mode(arm)};
  for (const Real lambda : find_poles(inertia_ratios(linear_arm(arm)), kCount).lambda) {
    modes.push_back(flexible_mode(arm, lambda));
  }
  for (std::size_t i = 0; i < modes.size(); ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      const double delta = i == j ? 1.0 : 0.0;
      EXPECT_NEAR(mass_product(arm, modes[i], modes[j], 2 * kCount) / inertia, delta,
                  kOrthogonality)
          << i << ", " << j;
      if (j == 0) continue;
      EXPECT_NEAR(stiffness_product(arm, modes[i], modes[j], 2 * kCount) /
                      (inertia * modes[i].omega_rad_per_s * modes[j].omega_rad_per_s),
                  delta, kOrthogonality)
          << i << ", " << j;
    }
  }
}

TEST_P(Modes, MeetTheHubsEquationOfMotionUpToMode10000) {
  // -Ih omega^2 phi'(0) = EI phi''(0), either side by a formula of its own.
  const arm::Arm& arm = GetParam();
  const double rigidity = arm.beam.flexural_rigidity_N_m2();
  const auto lambdas = find_poles(inertia_ratios(linear_arm(arm)), 10000).lambda;
  for (const std::size_t i : {0U, 1U, 2U, 9U, 99U, 999U, 9998U, 9999U}) {
    const TestMode mode = flexible_mode(arm, lambdas[i]);
    const double moment = rigidity * mode.curvature(0.0);
    const double torque =
        -arm.hub.inertia_kg_m2 * std::pow(mode.omega_rad_per_s, 2) * mode.hub_slope;
    EXPECT_GT(mode.hub_slope, 0.0);
    // Without hub inertia both sides vanish: then relative to the largest moment, which rounding
    // of the phase leaves in the tenth digit below double's last at mode 10,000.
    const double scale = arm.hub.inertia_kg_m2 > 0.0
                             ? std::abs(moment)
                             : rigidity * std::abs(mode.curvature(0.5 * arm.beam.length_m)) +
                                   arm::total_inertia_kg_m2(arm) * mode.omega_rad_per_s;
    EXPECT_NEAR(torque / scale, moment / scale, 1e-12) << "mode " << i + 1;
  }
}

INSTANTIATE_TEST_SUITE_P(AllArms, Modes, testing::ValuesIn(undamped_arms()),
                         [](const auto& each) { return "arm" + std::to_string(each.index); });

TEST(Modes, Number10000IsNormalisedAndVanishesAtTheHub) {
  const arm::Arm arm = unit_arm(0.1, 0.5, 0.02);
  constexpr int kMode = 10000;
  const auto lambdas = find_poles(inertia_ratios(linear_arm(arm)), kMode).lambda;
  const TestMode last = flexible_mode(arm, lambdas.back());
  const TestMode before = flexible_mode(arm, lambdas[kMode - 2]);
  const double inertia = arm::total_inertia_kg_m2(arm);
  EXPECT_NEAR(mass_product(arm, last, last, kMode) / inertia, 1.0, kOrthogonality);
  EXPECT_NEAR(mass_product(arm, last, before, kMode) / inertia, 0.0, kOrthogonality);
  EXPECT_NEAR(last.displacement(0.0), 0.0, 1e-14);
}

TEST(Modes, FillWhatTheContractAsksFor) {
  arm::Arm arm = unit_arm(0.1, 0.5, 0.02, 2e-4, 0.03);
  const ExactArm exact(arm);
  const std::vector<arm::Sensor> sensors = {
      {SensorKind::hub_angle},        {SensorKind::hub_velocity},   {SensorKind::tip_acceleration},
      {SensorKind::tip_displacement}, {SensorKind::tip_deflection}, {SensorKind::strain, 0.3}};
  const std::vector<double> stations_m = {0.0, 0.3, 1.0};
  const auto modes = exact.modes(5, sensors, stations_m);
  const auto poles = exact.poles(5);
  ASSERT_EQ(modes.size(), 5U);
  constexpr double kUnits = 16.0 * std::numeric_limits<double>::epsilon();
  for (std::size_t i = 0; i < modes.size(); ++i) {
    const auto& mode = modes[i];
    EXPECT_EQ(mode.omega_rad_per_s, poles.omega_rad_per_s[i]);
    ASSERT_EQ(mode.sensor_values.size(), sensors.size());
    ASSERT_EQ(mode.displacement_m.size(), stations_m.size());
    const double tip = mode.displacement_m.back();
    EXPECT_EQ(mode.sensor_values[0], mode.hub_slope);
    EXPECT_EQ(mode.sensor_values[1], mode.hub_slope);
    EXPECT_NEAR(mode.sensor_values[2], tip, kUnits);
    EXPECT_NEAR(mode.sensor_values[3], tip, kUnits);
    EXPECT_NEAR(mode.sensor_values[4], tip - mode.hub_slope, kUnits * (1.0 + mode.hub_slope));
    const double omega = mode.omega_rad_per_s;
    const double damping = 2e-4 * omega * omega +
                           0.03 * mode.hub_slope * mode.hub_slope / arm::total_inertia_kg_m2(arm);
    EXPECT_NEAR(mode.damping_ratio, damping / (2.0 * omega), kUnits * mode.damping_ratio);
    // A strain of thickness/2 phi'' with half a thickness of 1 is the second difference of phi.
    const double step_m = 1e-3;
    const std::vector<double> around_m = {0.3 - step_m, 0.3, 0.3 + step_m};
    const auto near = exact.modes(5, {}, around_m)[i].displacement_m;
    const double difference = (near[0] - 2.0 * near[1] + near[2]) / (step_m * step_m);
    EXPECT_NEAR(mode.sensor_values[5], difference, 1e-3 * std::abs(difference) + 1e-3);
  }
}

}  // namespace
}  // namespace flexarm::exact_tf
