#include "assumed_modes/beam_shapes.hpp"

#include "assumed_modes/beam_frequencies.hpp"

#include <boost/math/constants/constants.hpp>
#include <boost/math/quadrature/gauss.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace flexarm::assumed_modes {
namespace {

constexpr int kShapes = 60;
constexpr Real kPi = boost::math::constants::pi<Real>();
constexpr Real kEpsilon = std::numeric_limits<Real>::epsilon();
/// A value of the shape with the argument lambda = 190 is rounded in its 190th unit.
constexpr Real kShapeRounding = 1000 * kEpsilon;

struct Payload {
  Real mass_ratio;
  Real inertia_ratio;
};
const std::vector<Payload> kPayloads = {{0, 0},    {1e-6L, 0}, {0.3L, 0},     {10, 0},
                                        {0, 0.1L}, {0, 1e-6L}, {0.5L, 0.02L}, {10, 0.1L}};

TEST(BeamFrequencies, KnownRootsOfTheClassicalBeams) {
  // [Blevins1979], table 8-1: seven digits.
  const auto clamped_free = clamped_free_frequencies(3);
  EXPECT_NEAR(static_cast<double>(clamped_free[0]), 1.87510407, 1e-8);
  EXPECT_NEAR(static_cast<double>(clamped_free[1]), 4.69409113, 1e-8);
  EXPECT_NEAR(static_cast<double>(clamped_free[2]), 7.85475744, 1e-8);
  const auto pinned_free = pinned_free_frequencies(2);
  EXPECT_NEAR(static_cast<double>(pinned_free[0]), 3.92660231, 1e-8);
  EXPECT_NEAR(static_cast<double>(pinned_free[1]), 7.06858275, 1e-8);
}

TEST(BeamFrequencies, HighRootsTendToTheirAsymptotes) {
  const auto clamped_free = clamped_free_frequencies(kShapes);
  const auto pinned_free = pinned_free_frequencies(kShapes);
  for (int i = 20; i <= kShapes; ++i) {
    const auto k = static_cast<std::size_t>(i) - 1;
    const auto index = static_cast<Real>(i);
    EXPECT_LE(std::abs(clamped_free[k] / ((index - 0.5L) * kPi) - 1), 4 * kEpsilon);
    EXPECT_LE(std::abs(pinned_free[k] / ((index + 0.25L) * kPi) - 1), 4 * kEpsilon);
  }
}

TEST(BeamFrequencies, APayloadTakesTheClampedBeamToItsLimits) {
  // No payload: clamped-free. A mass alone, ever heavier: one root to zero, 3/eta = lambda^4, the
  // others to clamped-pinned, tan lambda = tanh lambda. The change is of order 1/eta.
  constexpr Real kHeavy = 1e8L;
  const auto heavy = clamped_payload_frequencies(10, kHeavy, 0);
  const auto pinned = pinned_free_frequencies(9);
  EXPECT_NEAR(static_cast<double>(std::pow(heavy[0], 4) * kHeavy / 3), 1.0, 1e-7);
  for (std::size_t i = 0; i < pinned.size(); ++i) {
    EXPECT_NEAR(static_cast<double>(heavy[i + 1] / pinned[i]), 1.0, 1e-7) << i;
  }
  const auto light = clamped_payload_frequencies(10, 1e-30L, 1e-30L);
  const auto none = clamped_free_frequencies(10);
  for (std::size_t i = 0; i < none.size(); ++i) {
    EXPECT_NEAR(static_cast<double>(light[i] / none[i]), 1.0, 1e-15) << i;
  }
}

TEST(BeamFrequencies, AddedInertiaLowersEachRootNotBelowTheOneBefore) {
  std::vector<Real> before = clamped_free_frequencies(kShapes);
  for (const Payload payload :
       {Payload{0.1L, 0}, Payload{2, 0}, Payload{2, 0.01L}, Payload{2, 1}}) {
    const auto after =
        clamped_payload_frequencies(kShapes, payload.mass_ratio, payload.inertia_ratio);
    for (std::size_t i = 0; i < before.size(); ++i) {
      EXPECT_LE(after[i], before[i]);
      if (i > 0) {
        EXPECT_GE(after[i], before[i - 1]);
      }
    }
    before = after;
  }
}

TEST(BeamShapes, MeetTheirBoundaryConditions) {
  for (const Payload payload : kPayloads) {
    const BeamShapes shapes =
        BeamShapes::clamped(kShapes, payload.mass_ratio, payload.inertia_ratio);
    for (const BeamShape& shape : shapes.shapes()) {
      const Real lambda = shape.lambda;
      // Each derivative over lambda^order, in units of the largest term of the shape.
      const auto scaled = [&](Real xi, int order) {
        return shape.value(xi, order) /
               (std::pow(lambda, static_cast<Real>(order)) *
                std::max(std::abs(shape.from_root), std::abs(shape.from_tip)));
      };
      const Real mass = lambda * payload.mass_ratio;
      const Real inertia = std::pow(lambda, 3) * payload.inertia_ratio;
      EXPECT_LE(std::abs(scaled(0, 0)), kShapeRounding);
      EXPECT_LE(std::abs(scaled(0, 1)), kShapeRounding);
      EXPECT_LE(std::abs(scaled(1, 3) + mass * scaled(1, 0)) / (1 + mass), kShapeRounding);
      EXPECT_LE(std::abs(scaled(1, 2) - inertia * scaled(1, 1)) / (1 + inertia), kShapeRounding);
    }
  }
  const BeamShapes pinned_free = BeamShapes::pinned_free(kShapes);
  for (const BeamShape& shape : pinned_free.shapes()) {
    EXPECT_LE(std::abs(shape.value(0, 0)) * std::pow(shape.lambda, 2), kShapeRounding);
    EXPECT_LE(std::abs(shape.value(0, 2)), kShapeRounding);
    EXPECT_LE(std::abs(shape.value(1, 2)), kShapeRounding);
    EXPECT_LE(std::abs(shape.value(1, 3)) / shape.lambda, kShapeRounding);
  }
}

/// sum over `panels` of a 20-point Gauss rule of values values^T, or of `with` values^T.
Matrix gram(const BeamShapes& shapes, int derivative, int panels) {
  const auto n = static_cast<Eigen::Index>(shapes.shapes().size());
  Matrix sum = Matrix::Zero(n + 1, n);
  const auto& points = boost::math::quadrature::gauss<Real, 20>::abscissa();
  const auto& weights = boost::math::quadrature::gauss<Real, 20>::weights();
  const Real half = Real{0.5L} / static_cast<Real>(panels);
  for (int panel = 0; panel < panels; ++panel) {
    const Real centre = static_cast<Real>(2 * panel + 1) * half;
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (const Real sign : {Real{-1}, Real{1}}) {
        const Real xi = centre + sign * half * points[i];
        const Vector values = shapes.values(xi, derivative);
        sum.topRows(n) += half * weights[i] * values * values.transpose();
        sum.row(n) += half * weights[i] * xi * values.transpose();
      }
    }
  }
  return sum;
}

