#include "arms.hpp"
#include "assumed_modes/assumed_modes_arm.hpp"

#include <boost/math/quadrature/gauss.hpp>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace flexarm::assumed_modes {
namespace {

using testing_arms::kHubAngle;
using testing_arms::kTipDeflection;
using testing_arms::kTipDisplacement;

constexpr int kModes = 6;

/// The paper's arm with a payload and both dampings: no unit is 1.
arm::Arm loaded_arm() {
  arm::Arm arm = arm::paper_arm();
  arm.hub.inertia_kg_m2 = 5e-3;
  arm.hub.viscous_friction_N_m_s_per_rad = 0.02;
  arm.payload = {0.05, 1e-4};
  arm.damping.kelvin_voigt_s = 1e-4;
  return arm;
}

struct Stations {
  std::vector<double> stations_m;
  std::vector<double> weights_m;
};

/// 30 Gauss points on each of 4 panels: rounding only for the first modes.
Stations gauss_points(double length_m) {
  constexpr int kPanels = 4;
  Stations points;
  const double half = length_m / (2 * kPanels);
  const auto& abscissa = boost::math::quadrature::gauss<double, 30>::abscissa();
  const auto& weights = boost::math::quadrature::gauss<double, 30>::weights();
  for (int panel = 0; panel < kPanels; ++panel) {
    for (std::size_t i = 0; i < abscissa.size(); ++i) {
      for (const double sign : {-1.0, 1.0}) {
        points.stations_m.push_back((2 * panel + 1) * half + sign * half * abscissa[i]);
        points.weights_m.push_back(half * weights[i]);
      }
    }
  }
  return points;
}

TEST(Modes, AreOrthogonalWithTheRigidArmsInertiaAsModalMass) {
  const arm::Arm arm = loaded_arm();
  const double inertia = arm::total_inertia_kg_m2(arm);
  const double density = arm.beam.linear_density_kg_per_m();
  const Stations points = gauss_points(arm.beam.length_m);
  for (const Basis basis : kAllBases) {
    const AssumedModesArm model(arm, {basis, 24});
    const auto modes =
        model.modes(kModes, std::array{kHubAngle, kTipDisplacement}, points.stations_m);
    ASSERT_EQ(modes.size(), static_cast<std::size_t>(kModes));
    // phi'(l) is no sensor: a difference over 1e-5 of the link serves, with an error of 1e-4 of
    // Ip phi'(l)^2, itself 3e-2 of I_T at most.
    constexpr double kSlopeError = 1e-4;
    const double step = 1e-5 * arm.beam.length_m;
    const auto near_tip =
        model.modes(kModes, {}, std::array{arm.beam.length_m - step, arm.beam.length_m});
    const auto tip_slope = [&](std::size_t i) {
      return (near_tip[i].displacement_m[1] - near_tip[i].displacement_m[0]) / step;
    };
    for (std::size_t i = 0; i < modes.size(); ++i) {
      for (std::size_t j = 0; j <= i; ++j) {
        double product =
            arm.hub.inertia_kg_m2 * modes[i].hub_slope * modes[j].hub_slope +
            arm.payload.mass_kg * modes[i].sensor_values[1] * modes[j].sensor_values[1] +
            arm.payload.inertia_kg_m2 * tip_slope(i) * tip_slope(j);
        for (std::size_t k = 0; k < points.weights_m.size(); ++k) {
          product += density * points.weights_m[k] * modes[i].displacement_m[k] *
                     modes[j].displacement_m[k];
        }
        EXPECT_NEAR(product / inertia, i == j ? 1.0 : 0.0, kSlopeError)
            << to_string(basis) << ' ' << i << ' ' << j;
      }
      // Orthogonal to the rigid rotation phi_0 = x: no angular momentum.
      double momentum = arm.hub.inertia_kg_m2 * modes[i].hub_slope +
                        arm.payload.mass_kg * arm.beam.length_m * modes[i].sensor_values[1] +
                        arm.payload.inertia_kg_m2 * tip_slope(i);
      for (std::size_t k = 0; k < points.weights_m.size(); ++k) {
        momentum +=
            density * points.weights_m[k] * points.stations_m[k] * modes[i].displacement_m[k];
      }
      EXPECT_NEAR(momentum / inertia, 0.0, kSlopeError) << to_string(basis) << ' ' << i;
    }
  }
}

TEST(Modes, SensorsAndStationsShowOneAndTheSameShape) {
  const arm::Arm arm = loaded_arm();
  const double length = arm.beam.length_m;
  const std::array sensors = {kHubAngle,        testing_arms::kHubVelocity,
                              kTipDisplacement, testing_arms::kTipAcceleration,
                              kTipDeflection,   testing_arms::strain_at(0.3)};
  // Second difference of phi about 0.3 m; error h^2/12 phi'''' and rounding 1e-16/h^2.
  constexpr double kStep = 1e-3;
  constexpr double kDifferenceError = 1e-4;
  const std::array stations = {0.0, length, 0.3 - kStep, 0.3, 0.3 + kStep};
  const AssumedModesArm model(arm);
  const auto modes = model.modes(kModes, sensors, stations);
  for (const arm::Mode& mode : modes) {
    EXPECT_GT(mode.hub_slope, 0.0);
    EXPECT_EQ(mode.sensor_values[0], mode.hub_slope);
    EXPECT_EQ(mode.sensor_values[1], mode.hub_slope);
    EXPECT_NEAR(mode.displacement_m[0], 0.0, 1e-15);
    EXPECT_NEAR(mode.displacement_m[1], mode.sensor_values[2], 1e-14);
    EXPECT_EQ(mode.sensor_values[2], mode.sensor_values[3]);
    EXPECT_NEAR(mode.sensor_values[4], mode.sensor_values[2] - length * mode.hub_slope, 1e-14);
    const double curvature =
        (mode.displacement_m[2] - 2 * mode.displacement_m[3] + mode.displacement_m[4]) /
        (kStep * kStep);
    // In units of lambda^2/l^2 times the tip displacement of the rigid rotation, l.
    const double scale =
        *arm.beam.thickness_m / 2 * mode.omega_rad_per_s / arm::omega_scale_rad_per_s(arm) / length;
    EXPECT_NEAR(mode.sensor_values[5], *arm.beam.thickness_m / 2 * curvature,
                kDifferenceError * scale);
  }
}

TEST(Modes, HaveTheFrequenciesOfThePolesAndTheProjectedDamping) {
  const arm::Arm arm = loaded_arm();
  const AssumedModesArm model(arm);
  const auto modes = model.modes(kModes, {}, {});
  const auto poles = model.poles(kModes).omega_rad_per_s;
  for (std::size_t i = 0; i < modes.size(); ++i) {
    EXPECT_EQ(modes[i].omega_rad_per_s, poles[i]);
    const double rate = arm.damping.kelvin_voigt_s * poles[i] * poles[i] +
                        arm.hub.viscous_friction_N_m_s_per_rad * modes[i].hub_slope *
                            modes[i].hub_slope / arm::total_inertia_kg_m2(arm);
    EXPECT_NEAR(modes[i].damping_ratio, rate / (2 * poles[i]), 1e-15);
  }
}

}  // namespace
}  // namespace flexarm::assumed_modes
