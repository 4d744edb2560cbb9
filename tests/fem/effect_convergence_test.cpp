// Orders of convergence with effects on, the default mesh beside finer ones, and fine meshes.
#include "fem/fem_arm.hpp"
#include "tests/fem/constants.hpp"
#include "tests/fem/fitted_order.hpp"
#include "tests/reference/effect_cases.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>
#include <vector>

namespace flexarm::fem {
namespace {

using Complex = std::complex<double>;
using reference::EffectCase;

FemArm model_of(const arm::Arm& arm, int elements, int degree) {
  FemArm::Options options;
  options.mesh.elements = elements;
  options.degree = degree;
  return FemArm(arm, options);
}

/// Errors of poles, then of hub zeros, against the reference.
std::vector<double> errors_of(const FemArm& model, const EffectCase& exact, std::size_t count) {
  const auto poles = model.poles(static_cast<int>(count)).omega_rad_per_s;
  const auto zeros = model.zeros(kHubAngle, static_cast<int>(count)).s_rad_per_s;
  std::vector<double> errors;
  for (std::size_t i = 0; i < count; ++i) {
    errors.push_back(std::abs(poles[i] / exact.pole_rad_per_s[i] - 1.0));
  }
  for (std::size_t i = 0; i < count; ++i) {
    errors.push_back(std::abs(zeros[i].imag() / exact.hub_zero_rad_per_s[i] - 1.0));
  }
  return errors;
}

/// Where the mesh of an arm has a node in any case: at its crack and masses.
std::vector<double> places_m(const arm::Arm& arm) {
  const arm::LinearArm linear = arm::linear_arm(arm);
  std::vector<double> places;
  if (linear.crack) places.push_back(linear.crack->position_m);
  for (const auto& mass : linear.masses) places.push_back(mass.position_m);
  std::ranges::sort(places);
  return places;
}

/// Elements of nearly one length with a node at each place, so that all of the series are alike.
FemArm alike(const arm::Arm& arm, int elements, int degree) {
  FemArm::Options options;
  options.mesh.elements = elements;
  options.degree = degree;
  std::vector<double> places = places_m(arm);
  if (places.empty()) return FemArm(arm, options);
  const double length = arm.beam.length_m;
  places.push_back(length);
  double from = 0.0;
  int before = 0;
  for (const double place : places) {
    const int all = static_cast<int>(std::lround(elements * place / length));
    const int pieces = all - before;
    for (int i = 0; i < pieces; ++i) {
      options.mesh.nodes_m.push_back(from + (place - from) * i / pieces);
    }
    from = place;
    before = all;
  }
  options.mesh.nodes_m.push_back(length);
  return FemArm(arm, options);
}

class EffectOrder : public ::testing::TestWithParam<EffectCase> {
 protected:
  static void expect_order(int degree, const std::vector<int>& elements, double order) {
    constexpr double kTolerance = 0.1;  // the project's figure for cubic elements
    constexpr std::size_t kCount = 4;
    std::vector<std::vector<double>> series(2 * kCount);
    for (const int count : elements) {
      const auto errors = errors_of(alike(GetParam().arm, count, degree), GetParam(), kCount);
      for (std::size_t i = 0; i < errors.size(); ++i) series[i].push_back(errors[i]);
    }
    for (std::size_t i = 0; i < series.size(); ++i) {
      constexpr double kRoundingFloor = 1e-13;
      if (series[i].back() < kRoundingFloor) continue;
      EXPECT_NEAR(fitted_order(elements, series[i]), order, kTolerance)
          << "number " << i << ", finest error " << series[i].back();
    }
  }
};

// 2p - 2: energies converge with the square of curvature and shear strain, which are of order
// p - 1; gravity's slopes are of a higher order.
TEST_P(EffectOrder, OfCubicElementsIsFour) {
  expect_order(3, {44, 66, 99, 132}, 4.0);
}
TEST_P(EffectOrder, OfQuarticElementsIsSix) {
  // Crack and masses are at elevenths of the beam. Masses leave too much of the next order in
  // elements that are not of one length.
  if (!arm::linear_arm(GetParam().arm).masses.empty()) {
    expect_order(4, {22, 33}, 6.0);
  } else {
    expect_order(4, {19, 22, 33}, 6.0);
  }
}

TEST_P(EffectOrder, FineMeshesKeepTheDigits) {
  // An assembled stiffness would leave five digits. The error of cubic elements is 1e-14 here, that
  // of summing the weight's energy over so many elements some 1e-11.
  constexpr double kFigure = 1e-9;
  const auto errors = errors_of(model_of(GetParam().arm, 5000, 3), GetParam(), 4);
  EXPECT_LE(*std::ranges::max_element(errors), kFigure);
}

TEST_P(EffectOrder, TheDefaultMeshHasTenPolesTenHubZerosAndTipZerosExact) {
  constexpr double kFigure = 1e-11;
  const FemArm model = model_of(GetParam().arm, 5, 15);
  const FemArm finer = model_of(GetParam().arm, 8, 20);
  const auto poles = model.poles(10).omega_rad_per_s;
  const auto finer_poles = finer.poles(10).omega_rad_per_s;
  const auto zeros = model.zeros(kHubAngle, 10).s_rad_per_s;
  const auto finer_zeros = finer.zeros(kHubAngle, 10).s_rad_per_s;
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_NEAR(poles[i] / finer_poles[i], 1.0, kFigure) << "pole " << i + 1;
    EXPECT_LE(std::abs(zeros[i] / finer_zeros[i] - 1.0), kFigure) << "hub zero " << i + 1;
  }
  for (const char* name : {"tip_acceleration", "tip_deflection", "strain@0.1"}) {
    const arm::Sensor sensor = arm::parse_sensor(name);
    const auto some = model.zeros(sensor, 5);
    const auto same = finer.zeros(sensor, 5);
    EXPECT_EQ(some.count.found, some.count.expected) << name;
    ASSERT_EQ(some.s_rad_per_s.size(), 5u) << name;
    ASSERT_EQ(same.s_rad_per_s.size(), 5u) << name;
    for (std::size_t i = 0; i < 5; ++i) {
      EXPECT_LE(std::abs(some.s_rad_per_s[i] / same.s_rad_per_s[i] - 1.0), kFigure)
          << name << ' ' << i + 1;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Reference, EffectOrder, ::testing::ValuesIn(reference::effect_cases()),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace flexarm::fem
