#include "ball.hpp"
#include "exact_tf/exact_arm.hpp"
#include "exact_tf/root_count.hpp"
#include "exact_tf/root_search.hpp"
#include "sample_arms.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace flexarm::exact_tf {
namespace {

/// 2 N_hub of exact_tf/numerator.hpp, as the books print it (clamped beam with a tip body).
Ball hub_angle_in_balls(const InertiaRatios& ratios, const Ball& u) {
  const Ball eta(ratios.payload_mass);
  const Ball mu(ratios.payload_inertia);
  const Ball cos_cosh = cos(u) * cosh(u);
  const Ball sin_cosh = sin(u) * cosh(u);
  const Ball cos_sinh = cos(u) * sinh(u);
  return Ball(1.0) + cos_cosh + eta * u * (cos_sinh - sin_cosh) -
         mu * u * u * u * (sin_cosh + cos_sinh) + eta * mu * u * u * u * u * (Ball(1.0) - cos_cosh);
}

/// 2 E, equation (38) put right: 2 (epsilon N_hub + Y).
Ball pole_in_balls(const InertiaRatios& ratios, const Ball& u) {
  const Ball eta(ratios.payload_mass);
  const Ball mu(ratios.payload_inertia);
  const Ball difference = sin(u) * cosh(u) - cos(u) * sinh(u);
  return Ball(ratios.hub_inertia) * hub_angle_in_balls(ratios, u) + difference / (u * u * u) +
         Ball(2.0) * eta * sin(u) * sinh(u) / (u * u) + Ball(2.0) * mu * cos(u) * cosh(u) -
         eta * mu * u * difference;
}

/// The sign, or 0 where the ball has both.
int sign_of(const Ball& x) {
  if (arb_is_positive(acb_realref(x.get()))) return 1;
  return arb_is_negative(acb_realref(x.get())) ? -1 : 0;
}

double moved_by_ulps(double x, int ulps) {
  return x + ulps * (std::nextafter(x, 2.0 * x) - x);
}

/// The project's figure.
constexpr int kUlps = 4;

template <class Function>
void expect_sign_changes(Function function, const std::vector<double>& lambdas, int stride) {
  Ball::precision_bits = 192;
  for (std::size_t i = 0; i < lambdas.size(); i += static_cast<std::size_t>(stride)) {
    const int below = sign_of(function(Ball(moved_by_ulps(lambdas[i], -kUlps))));
    const int above = sign_of(function(Ball(moved_by_ulps(lambdas[i], kUlps))));
    EXPECT_EQ(below * above, -1) << "root " << i + 1 << " at lambda = " << lambdas[i];
  }
}

class Roots : public testing::TestWithParam<arm::Arm> {};

constexpr int kModes = 10000;

TEST_P(Roots, AreWithinFourUlpsUpToMode10000) {
  const ExactArm exact(GetParam());
  // Every root of the paper's arm; of the others every eighth, to save time.
  const int stride = GetParam() == arm::paper_arm() ? 1 : 8;
  expect_sign_changes([&](const Ball& u) { return pole_in_balls(exact.ratios(), u); },
                      exact.pole_lambdas(kModes), stride);
  expect_sign_changes([&](const Ball& u) { return hub_angle_in_balls(exact.ratios(), u); },
                      exact.hub_zero_lambdas(kModes), stride);
}

TEST_P(Roots, AreAllThereByTheCount) {
  const InertiaRatios ratios = inertia_ratios(linear_arm(GetParam()));
  for (const auto& roots : {find_poles(ratios, kModes), find_hub_zeros(ratios, kModes)}) {
    EXPECT_EQ(roots.count.found, kModes);
    EXPECT_EQ(roots.count.expected, kModes);
    EXPECT_TRUE(roots.summary.converged);
    EXPECT_LE(roots.summary.largest_residual, 0x1p-58);
  }
}

TEST_P(Roots, InterlaceOnTheImaginaryAxis) {
  const InertiaRatios ratios = inertia_ratios(linear_arm(GetParam()));
  const auto poles = find_poles(ratios, kModes).lambda;
  const auto zeros = find_hub_zeros(ratios, kModes + 1).lambda;
  // A hub of 1e6 m l^3 leaves some poles nearer to a zero than a bracket is wide.
  constexpr Real kBracket = 0x1p-59L;
  for (std::size_t i = 0; i < poles.size(); ++i) {
    ASSERT_LT(zeros[i] * (1.0L - kBracket), poles[i]) << i;
    ASSERT_LT(poles[i] * (1.0L - kBracket), zeros[i + 1]) << i;
  }
}

TEST_P(Roots, CountStepsByOneAtEachRootAndNowhereElse) {
  const InertiaRatios ratios = inertia_ratios(linear_arm(GetParam()));
  const auto poles = find_poles(ratios, 60).lambda;
  // Multiples of pi/2, where one or other pivot is all but singular, are among the grid points;
  // multiples of pi/4, where a bare pinned beam has its poles, are not.
  std::size_t passed = 0;
  for (int i = 1; i < 20000; ++i) {
    const Real lambda = i * std::numbers::pi_v<Real> / 406.0L;
    while (passed < poles.size() && poles[passed] < lambda) ++passed;
    if (passed == poles.size()) break;
    ASSERT_EQ(count_poles_below(ratios, lambda), static_cast<int>(passed)) << lambda;
  }
}

INSTANTIATE_TEST_SUITE_P(AllArms, Roots, testing::ValuesIn(undamped_arms()),
                         [](const auto& each) { return "arm" + std::to_string(each.index); });

TEST(HubZeros, OfABareBeamAreThoseOfACantilever) {
  // One root of 1 + cos cosh in each ((n - 1) pi, n pi): a count that owes nothing to the pivots.
  const auto lambdas = ExactArm(unit_arm(0.1, 0.0, 0.0)).hub_zero_lambdas(1000);
  ASSERT_EQ(lambdas.size(), 1000U);
  for (std::size_t i = 0; i < lambdas.size(); ++i) {
    EXPECT_EQ(static_cast<std::size_t>(lambdas[i] / std::numbers::pi), i);
  }
}

TEST(HubZeros, DoNotDependOnHubInertiaAndServeBothHubSensors) {
  const auto without = ExactArm(unit_arm(0.0, 0.5, 0.02));
  const auto with = ExactArm(unit_arm(7.0, 0.5, 0.02));
  EXPECT_EQ(without.hub_zero_lambdas(50), with.hub_zero_lambdas(50));
  EXPECT_EQ(with.zeros({arm::SensorKind::hub_angle}, 50).s_rad_per_s,
            with.zeros({arm::SensorKind::hub_velocity}, 50).s_rad_per_s);
}

}  // namespace
}  // namespace flexarm::exact_tf
