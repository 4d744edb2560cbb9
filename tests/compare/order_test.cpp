#include "compare/refinement.hpp"
#include "tests/compare/models.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <stdexcept>

namespace flexarm::compare {
namespace {

/// How close to the theory's order a fitted one must come.
constexpr double kOrderTolerance = 0.1;

Refinement named(const std::string& name) {
  for (auto& refinement : standard_refinements(arm::paper_arm(), 5)) {
    if (refinement.name == name) return refinement;
  }
  throw std::invalid_argument(name);
}

std::vector<RefinementCurve> cubic_curves(const FeatureFamily& family) {
  Refinement cubic = named("fem, cubic elements");
  // Finer meshes only add to the floor.
  std::erase_if(cubic.settings, [](int elements) { return elements > 512; });
  const auto exact = roots(exact_tf::ExactArm(arm::paper_arm()), family);
  return refine(arm::paper_arm(), cubic, family, exact.s_rad_per_s, 1e-9);
}

void expect_fourth_order(const FeatureFamily& family) {
  const auto curves = cubic_curves(family);
  ASSERT_EQ(std::ssize(curves), family.count);
  for (const auto& curve : curves) {
    ASSERT_TRUE(curve.convergence.rate) << label(family) << " " << curve.order;
    EXPECT_NEAR(*curve.convergence.rate, 4.0, kOrderTolerance)
        << label(family) << " " << curve.order;
    std::cout << label(family) << " " << curve.order << ": order " << *curve.convergence.rate
              << " over " << curve.convergence.points_fitted << " points\n";
  }
}

TEST(Order, CubicElementsConvergeInPolesWithOrderFour) {
  expect_fourth_order({std::nullopt, 5});
}

TEST(Order, CubicElementsConvergeInHubZerosWithOrderFour) {
  expect_fourth_order({kHubAngle, 5});
}

TEST(Order, CubicElementsConvergeInTipZerosWithOrderFour) {
  expect_fourth_order({kTipAcceleration, 2});
}

TEST(Order, TenPolesAreReachedWithinTheIssuesDegreesOfFreedom) {
  // The project's figures: at most 60 degrees of freedom of fem, at most 36 functions, for 1e-10.
  const FeatureFamily family{std::nullopt, 10};
  const auto exact = roots(exact_tf::ExactArm(arm::paper_arm()), family);
  const auto most_needed = [&](const Refinement& refinement) {
    int dof = 0;
    for (const auto& curve :
         refine(arm::paper_arm(), refinement, family, exact.s_rad_per_s, 1e-10)) {
      EXPECT_TRUE(curve.convergence.cheapest) << refinement.name << " pole " << curve.order;
      if (curve.convergence.cheapest) {
        dof = std::max(dof, curve.convergence.cheapest->degrees_of_freedom);
      }
    }
    return dof;
  };
  const auto series = standard_refinements(arm::paper_arm(), 10);
  const auto named_series = [&](const std::string& name) {
    const auto found = std::ranges::find(series, name, &Refinement::name);
    EXPECT_NE(found, series.end()) << name;
    return found;
  };
  const auto legendre = named_series("Legendre polynomials");
  const auto fem = named_series("fem, 5 elements of increasing degree");
  ASSERT_TRUE(legendre != series.end() && fem != series.end());
  EXPECT_LE(most_needed(*legendre), 36);
  EXPECT_LE(most_needed(*fem), 60);
}

TEST(Order, ASettingTooCoarseForARootHasNoError) {
  const FeatureFamily family{std::nullopt, 4};
  const auto exact = roots(exact_tf::ExactArm(arm::paper_arm()), family);
  Refinement legendre = named("Legendre polynomials");
  legendre.settings = {3, 12};
  const auto curves = refine(arm::paper_arm(), legendre, family, exact.s_rad_per_s, 1e-9);
  EXPECT_FALSE(std::isnan(curves[1].points[0].relative_error));
  EXPECT_TRUE(std::isnan(curves[2].points[0].relative_error)) << "three functions, two modes";
  EXPECT_FALSE(std::isnan(curves[2].points[1].relative_error));
}

}  // namespace
}  // namespace flexarm::compare
