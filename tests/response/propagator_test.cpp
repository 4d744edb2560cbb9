#include "tests/response/propagated_step.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

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

class PropagatorOf : public testing::TestWithParam<bool> {
 protected:
  const LinearSystem system_ = oscillators(GetParam());
  const double step_s_ = 0.7;
  const Eigen::VectorXd x_ = Eigen::Vector4d(0.4, -0.2, 1.0, 0.3);
  const StepInputs inputs_ = {.u0 = 0.3,
                              .u1 = -0.2,
                              .length_s = step_s_,
                              .f0 = Eigen::Vector2d(0.5, -0.1),
                              .fm = Eigen::Vector2d(0.2, 0.4),
                              .f1 = Eigen::Vector2d(-0.3, 0.6)};
};

TEST_P(PropagatorOf, AStepIsThatOfItsHalves) {
  const Propagator half = propagator(system_, 0.5 * step_s_);
  const Eigen::VectorXd middle = propagated(half, x_, part_of(inputs_, 0.0, 0.5));
  const Eigen::VectorXd end = propagated(half, middle, part_of(inputs_, 0.5, 1.0));
  EXPECT_LE((propagated(propagator(system_, step_s_), x_, inputs_) - end).norm(), kSquaredRounding);
}

TEST_P(PropagatorOf, HalvedStepsAreThoseFormedOneByOne) {
  for (const auto precision : {Precision::extended, Precision::working}) {
    const auto halved = halved_propagators(system_, step_s_, kHalvings, true, precision);
    ASSERT_EQ(halved.size(), kHalvings + 1U);
    for (int level = 0; level <= kHalvings; ++level) {
      const double length_s = std::ldexp(step_s_, -level);
      const StepPropagators& to = halved[static_cast<std::size_t>(level)];
      const Propagator alone = propagator(system_, length_s);
      EXPECT_LE((propagated(to.end, x_, inputs_) - propagated(alone, x_, inputs_)).norm(),
                kSquaredRounding);
      const Propagator to_middle = propagator(system_, 0.5 * length_s);
      EXPECT_LE((propagated(to.middle.value(), x_, inputs_) -
                 propagated(to_middle, x_, part_of(inputs_, 0.0, 0.5)))
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