/// The payload's share, up to 30 times the beam's own, is taken out of the integrals of the shapes
/// that carry it, and their terms cancel in turn at the lowest root, lambda = 0.7.
constexpr Real kCancellation = 100'000 * kEpsilon;

/// Closed forms against quadrature, each entry in units of the diagonal of its shapes; the
/// quadrature itself is shown to be adequate by twice the panels.
void expect_integrals_match(const BeamShapes& shapes) {
  constexpr int kPanels = 16;
  const auto n = static_cast<Eigen::Index>(shapes.shapes().size());
  const Matrix energy = gram(shapes, 2, kPanels);
  EXPECT_LE((energy - gram(shapes, 2, 2 * kPanels)).cwiseAbs().maxCoeff(), kShapeRounding);
  EXPECT_LE((energy.topRows(n) - Matrix::Identity(n, n)).cwiseAbs().maxCoeff(), kShapeRounding);

  const Integrals integrals = shapes.integrals();
  const Matrix kinetic = gram(shapes, 0, kPanels);
  const Vector size = kinetic.topRows(n).diagonal().cwiseSqrt();
  const Vector unit = size.cwiseInverse();
  EXPECT_LE((unit.asDiagonal() * (kinetic.topRows(n) - integrals.mass) * unit.asDiagonal())
                .cwiseAbs()
                .maxCoeff(),
            kCancellation);
  EXPECT_LE(
      (kinetic.row(n).transpose() - integrals.moment).cwiseProduct(unit).cwiseAbs().maxCoeff(),
      kCancellation);
}

TEST(BeamShapes, ClosedFormsMatchQuadrature) {
  constexpr int kFewer = 30;
  for (const Payload payload : kPayloads) {
    SCOPED_TRACE(testing::Message() << "mass " << static_cast<double>(payload.mass_ratio)
                                    << ", inertia " << static_cast<double>(payload.inertia_ratio));
    expect_integrals_match(BeamShapes::clamped(kFewer, payload.mass_ratio, payload.inertia_ratio));
  }
  expect_integrals_match(BeamShapes::pinned_free(kFewer));
}

}  // namespace
}  // namespace flexarm::assumed_modes
