#include "response/time/propagator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace flexarm::response {
namespace {

constexpr int kHalvings = 6;
/// Of a product of matrices of norm about 1, each squaring doubling the error of what it squares.
constexpr double kSquaredRounding =
    64.0 * (1 << kHalvings) * std::numeric_limits<double>::epsilon();

/// Two oscillators with damping, with two forces.
LinearSystem oscillators(bool has_rate) {
  LinearSystem made;
  made.a = Eigen::MatrixXd::Zero(4, 4);
  made.a.topRightCorner(2, 2).setIdentity();
  made.a.bottomLeftCorner(2, 2) << -9.0, 2.0, 2.0, -40.0;
  made.a.bottomRightCorner(2, 2) << -0.3, 0.1, 0.1, -0.9;
  made.actuator = Eigen::Vector4d(0.0, 0.1, 1.0, -0.5);
  if (has_rate) made.actuator_rate = Eigen::Vector4d(0.02, -0.01, 0.3, 0.1);
  made.force = Eigen::MatrixXd::Zero(4, 2);
  made.force.bottomRows(2) << 1.0, 0.2, -0.4, 0.7;
  return made;
}

/// What acts in a step: u at both ends, and f at begin, middle and end.
struct StepOfInputs {
  double u0 = 0.3;
  double u1 = -0.2;
  Eigen::Vector2d f0 = {0.5, -0.1};
  Eigen::Vector2d fm = {0.2, 0.4};
  Eigen::Vector2d f1 = {-0.3, 0.6};

  Eigen::Vector2d force(double r) const {
    return f0 + r * (-3.0 * f0 + 4.0 * fm - f1) + r * r * (2.0 * f0 - 4.0 * fm + 2.0 * f1);
  }
  /// Of the part of the step from r to s.
  StepOfInputs part(double r, double s) const {
    return {std::lerp(u0, u1, r), std::lerp(u0, u1, s), force(r), force(0.5 * (r + s)), force(s)};
  }
};

Eigen::VectorXd end_of(const Propagator& to, const Eigen::VectorXd& x, const StepOfInputs& inputs) {
  return to.state * x + to.actuator_begin * inputs.u0 + to.actuator_end * inputs.u1 +
         to.force_begin * inputs.f0 + to.force_middle * inputs.fm + to.force_end * inputs.f1;
}

class PropagatorOf : public testing::TestWithParam<bool> {
 protected:
  const LinearSystem system_ = oscillators(GetParam());
  const double step_s_ = 0.7;
  const Eigen::VectorXd x_ = Eigen::Vector4d(0.4, -0.2, 1.0, 0.3);
  const StepOfInputs inputs_ = {};
};

TEST_P(PropagatorOf, AStepIsThatOfItsHalves) {
  const Propagator half = propagator(system_, 0.5 * step_s_);
  const Eigen::VectorXd middle = end_of(half, x_, inputs_.part(0.0, 0.5));
  const Eigen::VectorXd end = end_of(half, middle, inputs_.part(0.5, 1.0));
  EXPECT_LE((end_of(propagator(system_, step_s_), x_, inputs_) - end).norm(), kSquaredRounding);
}

TEST_P(PropagatorOf, HalvedStepsAreThoseFormedOneByOne) {
  for (const auto precision : {Precision::extended, Precision::working}) {
    const auto halved = halved_propagators(system_, step_s_, kHalvings, true, precision);
    ASSERT_EQ(halved.size(), kHalvings + 1U);
    for (int level = 0; level <= kHalvings; ++level) {
      const double length_s = std::ldexp(step_s_, -level);
      const StepPropagators& to = halved[static_cast<std::size_t>(level)];
      const Propagator alone = propagator(system_, length_s);
      EXPECT_LE((end_of(to.end, x_, inputs_) - end_of(alone, x_, inputs_)).norm(),
                kSquaredRounding);
      const Propagator to_middle = propagator(system_, 0.5 * length_s);
      EXPECT_LE(
          (end_of(to.middle.value(), x_, inputs_) - end_of(to_middle, x_, inputs_.part(0.0, 0.5)))
              .norm(),
          kSquaredRounding);
    }
  }
}

TEST_P(PropagatorOf, WithoutMiddleIsThatWithOne) {
  const auto with = halved_propagators(system_, step_s_, kHalvings, true, Precision::extended);
  const auto without = halved_propagators(system_, step_s_, kHalvings, false, Precision::extended);
  for (std::size_t level = 0; level < with.size(); ++level) {
    EXPECT_FALSE(without[level].middle);
    EXPECT_LE((with[level].end.state - without[level].end.state).norm(), kSquaredRounding);
  }
}

INSTANTIATE_TEST_SUITE_P(, PropagatorOf, testing::Bool(), [](const auto& given) {
  return given.param ? "ATorqueAndItsRate" : "ATorque";
});

}  // namespace
}  // namespace flexarm::response
