#include "diagnose/search/least_squares.hpp"

#include <Eigen/QR>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

namespace flexarm::diagnose {
namespace {

/// Residuals of a decay with three unknown numbers, which are 0.6, 0.3 and 0.2, and a rest that no
/// such numbers leave out, of this size.
Eigen::VectorXd decay(const Eigen::VectorXd& places, double rest) {
  const Eigen::ArrayXd t = Eigen::ArrayXd::LinSpaced(200, 0.0, 4.0);
  const auto model = [&](double a, double rate, double offset) {
    return Eigen::ArrayXd(a * (-10.0 * rate * t).exp() + offset);
  };
  return (model(places(0), places(1), places(2)) - model(0.6, 0.3, 0.2) + rest * (40.0 * t).sin())
      .matrix();
}

/// The part of the residuals' squares along the Jacobian: 0 at a minimum.
double part_along(const LeastSquares& found) {
  const Eigen::VectorXd turned =
      Eigen::HouseholderQR<Eigen::MatrixXd>(found.jacobian).householderQ().adjoint() *
      found.residuals;
  return turned.head(found.jacobian.cols()).squaredNorm() / found.residuals.squaredNorm();
}

TEST(LeastSquares, EndsAtAMinimumByDifferenceQuotients) {
  for (const double rest : {1e-3, 0.1}) {
    const LeastSquares found =
        least_squares([&](const Eigen::VectorXd& places) { return decay(places, rest); },
                      Eigen::Vector3d(0.4, 0.6, 0.4));
    EXPECT_TRUE(found.converged) << rest;
    EXPECT_LE(part_along(found), 1e-7) << rest;
  }
}

TEST(LeastSquares, UpdatesSaveMostDifferenceQuotients) {
  std::atomic<int> calls = 0;
  const LeastSquares found = least_squares(
      [&](const Eigen::VectorXd& places) {
        ++calls;
        return decay(places, 1e-3);
      },
      Eigen::Vector3d(0.5, 0.35, 0.3));
  EXPECT_EQ(found.evaluations, calls);
  // By difference quotients alone four evaluations for each of some five steps, and the Jacobian at
  // the end.
  EXPECT_LE(found.evaluations, 18);
}

// The valley turns: updates of the Jacobian mislead there.
TEST(LeastSquares, FollowsABentValley) {
  const LeastSquares found = least_squares(
      [](const Eigen::VectorXd& x) {
        return Eigen::VectorXd(Eigen::Vector2d(10.0 * (x(1) - x(0) * x(0)), 1.0 - x(0)));
      },
      Eigen::Vector2d(-1.2, 1.0), {.most_steps = 200, .tolerance = 1e-12});
  EXPECT_TRUE(found.converged);
  EXPECT_NEAR(found.places(0), 1.0, 1e-6);
  EXPECT_NEAR(found.places(1), 1.0, 1e-6);
}

}  // namespace
}  // namespace flexarm::diagnose
