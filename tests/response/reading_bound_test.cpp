// The bound that excludes a stop or a breakaway of the hub within a step.
#include "response/time/reading_bound.hpp"

#include "response/formulation_maker.hpp"
#include "response/time/arm_simulator.hpp"
#include "response/time/time_model.hpp"
#include "tests/response/propagated_step.hpp"
#include "tests/response/simulation_models.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <ostream>
#include <random>
#include <string>
#include <vector>

namespace flexarm::response {
namespace {

constexpr int kArmModes = 8;
constexpr double kLongest_s = 2e-3;
/// Beside the states that make a reading up: e^(A dt), and eigenvectors of condition 1e4.
constexpr double kBoundRounding = 1e-9;

struct BoundedArm {
  std::string name;
  double kelvin_voigt_s = 1e-4;
  std::string effect = {};
  std::map<std::string, double> parameters = {};
  bool is_settled = false;
};

void PrintTo(const BoundedArm& bounded, std::ostream* out) {
  *out << bounded.name;
}

const std::vector<BoundedArm> kBoundedArms = {
    {"lightly_damped"},
    {"undamped", 0.0},
    {"overdamped", 0.1},
    {"hub_spring", 1e-4, "hub_spring", {{"stiffness", 2.0}}},
    {"inverted", 1e-4, "gravity", {{"acceleration", -9.81}}},
    {"lag", 1e-4, "actuator_lag", {{"time_constant", 0.02}}},
    {"settled_lag", 0.1, "actuator_lag", {{"time_constant", 1e-6}}, true},
};

ModalDynamics bounded(const BoundedArm& given) {
  arm::Arm arm = arm::paper_arm();
  arm.payload = {0.05, 1e-4};
  arm.damping.kelvin_voigt_s = given.kelvin_voigt_s;
  if (!given.effect.empty()) {
    arm.effects[given.effect] = effects::effect(given.effect, given.parameters);
  }
  const ArmParts parts = take_apart(arm);
  const auto model = time_model(make_formulation("exact_tf", parts.linear, kArmModes), parts,
                                kArmModes, hub_sensors());
  const ModalDynamics made = modal_dynamics(model, parts, hub_sensors());
  return given.is_settled ? with_settled_torque(made) : made;
}

Reading watched_reading(const ModalDynamics& arm, bool is_held) {
  if (is_held) return arm.reaction;
  Reading speed{Eigen::RowVectorXd::Zero(arm.size()), 0.0, Eigen::RowVectorXd::Zero(1)};
  speed.state.segment(arm.modes, arm.modes) = arm.hub_slope.transpose();
  return speed;
}

double value(const Reading& reading, const Eigen::VectorXd& x, double u, double f) {
  return reading.state.dot(x) + reading.actuator * u + reading.force(0) * f;
}

/// One step of the arm and what the reading does in it.
struct WatchedStep {
  WatchedStep(const ModalDynamics& arm, bool is_held, const Eigen::VectorXd& x0, StepInputs inputs)
      : x1(x0.size()) {
    const Reading reading = watched_reading(arm, is_held);
    const LinearSystem& system = is_held ? arm.held : arm.turning;
    constexpr int kPlaces = 50;
    const double begin = value(reading, x0, inputs.u0, inputs.f0(0));
    std::vector<double> values;
    for (int i = 1; i <= kPlaces; ++i) {
      const double r = static_cast<double>(i) / kPlaces;
      const StepInputs until = part_of(inputs, 0.0, r);
      x1 = propagated(propagator(system, until.length_s), x0, until);
      values.push_back(value(reading, x1, until.u1, until.f1(0)));
    }
    for (int i = 1; i <= kPlaces; ++i) {
      const double chord = std::lerp(begin, values.back(), static_cast<double>(i) / kPlaces);
      departure = std::max(departure, std::abs(values[static_cast<std::size_t>(i - 1)] - chord));
    }
    least = std::min(begin, *std::ranges::min_element(values));
    largest = std::max(begin, *std::ranges::max_element(values));
    size = reading.state.cwiseAbs() * x0.cwiseAbs();
    const auto modes = std::make_shared<const ReadingModes>(arm, is_held, reading);
    ReadingBound::Workspace workspace;
    range = ReadingBound(modes, inputs.length_s, true)(x0, x1, inputs, workspace);
    sag = std::min(begin, values.back()) - range.least;
  }

