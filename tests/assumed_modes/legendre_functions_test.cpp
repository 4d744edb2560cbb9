#include "assumed_modes/legendre_functions.hpp"

#include <boost/math/quadrature/gauss.hpp>
#include <gtest/gtest.h>

#include <limits>

namespace flexarm::assumed_modes {
namespace {

constexpr int kCount = 12;
/// Integrands of degree 2 (kCount + 1) are exact with 15 points; the rest is rounding.
constexpr Real kRounding = 1000 * std::numeric_limits<Real>::epsilon();

Matrix gram(const LegendreFunctions& functions, int derivative) {
  Matrix sum = Matrix::Zero(kCount, kCount);
  const auto& points = boost::math::quadrature::gauss<Real, 20>::abscissa();
  const auto& weights = boost::math::quadrature::gauss<Real, 20>::weights();
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (const Real sign : {Real{-1}, Real{1}}) {
      const Vector values = functions.values((1 + sign * points[i]) / 2, derivative);
      sum += weights[i] / 2 * values * values.transpose();
    }
  }
  return sum;
}

TEST(LegendreFunctions, StrainEnergyIsTheIdentity) {
  const LegendreFunctions functions(kCount);
  EXPECT_LE((gram(functions, 2) - Matrix::Identity(kCount, kCount)).cwiseAbs().maxCoeff(),
            kRounding);
}

TEST(LegendreFunctions, MassMatchesGaussQuadratureOfExactDegree) {
  const LegendreFunctions functions(kCount);
  const Matrix mass = functions.integrals().mass;
  EXPECT_LE((gram(functions, 0) - mass).cwiseAbs().maxCoeff(), kRounding * mass.norm());
}

TEST(LegendreFunctions, RootIsClampedAndTheTipIsWhatTheIntegralsSay) {
  const LegendreFunctions functions(kCount);
  const Integrals integrals = functions.integrals();
  EXPECT_LE(functions.values(0, 0).cwiseAbs().maxCoeff(), kRounding);
  EXPECT_LE(functions.values(0, 1).cwiseAbs().maxCoeff(), kRounding);
  // psi(1) = int (1 - xi) psi'' and psi'(1) = int psi'': linear polynomials see P_0 and P_1 only.
  EXPECT_NEAR(static_cast<double>(integrals.tip(0)), 0.5, 1e-15);
  EXPECT_NEAR(static_cast<double>(integrals.tip_slope(0)), 1.0, 1e-15);
  EXPECT_LE(integrals.tip.tail(kCount - 2).cwiseAbs().maxCoeff(), kRounding);
  EXPECT_LE(integrals.tip_slope.tail(kCount - 1).cwiseAbs().maxCoeff(), kRounding);
}

TEST(LegendreFunctions, DerivativesFollowEachOther) {
  const LegendreFunctions functions(kCount);
  // Central differences: error h^2/6 times a third derivative of about kCount^4 here.
  constexpr Real kStep = 1e-6L;
  constexpr Real kDifferenceError = 1e-6L;
  for (const int derivative : {0, 1}) {
    const Vector difference =
        (functions.values(0.3L + kStep, derivative) - functions.values(0.3L - kStep, derivative)) /
        (2 * kStep);
    EXPECT_LE((difference - functions.values(0.3L, derivative + 1)).cwiseAbs().maxCoeff(),
              kDifferenceError);
  }
}

}  // namespace
}  // namespace flexarm::assumed_modes
