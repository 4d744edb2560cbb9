#include "assumed_modes/strain_functions.hpp"

#include <boost/math/quadrature/gauss.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace flexarm::assumed_modes {
namespace {

constexpr int kFunctions = 12;
/// Integrands of degree 2 (kFunctions + 1) + 1 are exact with 20 points; the rest is rounding.
constexpr Real kIntegralRounding = 1000 * std::numeric_limits<Real>::epsilon();
constexpr Real kCrack = 0.3L;

ScaledArm arm_with_everything() {
  ScaledArm arm;
  arm.hub_radius = 0.2L;
  arm.root_stiffness = 4;
  arm.crack = {kCrack, 2};
  arm.shear = {50, 0.01L};
  return arm;
}

/// Where the rule's 20 points lie on both sides of the crack, and their weights.
struct Points {
  std::vector<Real> xi;
  std::vector<Real> weight;
};

Points gauss_points() {
  using Rule = boost::math::quadrature::gauss<Real, 20>;
  Points points;
  for (const auto& [start, end] : {std::pair<Real, Real>{0, kCrack}, {kCrack, 1}}) {
    for (std::size_t i = 0; i < Rule::abscissa().size(); ++i) {
      for (const Real sign : {Real{-1}, Real{1}}) {
        points.xi.push_back((start + end + sign * (end - start) * Rule::abscissa()[i]) / 2);
        points.weight.push_back((end - start) / 2 * Rule::weights()[i]);
      }
    }
  }
  return points;
}

template <class Values, class Weight>
Matrix gram(const Values& values, const Weight& weight) {
  const Points points = gauss_points();
  Matrix sum;
  for (std::size_t i = 0; i < points.xi.size(); ++i) {
    const Vector at = values(points.xi[i]);
    if (sum.size() == 0) sum = Matrix::Zero(at.size(), at.size());
    sum += points.weight[i] * weight(points.xi[i]) * at * at.transpose();
  }
  return sum;
}

const auto kEven = [](Real) { return Real{1}; };

/// y' by the difference of two values on one piece, exact for polynomials up to the rounding of
/// 1/step.
Vector slope(const StrainFunctions& functions, Real xi) {
  // Eighth-order central difference; the ninth derivative of what kFunctions gives is below 1e16.
  constexpr Real kStep = 2e-3L;
  const auto y = [&](int k) { return functions.displacement(xi + static_cast<Real>(k) * kStep); };
  return ((y(1) - y(-1)) * 672 - (y(2) - y(-2)) * 168 + (y(3) - y(-3)) * 32 - (y(4) - y(-4)) * 3) /
         (840 * kStep);
}

TEST(StrainFunctions, OnAPlainBeamBendInOrthonormalPolynomials) {
  const StrainFunctions functions(ScaledArm{}, {.on_whole_beam = kFunctions});
  ASSERT_EQ(functions.size(), kFunctions + 1);
  Matrix expected = Matrix::Identity(kFunctions + 1, kFunctions + 1);
  expected(0, 0) = 0;
  const Matrix strain = gram([&](Real xi) { return functions.curvature(xi); }, kEven);
  EXPECT_LE((strain - expected).cwiseAbs().maxCoeff(), kIntegralRounding);
  EXPECT_EQ(functions.bends(), Vector(expected.diagonal()));
  // The rotation comes first: y = xi, psi = 1.
  EXPECT_EQ(functions.displacement(0.7L)(0), 0.7L);
  EXPECT_EQ(functions.rotation(0.7L)(0), 1);
  EXPECT_LE(functions.displacement(0).cwiseAbs().maxCoeff(), kIntegralRounding);
}

TEST(StrainFunctions, HaveAStrainEnergyOfOneEach) {
  const ScaledArm arm = arm_with_everything();
  const StrainFunctions functions(arm, {.on_whole_beam = kFunctions});
  // One rotation, root, crack, and kFunctions of bending and of shear on either side.
  ASSERT_EQ(functions.size(), 3 + 4 * kFunctions);
  Matrix energy = gram([&](Real xi) { return functions.curvature(xi); }, kEven);
  EXPECT_LE((energy.diagonal() - functions.bends()).cwiseAbs().maxCoeff(), kIntegralRounding);
  const Vector turn = functions.rotation(0) - functions.hub_rotation();
  energy += *arm.root_stiffness * turn * turn.transpose();
  constexpr Real kBeside = 1e-12L;
  const Vector jump =
      functions.rotation(kCrack + kBeside) - functions.rotation(kCrack - kBeside) -
      kBeside * (functions.curvature(kCrack + kBeside) + functions.curvature(kCrack - kBeside));
  energy += arm.crack->stiffness * jump * jump.transpose();
  // Shear strain away from the crack's ends of the difference formula.
  const Real at = 0.6L;
  const Vector strain = slope(functions, at) - functions.rotation(at);
  constexpr Real kDifference = 1e-9L;
  EXPECT_LE(strain.head(3 + 2 * kFunctions).cwiseAbs().maxCoeff(), kDifference);
  EXPECT_NEAR(static_cast<double>(strain(3 + 3 * kFunctions)),
              static_cast<double>(1 / std::sqrt(arm.shear->rigidity * (1 - kCrack))), 1e-9);
  Matrix expected = Matrix::Zero(functions.size(), functions.size());
  expected.diagonal().segment(1, 2 + 2 * kFunctions).setOnes();
  EXPECT_LE((energy - expected).cwiseAbs().maxCoeff(), 1e-9L);
}

TEST(StrainFunctions, StartAtTheHubAndAreWholeAtTheCrack) {
  const StrainFunctions functions(arm_with_everything(), {.on_whole_beam = kFunctions});
  Vector start = Vector::Zero(functions.size());
  start(0) = 0.2L;
  EXPECT_LE((functions.displacement(0) - start).cwiseAbs().maxCoeff(), kIntegralRounding);
  constexpr Real kBeside = 1e-15L;
  const Vector before = functions.displacement(kCrack - kBeside);
  const Vector behind = functions.displacement(kCrack + kBeside);
  EXPECT_LE((behind - before).cwiseAbs().maxCoeff(), 1e-13L);
}

/// An arm whose tension falls from `at_root` to `at_tip`.
ScaledArm hanging(Real at_root, Real at_tip) {
  constexpr Real kLeast = 1e-30L;
  ScaledArm arm;
  arm.weight = std::max(at_root - at_tip, kLeast);
  arm.payload_mass = at_tip / arm.weight;
  return arm;
}

TEST(StrainFunctions, ProductsMatchGaussQuadratureOfExactDegree) {
  const StrainFunctions functions(arm_with_everything(), {.on_whole_beam = kFunctions});
  const Matrix displacement = gram([&](Real xi) { return functions.displacement(xi); }, kEven);
  EXPECT_LE((functions.displacement_products() - displacement).cwiseAbs().maxCoeff(),
            kIntegralRounding * displacement.norm());
  const Matrix rotation = gram([&](Real xi) { return functions.rotation(xi); }, kEven);
  EXPECT_LE((functions.rotation_products() - rotation).cwiseAbs().maxCoeff(),
            kIntegralRounding * rotation.norm());
  for (const Matrix& matrix : {functions.displacement_products(), functions.rotation_products(),
                               functions.slope_products(hanging(3, 1))}) {
    EXPECT_EQ(matrix, matrix.transpose());
  }
}

TEST(StrainFunctions, SlopeProductsOfABeamWithoutShearAreThoseOfItsRotation) {
  ScaledArm arm = arm_with_everything();
  arm.shear.reset();
  const StrainFunctions functions(arm, {.on_whole_beam = kFunctions});
  const auto tension = [](Real xi) { return 3 - 2 * xi; };
  const Matrix expected = gram([&](Real xi) { return functions.rotation(xi); }, tension);
  EXPECT_LE((functions.slope_products(hanging(3, 1)) - expected).cwiseAbs().maxCoeff(),
            kIntegralRounding * expected.norm());
  const StrainFunctions sheared(arm_with_everything(), {.on_whole_beam = kFunctions});
  // int y' p of the rigid rotation with a shear function: the function's own integral.
  const Matrix products = sheared.slope_products(hanging(1, 1));
  for (Eigen::Index i = 0; i < sheared.size(); ++i) {
    const Real rise = sheared.displacement(1)(i) - sheared.displacement(0)(i);
    EXPECT_NEAR(static_cast<double>(products(0, i)), static_cast<double>(rise), 1e-15);
  }
}

TEST(StrainFunctions, ASuspendedMassMovesWithTheBeamButForItsOwnFunction) {
  constexpr Real kStiffness = 4;
  ScaledArm arm = arm_with_everything();
  arm.carried = {{0.3L, 1, 0, 0}, {0.8L, 1, kStiffness, 0}};
  const StrainFunctions functions(arm, {.on_whole_beam = kFunctions});
  EXPECT_EQ(functions.extension(0), Vector::Zero(functions.size()));
  EXPECT_EQ(functions.carried_displacement(0), functions.displacement(0.3L));
  // One rotation, root, crack: its own function comes next.
  constexpr Eigen::Index kOwn = 3;
  EXPECT_EQ(functions.extension(1), 0.5L * Vector::Unit(functions.size(), kOwn));
  EXPECT_EQ(functions.carried_displacement(1),
            functions.displacement(0.8L) + functions.extension(1));
  for (const Real xi : {0.1L, 0.5L, 0.8L, 1.0L}) {
    EXPECT_EQ(functions.displacement(xi)(kOwn), 0);
    EXPECT_EQ(functions.rotation(xi)(kOwn), 0);
  }
  EXPECT_EQ(functions.bends()(kOwn), 0);
}

TEST(StrainFunctions, ADriveTurnsHubAndBeamAgainstTheRotor) {
  ScaledArm arm = arm_with_everything();
  arm.drive = {0.05L, 4, 0};
  const StrainFunctions functions(arm, {.on_whole_beam = kFunctions});
  constexpr Eigen::Index kOwn = 1;
  EXPECT_EQ(functions.motor_rotation(), Vector::Unit(functions.size(), 0));
  EXPECT_EQ(functions.hub_rotation() - functions.motor_rotation(),
            0.5L * Vector::Unit(functions.size(), kOwn));
  constexpr Real kSumRounding = 10 * std::numeric_limits<Real>::epsilon();
  for (const Real xi : {0.0L, 0.1L, 0.5L, 1.0L}) {
    const Real along = functions.displacement(xi)(kOwn) - (arm.hub_radius + xi) / 2;
    EXPECT_LE(std::abs(along), kSumRounding);
    EXPECT_LE(std::abs(functions.rotation(xi)(kOwn) - 0.5L), kSumRounding);
    EXPECT_EQ(functions.curvature(xi)(kOwn), 0);
  }
  EXPECT_EQ(functions.bends()(kOwn), 0);
}

TEST(StrainFunctions, ShortPiecesGetFewerAndSpacesGrow) {
  ScaledArm arm;
  arm.crack = {0.07L, 2};
  Eigen::Index before = 0;
  for (int n = 1; n < 60; ++n) {
    const Eigen::Index size = StrainFunctions(arm, {.on_whole_beam = n}).size();
    EXPECT_GT(size, before);
    EXPECT_LE(size, 2 + n + std::min(n, 15) + 1);
    before = size;
    EXPECT_EQ(StrainFunctions(arm, {.on_whole_beam = n, .more = 3}).size(), size + 6);
  }
}

}  // namespace
}  // namespace flexarm::assumed_modes