  Eigen::VectorXd x1;
  double departure = 0.0;  ///< the largest from the chord
  double least = 0.0;
  double largest = 0.0;
  double size = 0.0;
  ReadingBound::Range range = {};
  double sag = 0.0;
};

class BoundOfAReading : public testing::TestWithParam<BoundedArm> {};

TEST_P(BoundOfAReading, HoldsForAnyStateAndInputs) {
  const ModalDynamics arm = bounded(GetParam());
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  const auto entries = [&](Eigen::Index count) -> Eigen::VectorXd {
    return Eigen::VectorXd::NullaryExpr(count, [&] { return normal(random); });
  };
  for (int trial = 0; trial < 20; ++trial) {
    const bool is_held = trial % 2 == 1;
    Eigen::VectorXd x = entries(arm.size());
    if (is_held) arm.stop_hub(x);
    const double length_s = kLongest_s * std::pow(10.0, -(trial % 4));
    const WatchedStep step(
        arm, is_held, x,
        {normal(random), normal(random), 0.0, length_s, entries(1), entries(1), entries(1)});
    EXPECT_LE(step.range.least, step.least + kBoundRounding * step.size) << trial;
    EXPECT_GE(step.range.largest, step.largest - kBoundRounding * step.size) << trial;
  }
}

TEST_P(BoundOfAReading, HoldsOverStepsOneAfterTheOther) {
  constexpr int kSteps = 8;
  const ModalDynamics arm = bounded(GetParam());
  const Reading speed = watched_reading(arm, false);
  const ReadingBound bound(std::make_shared<const ReadingModes>(arm, false, speed), kLongest_s,
                           false);
  ReadingBound::Workspace workspace;
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  const Eigen::VectorXd force = Eigen::VectorXd::Constant(1, 0.3);
  Eigen::VectorXd x = Eigen::VectorXd::NullaryExpr(arm.size(), [&] { return normal(random); });
  double u = normal(random);
  const auto [in_first, per_torque, growth] = bound.departure(x, u, force, workspace);
  double changed = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const WatchedStep step(arm, false, x, {u, u, 0.0, kLongest_s, force, force, force});
    EXPECT_LE(step.departure,
              std::pow(growth, i) * (in_first + per_torque * changed) + kBoundRounding * step.size)
        << i;
    x = step.x1;
    const double next = normal(random);
    changed += std::abs(next - u);
    u = next;
  }
}

/// Motions that the torque drives, and not their own: the bound is a few times what the reading
/// departs from its chord, also where modes decay in a ten-thousandth of the step.
TEST_P(BoundOfAReading, IsCloseWhereFastMotionsHaveDecayed) {
  constexpr double kTimes = 10.0;
  const ModalDynamics arm = bounded(GetParam());
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(1);
  for (const bool is_held : {false, true}) {
    const Propagator second = propagator(is_held ? arm.held : arm.turning, 1.0);
    const Eigen::VectorXd x = second.actuator_begin * 0.1 + second.actuator_end * 0.2;
    const WatchedStep step(arm, is_held, x, {0.2, 0.2, 0.0, kLongest_s, none, none, none});
    EXPECT_LE(step.sag, kTimes * step.departure + kBoundRounding * step.size) << is_held;
  }
}

INSTANTIATE_TEST_SUITE_P(Arms, BoundOfAReading, testing::ValuesIn(kBoundedArms),
                         [](const auto& given) { return given.param.name; });

/// Damping at which a pair of poles becomes one: there is no second eigenvector.
TEST(ReadingBound, ExcludesNothingItCannotExclude) {
  constexpr double kStiffness = 4.0;
  const ModalDynamics arm = modal_dynamics(oscillator(1.0, kStiffness, 2.0 * std::sqrt(kStiffness)),
                                           coulomb(0.1), hub_sensors());
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(1);
  const Eigen::VectorXd x = Eigen::Vector2d(1.0, 0.5);
  const WatchedStep step(arm, false, x, {0.0, 0.0, 0.0, 1.0, none, none, none});
  EXPECT_FALSE(step.range.least > step.least);
  EXPECT_FALSE(step.range.largest < step.largest);
}

/// A held hub without a beam: what holds it is the torque itself.
TEST(ReadingBound, OfARigidArmThatIsHeldIsTheTorque) {
  const ModalDynamics arm = modal_dynamics(oscillator(1.0, 0.0), coulomb(0.1), hub_sensors());
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(1);
  const Eigen::VectorXd x = Eigen::Vector2d(1.0, 0.0);
  const WatchedStep step(arm, true, x, {0.02, 0.05, 0.0, 1.0, none, none, none});
  EXPECT_DOUBLE_EQ(step.range.least, 0.02);
  EXPECT_DOUBLE_EQ(step.range.largest, 0.05);
}

/// A fit whose modes decay in nanoseconds takes a step a sample but where the hub stops.
TEST(ReadingBound, KeepsStepsLongBesideFrictionAndStrongDamping) {
  arm::Arm arm = arm::paper_arm();
  arm.damping.kelvin_voigt_s = 0.1;
  ArmParts parts = take_apart(arm);
  put(parts, "coulomb_friction", {{"torque", 0.02}});
  const auto model = time_model(make_formulation("exact_tf", parts.linear, kArmModes), parts,
                                kArmModes, hub_sensors());
  std::vector<double> torque = step_torque(0.1, 200);
  torque.resize(1000, -0.05);
  const SimulationOptions options = options_of_fit(kLongest_s, TorqueHold::zero);
  const auto made = simulate(model, parts, hub_sensors(), torque, options);
  EXPECT_GE(made.summary.stops + made.summary.reversals, 1);
  EXPECT_LT(made.summary.inner_steps, 1200);
}

}  // namespace
}  // namespace flexarm::response
