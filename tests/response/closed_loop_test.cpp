// Closed loops beside closed forms, beside loops written out, and beside the open loop of the
// torque that they made.
#include "arm/input_error.hpp"
#include "response/formulation_maker.hpp"
#include "response/time/arm_simulator.hpp"
#include "response/time/controller_run.hpp"
#include "response/time/time_model.hpp"
#include "tests/response/simulation_models.hpp"

#include <Eigen/LU>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <future>
#include <string>
#include <vector>

namespace flexarm::response {
namespace {

using arm::PidController;
using arm::StateSpaceController;

constexpr double kLoopStep_s = 2e-3;
constexpr double kInertia_kg_m2 = 0.05;
constexpr double kFriction_N_m_s_per_rad = 0.08;
/// A thousand samples, each with some ten roundings; the derivative multiplies those of the angle
/// by up to kd/period = 200 before the inertia takes them down again.
constexpr double kLoopRounding = 1e-11;

arm::Controller pid_of_hub(const PidController& law) {
  return {.sensors = {kHubAngle}, .law = law};
}

std::vector<double> square_wave(std::size_t samples, double size_rad) {
  std::vector<double> reference(samples);
  for (std::size_t k = 0; k < samples; ++k) {
    reference[k] = size_rad * static_cast<double>((3 * k / samples) % 2);
  }
  return reference;
}

/// A rigid hub whose next sample is known in closed form:
/// I theta'' + c theta' = u, u held, so that theta' decays to u/c.
struct HeldHub {
  double decay = std::exp(-kFriction_N_m_s_per_rad * kLoopStep_s / kInertia_kg_m2);
  double ratio_s = kInertia_kg_m2 / kFriction_N_m_s_per_rad;

