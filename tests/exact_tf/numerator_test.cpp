#include "exact_tf/numerator.hpp"

#include "ball.hpp"
#include "sample_arms.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace flexarm::exact_tf {
namespace {

/// Krylov-Duncan functions over lambda^k, at xi, by their definition.
std::array<Ball, 4> krylov(const Ball& lambda, const Ball& xi) {
  const Ball u = lambda * xi;
  const Ball two_square = Ball(2.0) * lambda * lambda;
  return {(cosh(u) + cos(u)) / Ball(2.0), (sinh(u) + sin(u)) / (Ball(2.0) * lambda),
          (cosh(u) - cos(u)) / two_square, (sinh(u) - sin(u)) / (two_square * lambda)};
}

/// The solution of the boundary value problem in balls, as numerator.hpp scales it: built from the
/// tip, y = Q p(xi) - P q(xi), with no formula of the code under test.
struct Field {
  Ball y, slope, curvature;  ///< derivatives by x = 1 - xi
};

Field field(const InertiaRatios& ratios, const Ball& lambda, const Ball& xi) {
  const Ball z = lambda * lambda * lambda * lambda;
  const Ball eta(ratios.payload_mass);
  const Ball mu(ratios.payload_inertia);
  const auto hub = krylov(lambda, 1.0);
  const auto here = krylov(lambda, xi);
  const Ball p_hub = hub[0] + eta * z * hub[3];
  const Ball q_hub = hub[1] - mu * z * hub[2];
  const auto combine = [&](const Ball& p, const Ball& q) { return q_hub * p - p_hub * q; };
  return {combine(here[0] + eta * z * here[3], here[1] - mu * z * here[2]),
          -combine(z * here[3] + eta * z * here[2], here[0] - mu * z * here[1]),
          combine(z * here[2] + eta * z * here[1], z * here[3] - mu * z * here[0])};
}

Ball unscaled(const Scaled<Complex>& x) {
  return Ball(x.value) * exp(Ball(x.log_scale));
}

/// The change of a function's value when lambda moves by one relative unit: what the rounding of
/// lambda xi alone does, and the measure for what may be lost near a root.
template <class Function>
double sensitivity(Function function, const Ball& lambda) {
  constexpr double kStep = 0x1p-200;
  const Ball moved = lambda + lambda * Ball(kStep);
  return upper_bound((function(moved) - function(lambda)) / function(lambda)) / kStep;
}

constexpr double kUnit = 0x1p-64;  // unit roundoff of long double

class Numerators : public testing::TestWithParam<arm::Arm> {};

TEST_P(Numerators, AgreeWithTheBoundaryValueProblemInBalls) {
  const InertiaRatios ratios = inertia_ratios(linear_arm(GetParam()));
  std::mt19937 random(20240711);
  std::uniform_real_distribution<double> log_magnitude(-6.0, 2.7);
  std::uniform_real_distribution<double> angle(0.0, std::numbers::pi / 4);
  for (int trial = 0; trial < 36; ++trial) {
    const Real magnitude = std::pow(10.0L, static_cast<Real>(log_magnitude(random)));
    // Every third on either edge of the sector.
    const double argument = trial % 3 == 0 ? 0.0 : angle(random);
    Complex lambda(magnitude * std::cos(static_cast<Real>(argument)),
                   magnitude * std::sin(static_cast<Real>(argument)));
    if (trial % 3 == 1) lambda = Complex(magnitude, magnitude) / std::sqrt(2.0L);
    // Products of two functions of size exp(lambda) cancel to order 1, and a dozen powers of a
    // small lambda do.
    Ball::precision_bits = static_cast<slong>(600.0L + 6.0L * magnitude);
    const Ball exact_lambda(lambda);
    const auto expect_near = [&](const char* name, const Scaled<Complex>& found, auto function) {
      // Rounding of some forty operations, and of the arguments of the exponentials.
      const double bound = 64.0 * kUnit *
                           (1.0 + std::abs(static_cast<double>(found.log_scale)) +
                            sensitivity(function, exact_lambda));
      EXPECT_LE(relative_distance(unscaled(found), function(exact_lambda)), bound)
          << name << " at lambda = " << lambda;
    };
    const Ball epsilon(ratios.hub_inertia);
    const auto z = [](const Ball& l) { return l * l * l * l; };
    expect_near("hub angle", hub_angle_numerator(ratios, lambda),
                [&](const Ball& l) { return field(ratios, l, 1.0).slope; });
    expect_near("poles", pole_characteristic(ratios, lambda), [&](const Ball& l) {
      const Field hub = field(ratios, l, 1.0);
      return epsilon * hub.slope + hub.curvature / z(l);
    });
    expect_near("tip", tip_numerator(ratios, lambda),
                [&](const Ball& l) { return field(ratios, l, 0.0).y; });
    expect_near("tip deflection", tip_deflection_numerator(ratios, lambda), [&](const Ball& l) {
      return (field(ratios, l, 0.0).y - field(ratios, l, 1.0).slope) / z(l);
    });
    for (const Real xi : {1.0L, 1.0L - 1e-9L, 0.95L, 0.5L, 0.11L, 1e-3L, 1e-9L}) {
      expect_near("curvature", curvature_numerator(ratios, lambda, xi),
                  [&](const Ball& l) { return field(ratios, l, xi).curvature / z(l); });
    }
    for (const Real xi : {0.95L, 0.5L, 0.11L, 1e-3L, 1e-9L, 0.0L}) {
      expect_near("displacement", displacement_numerator(ratios, lambda, xi),
                  [&](const Ball& l) { return field(ratios, l, xi).y; });
    }
  }
}

TEST_P(Numerators, AreRealAndEqualOnTheRealAxis) {
  const InertiaRatios ratios = inertia_ratios(linear_arm(GetParam()));
  for (const Real lambda : {1e-3L, 0.7L, 1.99L, 2.01L, 17.3L, 4321.0L}) {
    const auto real = curvature_numerator(ratios, lambda, 0.3L);
    const auto complex = curvature_numerator(ratios, Complex(lambda), 0.3L);
    EXPECT_EQ(complex.value.imag(), 0.0L);
    EXPECT_EQ(complex.log_scale, real.log_scale);
    EXPECT_NEAR(static_cast<double>(complex.value.real() / real.value), 1.0,
                std::numeric_limits<double>::epsilon());
  }
}

TEST_P(Numerators, AtZeroFrequencyAreThoseOfARigidArm) {
  const InertiaRatios ratios = inertia_ratios(linear_arm(GetParam()));
  const double unit = std::numeric_limits<double>::epsilon();
  EXPECT_DOUBLE_EQ(static_cast<double>(hub_angle_numerator(ratios, 0.0L).value), 1.0);
  EXPECT_DOUBLE_EQ(static_cast<double>(tip_numerator(ratios, 0.0L).value), 1.0);
  const double inertia =
      arm::total_inertia_kg_m2(GetParam()) /
      (GetParam().beam.linear_density_kg_per_m() * std::pow(GetParam().beam.length_m, 3));
  EXPECT_NEAR(static_cast<double>(pole_characteristic(ratios, 0.0L).value), inertia,
              4.0 * unit * inertia);
}

INSTANTIATE_TEST_SUITE_P(AllArms, Numerators, testing::ValuesIn(undamped_arms()),
                         [](const auto& each) { return "arm" + std::to_string(each.index); });

}  // namespace
}  // namespace flexarm::exact_tf
