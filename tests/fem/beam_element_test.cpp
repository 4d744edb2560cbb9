#include "fem/beam_element.hpp"

#include "arm/input_error.hpp"
#include "tests/fem/constants.hpp"

#include <Eigen/Core>
#include <boost/math/quadrature/gauss.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace flexarm::fem {
namespace {

/// Exact to degree 59, above any product of two shape functions tested.
using Gauss = boost::math::quadrature::gauss<double, 30>;

/// Coefficients of the derivative of a Legendre series in xi:
/// P_j' = sum (2k + 1) P_k over k = j - 1, j - 3, ...
Eigen::MatrixXd derivative(const Eigen::MatrixXd& series) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(series.rows(), series.cols());
  for (int j = 1; j < series.cols(); ++j) {
    for (int k = j - 1; k >= 0; k -= 2) result.col(k) += (2.0 * k + 1.0) * series.col(j);
  }
  return result;
}

Eigen::MatrixXd integral_of_products(const Eigen::MatrixXd& series, double h) {
  const int n = static_cast<int>(series.rows());
  Eigen::MatrixXd integral(n, n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      integral(i, j) = Gauss::integrate(
          [&](double xi) {
            const Eigen::VectorXd p = legendre_values(n - 1, xi);
            return series.row(i).dot(p) * series.row(j).dot(p) * h / 2.0;
          },
          -1.0, 1.0);
    }
  }
  return integral;
}

/// |a - b| <= tolerance sqrt(b_ii b_jj), entry by entry: independent of the coordinates' units.
void expect_near(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, double tolerance) {
  for (int i = 0; i < b.rows(); ++i) {
    for (int j = 0; j < b.cols(); ++j) {
      EXPECT_NEAR(a(i, j), b(i, j), tolerance * std::sqrt(b(i, i) * b(j, j))) << i << ", " << j;
    }
  }
}

class BeamElementTest : public ::testing::TestWithParam<int> {};

TEST_P(BeamElementTest, ShapeFunctionsAreUnitDeflectionsAndSlopesAtTheEnds) {
  const int degree = GetParam();
  const double h = 0.37;
  const Eigen::MatrixXd series = BeamElement(degree).deflection(h);
  const Eigen::MatrixXd slopes = derivative(series) * (2.0 / h);
  Eigen::MatrixXd ends(degree + 1, 4);
  ends << series * legendre_values(degree, -1.0), slopes * legendre_values(degree, -1.0),
      series * legendre_values(degree, 1.0), slopes * legendre_values(degree, 1.0);
  const Eigen::MatrixXd expected = Eigen::MatrixXd::Identity(degree + 1, 4);
  EXPECT_LT((ends - expected).cwiseAbs().maxCoeff(), 10.0 * kEpsilon);
}

TEST_P(BeamElementTest, BubblesHaveLegendrePolynomialsAsCurvature) {
  const int degree = GetParam();
  const double h = 0.37;
  const Eigen::MatrixXd curvature =
      derivative(derivative(BeamElement(degree).deflection(h))) * (4.0 / (h * h));
  for (int k = 2; k <= degree - 2; ++k) {
    const Eigen::RowVectorXd expected = Eigen::RowVectorXd::Unit(degree + 1, k);
    // Two derivatives multiply rounding by up to the fourth power of the degree.
    EXPECT_LT((curvature.row(k + 2) - expected).cwiseAbs().maxCoeff(),
              std::pow(degree, 4) * kEpsilon);
  }
}

TEST_P(BeamElementTest, MassIsTheIntegralOfProductsOfShapeFunctions) {
  const double h = 0.37;
  const BeamElement element(GetParam());
  // Sums of some thirty terms.
  expect_near(element.mass(h), integral_of_products(element.deflection(h), h), 100.0 * kEpsilon);
}

INSTANTIATE_TEST_SUITE_P(Degrees, BeamElementTest, ::testing::Values(3, 4, 7, 13, 25));

TEST(BeamElement, CubicMassIsTheTextbookMatrix) {
  const double h = 2.0;
  Eigen::Matrix4d expected;
  expected << 156.0, 22.0 * h, 54.0, -13.0 * h,       //
      22.0 * h, 4.0 * h * h, 13.0 * h, -3.0 * h * h,  //
      54.0, 13.0 * h, 156.0, -22.0 * h,               //
      -13.0 * h, -3.0 * h * h, -22.0 * h, 4.0 * h * h;
  expected *= h / 420.0;
  expect_near(BeamElement(3).mass(h), expected, 10.0 * kEpsilon);
}

TEST(BeamElement, DegreesOutOfRangeAreRefused) {
  EXPECT_THROW(BeamElement(2), arm::InputError);
  EXPECT_THROW(BeamElement(BeamElement::kHighestDegree + 1), arm::InputError);
}

}  // namespace
}  // namespace flexarm::fem