  void step(double& angle, double& velocity, double torque) const {
    const double last = torque / kFriction_N_m_s_per_rad;
    angle += last * kLoopStep_s + (velocity - last) * ratio_s * (1.0 - decay);
    velocity = last + (velocity - last) * decay;
  }
};

ArmSimulator rigid_hub(const ArmParts& parts, double sample_time_s = kLoopStep_s) {
  return {oscillator(kInertia_kg_m2, 0.0, kFriction_N_m_s_per_rad), parts, hub_sensors(),
          options_of_fit(sample_time_s, TorqueHold::zero)};
}

double largest_difference(const Eigen::MatrixXd& one, const Eigen::MatrixXd& other) {
  return (one - other).cwiseAbs().maxCoeff();
}

TEST(ClosedLoop, OfARigidHubWithPdIsTheMatrixPower) {
  const double kp = 1.5;
  const double kd = 0.4;
  const double reference = 0.7;
  constexpr std::size_t kSamples = 1000;
  const HeldHub hub;
  // z = (theta, theta', e before, 1).
  Eigen::Matrix4d loop = Eigen::Matrix4d::Zero();
  const Eigen::RowVector4d error(-1.0, 0.0, 0.0, reference);
  const Eigen::RowVector4d torque =
      (kp + kd / kLoopStep_s) * error - kd / kLoopStep_s * Eigen::RowVector4d(0.0, 0.0, 1.0, 0.0);
  for (Eigen::Index j = 0; j < 4; ++j) {
    double angle = j == 0 ? 1.0 : 0.0;
    double velocity = j == 1 ? 1.0 : 0.0;
    hub.step(angle, velocity, torque(j));
    loop(0, j) = angle;
    loop(1, j) = velocity;
  }
  loop.row(2) = error;
  loop(3, 3) = 1.0;

  const ArmSimulator simulator = rigid_hub({});
  const auto made = simulator.closed_loop_readings(
      {pid_of_hub({.kp = kp, .kd = kd}), std::vector<double>(kSamples, reference)});
  ASSERT_EQ(made.readings.rows(), static_cast<Eigen::Index>(kSamples));
  // There is no derivative at the first sample: the error before it is the same.
  const Eigen::Vector4d start(0.0, 0.0, reference, 1.0);
  for (const int k : {0, 1, 2, 3, 10, 100, 500, 999}) {
    Eigen::Vector4d z = start;
    Eigen::Matrix4d power = loop;
    for (int left = k; left > 0; left /= 2) {
      if (left % 2 == 1) z = power * z;
      power = (power * power).eval();
    }
    EXPECT_NEAR(made.readings(k, 0), z(0), kLoopRounding) << k;
    EXPECT_NEAR(made.readings(k, 1), z(1), kLoopRounding * 10.0) << k;
    EXPECT_NEAR(made.torque_N_m[static_cast<std::size_t>(k)], torque.dot(z), kLoopRounding * 1e2)
        << k;
  }
  EXPECT_NEAR(made.readings(999, 0), reference, 1e-2);
}

/// The loop of a PID with limit around a rigid hub, written out.
struct WrittenOut {
  std::vector<double> angle_rad;
  std::vector<double> torque_N_m;
};

WrittenOut written_out(const PidController& law, double limit, int every,
                       const std::vector<double>& reference, bool conditional) {
  const HeldHub hub;
  WrittenOut made;
  double angle = 0.0, velocity = 0.0, integral = 0.0, before = 0.0, torque = 0.0;
  const double period = every * kLoopStep_s;
  for (std::size_t k = 0; k < reference.size(); ++k) {
    if (k % static_cast<std::size_t>(every) == 0) {
      const double e = reference[k] - angle;
      const double v = law.derivative == PidController::Derivative::error ? e : -angle;
      const double d = k == 0 ? 0.0 : (v - before) / period;
      before = v;
      const double whole = law.kp * e + law.kd * d + integral + law.ki * period * e;
      const bool is_stopped =
          conditional && std::abs(whole) > limit && (law.ki * e > 0.0) == (whole > 0.0);
      if (!is_stopped) integral += law.ki * period * e;
      torque = std::clamp(law.kp * e + law.kd * d + integral, -limit, limit);
    }
    made.angle_rad.push_back(angle);
    made.torque_N_m.push_back(torque);
    hub.step(angle, velocity, torque);
  }
  return made;
}

struct LoopCase {
  std::string name;
  PidController law;
  double limit_N_m = 1e9;
  int every = 1;
};

void PrintTo(const LoopCase& entry, std::ostream* out) {
  *out << entry.name;
}

class WrittenOutLoop : public testing::TestWithParam<LoopCase> {};

TEST_P(WrittenOutLoop, IsTheSimulatedOne) {
  const LoopCase& entry = GetParam();
  const auto reference = square_wave(3000, 0.8);
  arm::Controller controller = pid_of_hub(entry.law);
  controller.limit_N_m = entry.limit_N_m;
  if (entry.every > 1) controller.sample_time_s = entry.every * kLoopStep_s;
  const auto made = rigid_hub({}).closed_loop_readings({controller, reference});
  const auto expected = written_out(entry.law, entry.limit_N_m, entry.every, reference, true);
  for (std::size_t k = 0; k < reference.size(); ++k) {
    ASSERT_NEAR(made.readings(static_cast<Eigen::Index>(k), 0), expected.angle_rad[k], 1e-10) << k;
    ASSERT_NEAR(made.torque_N_m[k], expected.torque_N_m[k], 1e-8) << k;
    ASSERT_LE(std::abs(made.torque_N_m[k]), entry.limit_N_m);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Laws, WrittenOutLoop,
    testing::Values(LoopCase{"pi", {.kp = 1.0, .ki = 0.5}},
                    LoopCase{"pid", {.kp = 1.0, .kd = 0.2, .ki = 2.0}},
                    LoopCase{"derivative_of_measurement",
                             {.kp = 1.0,
                              .kd = 0.2,
                              .ki = 2.0,
                              .derivative = PidController::Derivative::measurement}},
                    LoopCase{"limit", {.kp = 1.0, .kd = 0.2}, 0.1},
                    LoopCase{"anti_windup", {.kp = 1.0, .kd = 0.2, .ki = 2.0}, 0.1},
                    LoopCase{"slow", {.kp = 0.5, .kd = 0.1, .ki = 0.5}, 1e9, 7},
                    LoopCase{"slow_with_limit", {.kp = 0.5, .kd = 0.1, .ki = 0.5}, 0.1, 7}),
    [](const auto& entry) { return entry.param.name; });

TEST(ClosedLoop, AntiWindupKeepsTheOvershootDown) {
  const PidController law{.kp = 1.0, .kd = 0.2, .ki = 2.0};
  const auto reference = std::vector<double>(3000, 2.0);
  arm::Controller controller = pid_of_hub(law);
  controller.limit_N_m = 0.1;
  const auto made = rigid_hub({}).closed_loop_readings({controller, reference});
  const auto wound_up = written_out(law, 0.1, 1, reference, false);
  EXPECT_LT(made.readings.col(0).maxCoeff() - 2.0,
            0.5 * (*std::ranges::max_element(wound_up.angle_rad) - 2.0));
}

TEST(ClosedLoop, AtASlowerControllerIsThatOfTheSlowerRecord) {
  const PidController law{.kp = 1.0, .kd = 0.2, .ki = 0.5};
  constexpr int kEvery = 5;
  const auto fine_reference = square_wave(2000, 0.4);
  std::vector<double> coarse_reference;
  for (std::size_t k = 0; k < fine_reference.size(); k += kEvery) {
    coarse_reference.push_back(fine_reference[k]);
  }
  arm::Controller controller = pid_of_hub(law);
  controller.sample_time_s = kEvery * kLoopStep_s;
  const auto fine = rigid_hub({}).closed_loop_readings({controller, fine_reference});
  const auto coarse =
      rigid_hub({}, kEvery * kLoopStep_s).closed_loop_readings({controller, coarse_reference});
  for (Eigen::Index k = 0; k < coarse.readings.rows(); ++k) {
    ASSERT_NEAR(fine.readings(kEvery * k, 0), coarse.readings(k, 0), kLoopRounding) << k;
  }
}

/// The PID with the derivative of the error, its state (I, e before).
arm::Controller as_state_space(const PidController& law, double period_s) {
  const double ki = law.ki * period_s;
  const double kd = law.kd / period_s;
  const double now = law.kp + ki + kd;
  return {.sensors = {kHubAngle},
          .law = StateSpaceController{.a = {{1.0, 0.0}, {0.0, 0.0}},
                                      .b = {{ki, -ki}, {1.0, -1.0}},
                                      .c = {{1.0, -kd}},
                                      .d = {{now, -now}}}};
}

TEST(ClosedLoop, OfAPidIsThatOfItsStateSpace) {
  const PidController law{.kp = 1.0, .kd = 0.2, .ki = 2.0};
  const auto reference = square_wave(2000, 0.8);  // begins at 0: no derivative at the first sample
  const auto one = rigid_hub({}).closed_loop_readings({pid_of_hub(law), reference});
  const auto other =
      rigid_hub({}).closed_loop_readings({as_state_space(law, kLoopStep_s), reference});
  EXPECT_LE(largest_difference(one.readings.col(0), other.readings.col(0)), 1e-11);
  EXPECT_GT(one.readings.col(0).maxCoeff(), 0.5);
}

TEST(ClosedLoop, BeginsWhereItsStatesAre) {
  const PidController law{.kp = 1.0, .kd = 0.2, .ki = 2.0};
  const auto reference = std::vector<double>(1500, 0.3);
  const ArmSimulator simulator = rigid_hub({});
  const auto whole = simulator.closed_loop_readings({pid_of_hub(law), reference});
  // With the state of a state space at a later sample the rest comes again.
  double integral = 0.0;
  constexpr Eigen::Index kLater = 400;
  for (Eigen::Index k = 0; k < kLater; ++k)
    integral += law.ki * kLoopStep_s * (0.3 - whole.readings(k, 0));
  Eigen::VectorXd state = Eigen::VectorXd::Zero(simulator.states());
  state(0) = whole.readings(kLater, 0);
  state(1) = whole.readings(kLater, 1);
  const std::vector<double> rest(1500 - kLater, 0.3);
  const auto later = simulator.closed_loop_readings(
      {as_state_space(law, kLoopStep_s), rest, {integral, 0.3 - whole.readings(kLater - 1, 0)}},
      state);
  EXPECT_LE(largest_difference(later.readings.col(0), whole.readings.col(0).tail(1500 - kLater)),
            1e-11);
}

/// A flexible arm with all that may stand between controller and hub, in closed loop.
class FlexibleLoop : public testing::Test {
 protected:
  FlexibleLoop() {
    arm_.damping.kelvin_voigt_s = 1.2e-4;
    arm_.hub.viscous_friction_N_m_s_per_rad = 2e-3;
    arm_.effects = {{"coulomb_friction", effects::effect("coulomb_friction", {{"torque", 0.01}})},
                    {"time_delay", effects::effect("time_delay", {{"delay", 3.1e-3}})},
                    {"actuator_lag", effects::effect("actuator_lag", {{"time_constant", 2e-3}})},
                    {"torque_saturation", effects::effect("torque_saturation", {{"limit", 0.1}})},
                    {"torque_bias", effects::effect("torque_bias", {{"torque", 2e-3}})}};
    sensors_ = {kHubAngle, kHubVelocity, kTipAcceleration};
    controller_ = pid_of_hub({.kp = 0.2, .kd = 0.06, .ki = 0.05});
    controller_.limit_N_m = 0.15;
    controller_.sample_time_s = 2.0 * kLoopStep_s;
  }

  ArmSimulator simulator(const SimulationOptions& options) const {
    const ArmParts parts = take_apart(arm_);
    return {time_model(make_formulation("exact_tf", arm_, 4), parts, 4, sensors_), parts, sensors_,
            options};
  }

  arm::Arm arm_ = arm::paper_arm();
  std::vector<arm::Sensor> sensors_;
  arm::Controller controller_;
};

TEST_F(FlexibleLoop, ReadsWhatTheOpenLoopOfItsTorqueReads) {
  const ArmSimulator made = simulator(options_of_fit(kLoopStep_s, TorqueHold::zero));
  const auto closed = made.closed_loop_readings({controller_, square_wave(3000, 0.5)});
  EXPECT_EQ(closed.readings, made.readings(closed.torque_N_m));
  // It follows, with the overshoot of a damping ratio of 0.3 and of the integral.
  EXPECT_NEAR(closed.readings.col(0).maxCoeff(), 0.75, 0.25);
  const auto [least, most] = std::ranges::minmax(closed.torque_N_m);
  EXPECT_EQ(least, -0.15);
  EXPECT_EQ(most, 0.15);
}

TEST_F(FlexibleLoop, RunsWithItsEnergyBalance) {
  SimulationOptions options;
  options.sample_time_s = kLoopStep_s;
  const ArmSimulator made = simulator(options);
  const ClosedLoop loop{controller_, square_wave(1500, 0.5)};
  const Simulation run = made.run(loop);
  const auto readings = made.closed_loop_readings(loop);
  EXPECT_EQ(run.commanded_torque_N_m, readings.torque_N_m);
  EXPECT_GT(run.energy.work_in_J, 0.0);
  EXPECT_GT(run.energy.dry_friction_J, 0.0);
  EXPECT_LE(std::abs(run.energy.residual_J()), 1e-9 * run.energy.work_in_J);
  for (Eigen::Index k = 0; k < readings.readings.rows(); ++k) {
    ASSERT_NEAR(run.channels[0][static_cast<std::size_t>(k)], readings.readings(k, 0), 1e-9) << k;
  }
}

TEST_F(FlexibleLoop, IsTheSameFromSeveralThreads) {
  const ArmSimulator made = simulator(options_of_fit(kLoopStep_s, TorqueHold::zero));
  const ClosedLoop loop{controller_, square_wave(1500, 0.5)};
  const auto alone = made.closed_loop_readings(loop);
  std::vector<std::future<ClosedLoopReadings>> calls;
  for (int i = 0; i < 4; ++i) {
    calls.push_back(
        std::async(std::launch::async, [&] { return made.closed_loop_readings(loop); }));
  }
  for (auto& call : calls) {
    const auto again = call.get();
    EXPECT_EQ(again.readings, alone.readings);
    EXPECT_EQ(again.torque_N_m, alone.torque_N_m);
  }
}

TEST_F(FlexibleLoop, ReadsAnAccelerationBeforeItsOwnJump) {
  arm_.effects.clear();
  // Torque by the tip's acceleration alone, after a first sample that the reference makes.
  controller_ = {.sensors = {kTipAcceleration}, .law = StateSpaceController{.d = {{1.0, -1e-4}}}};
  std::vector<double> reference(400, 0.0);
  reference[0] = 0.05;
  const ArmSimulator made = simulator(options_of_fit(kLoopStep_s, TorqueHold::zero));
  const auto closed = made.closed_loop_readings({controller_, reference});
  EXPECT_EQ(closed.torque_N_m[0], 0.05);
  // Behind sample k the torque of sample k - 1 still acts: the reading without this jump.
  std::vector<double> torque = closed.torque_N_m;
  for (const std::size_t k : {1UL, 2UL, 50UL}) {
    std::vector<double> held(torque.begin(), torque.begin() + static_cast<std::ptrdiff_t>(k));
    held.push_back(held.back());
    const Eigen::MatrixXd before = made.readings(held);
    EXPECT_NEAR(torque[k], -1e-4 * before(static_cast<Eigen::Index>(k), 2), 1e-15) << k;
  }
}

/// Gain, offset and delay of the sensor that the controller reads: it commands by the readings.
TEST_F(FlexibleLoop, ReadsItsSensorAsItIs) {
  arm_.effects.insert(effects::named("sensor_gain", {{"factor", 0.8}}, "hub_angle"));
  arm_.effects.insert(effects::named("sensor_offset", {{"value", 0.05}}, "hub_angle"));
  const auto reference = square_wave(3000, 0.5);
  for (const double late_samples : {0.4, 1.0, 2.3, 4.0}) {
    arm_.effects["sensor_delay"] =
        effects::effect("sensor_delay", {{"delay", late_samples * kLoopStep_s}}, "hub_angle");
    const ArmSimulator made = simulator(options_of_fit(kLoopStep_s, TorqueHold::zero));
    const auto closed = made.closed_loop_readings({controller_, reference});
    EXPECT_EQ(closed.readings, made.readings(closed.torque_N_m)) << late_samples;
    EXPECT_EQ(closed.readings(0, 0), 0.05);
    ControllerRun controller(controller_, 2.0 * kLoopStep_s, {});
    for (std::size_t k = 0; k < reference.size(); k += 2) {
      const double read = closed.readings(static_cast<Eigen::Index>(k), 0);
      ASSERT_NEAR(closed.torque_N_m[k], controller.command(reference[k], {&read, 1}), 1e-11)
          << late_samples << ", " << k;
    }
    EXPECT_GT(closed.readings.col(0).maxCoeff(), 0.4);
  }
}

TEST_F(FlexibleLoop, ReadsALateAccelerationBeforeTheJumpAtTheDelayedInstant) {
  arm_.effects.clear();
  const ArmSimulator on_time = simulator(options_of_fit(kLoopStep_s, TorqueHold::zero));
  arm_.effects["sensor_delay"] =
      effects::effect("sensor_delay", {{"delay", 2.0 * kLoopStep_s}}, "tip_acceleration");
  controller_ = {.sensors = {kTipAcceleration}, .law = StateSpaceController{.d = {{1.0, -1e-4}}}};
  std::vector<double> reference(400, 0.0);
  reference[0] = 0.05;
  const auto closed = simulator(options_of_fit(kLoopStep_s, TorqueHold::zero))
                          .closed_loop_readings({controller_, reference});
  EXPECT_EQ(closed.torque_N_m[2], 0.0) << "before the jump at the first sample";
  for (const std::size_t k : {3UL, 4UL, 50UL}) {
    const auto jump = static_cast<std::ptrdiff_t>(k) - 2;
    std::vector<double> held(closed.torque_N_m.begin(), closed.torque_N_m.begin() + jump);
    held.push_back(held.back());
    EXPECT_NEAR(closed.torque_N_m[k], -1e-4 * on_time.readings(held)(jump, 2), 1e-15) << k;
  }
}

void expect_refused(const arm::Controller& controller, const std::string& fault,
                    TorqueHold hold = TorqueHold::zero, std::vector<double> reference = {0.0, 1.0},
                    std::vector<double> state = {}) {
  const ArmSimulator simulator(oscillator(kInertia_kg_m2, 0.0, kFriction_N_m_s_per_rad), {},
                               hub_sensors(), options_of_fit(kLoopStep_s, hold));
  try {
    simulator.closed_loop_readings({controller, std::move(reference), std::move(state)});
    ADD_FAILURE() << "taken; expected: " << fault;
  } catch (const arm::InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr(fault));
  }
}

TEST(ClosedLoop, RefusesWhatCannotBe) {
  const arm::Controller good = pid_of_hub({.kp = 1.0});
  expect_refused(good, "torque hold: must be zero-order", TorqueHold::first);
  expect_refused(good, "reference: there are no samples", TorqueHold::zero, {});
  expect_refused(good, "reference = nan at sample 1", TorqueHold::zero, {0.0, std::nan("")});
  expect_refused(good, "state of the controller: 2 numbers; must be 1", TorqueHold::zero,
                 {0.0, 1.0}, {0.0, 0.0});
  arm::Controller other = good;
  other.sample_time_s = 3e-3;
  expect_refused(other, "sample_time = 0.003 s: must be a whole multiple of the period");
  other = good;
  other.sensors = {kTipAcceleration};
  expect_refused(other, "its sensor tip_acceleration is not simulated");
  expect_refused(pid_of_hub({}), "does not close the loop");
  // The wrong sign: the loop falls over faster than any number.
  expect_refused(pid_of_hub({.kp = -1e9, .kd = -1e9}), "numeric overflow", TorqueHold::zero,
                 std::vector<double>(4000, 1.0));
}

}  // namespace
}  // namespace flexarm::response
