// An FMU moves as `flexarm simulate`, whichever version of the standard.
#include "arm/controller.hpp"
#include "effects/registry/vocabulary.hpp"
#include "export/fmu/embedded_files.hpp"
#include "export/fmu/fmu_export.hpp"
#include "response/formulation_maker.hpp"
#include "response/time/arm_simulator.hpp"
#include "response/time/controller_run.hpp"
#include "response/time/time_model.hpp"
#include "tests/export/imported_arm.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <random>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace flexarm::testing_export {
namespace {

using arm::SensorKind;
using fmu::FmiVersion;

constexpr double kPeriod_s = 0.002;
constexpr std::size_t kSamples = 400;
/// Both are the same arithmetic, so that rounding alone is left: 1e-12 of the largest reading.
constexpr double kSameMotion = 1e-12;
/// Where communication points are not samples, linear motions are exact, step by step.
constexpr double kExactSteps = 1e-10;
/// ... and forces that vary are solved with other steps. These are as short as the fastest mode
/// asks for, rounded to a whole number in each part: up to twice as long as those of `simulate`,
/// with 2^4 times their error.
constexpr double kOtherSteps = 16.0;

struct MotionCase {
  std::string name;
  arm::Effects effects = {};
};

const std::vector<MotionCase>& motion_cases() {
  using effects::named;
  static const std::vector<MotionCase> cases = {
      {"linear"},
      {"coulomb", {named("coulomb_friction", {{"torque", 0.02}})}},
      {"stribeck",
       {named("stribeck_friction",
              {{"torque", 0.01}, {"static_torque", 0.03}, {"velocity", 0.05}})}},
      {"saturation", {named("torque_saturation", {{"limit", 0.06}})}},
      {"delay_and_lag",
       {named("time_delay", {{"delay", 0.0053}}), named("actuator_lag", {{"time_constant", 0.004}}),
        named("sensor_delay", {{"delay", 0.0031}}, "tip_acceleration"),
        named("coulomb_friction", {{"torque", 0.01}})}},
      {"delay_of_whole_samples",
       {named("time_delay", {{"delay", 0.004}}),
        named("sensor_delay", {{"delay", 0.006}}, "tip_acceleration")}},
      {"crack", {named("local_stiffness_loss", {{"position", 0.2}, {"stiffness", 20.0}})}},
      {"drag_and_ripple",
       {named("quadratic_drag", {{"coefficient", 0.4}}), named("torque_bias", {{"torque", 0.01}})}},
  };
  return cases;
}

arm::Arm arm_of(const MotionCase& of) {
  arm::Arm made = arm::paper_arm();
  made.name = of.name;
  made.damping.kelvin_voigt_s = 1e-4;
  made.effects = of.effects;
  return made;
}

fmu::FmuSettings settings() {
  return {.modes = 3,
          .sample_time_s = kPeriod_s,
          .sensors = {{SensorKind::hub_angle},
                      {SensorKind::hub_velocity},
                      {SensorKind::tip_acceleration},
                      {SensorKind::strain, 0.05}}};
}

const std::vector<std::string> kOutputs = {"hub_angle", "hub_velocity", "tip_acceleration",
                                           "'strain@0.05'"};

/// Made once.
const UnpackedFmu& fmu_of(const arm::Arm& arm, FmiVersion version) {
  static std::map<std::pair<std::string, FmiVersion>, std::unique_ptr<UnpackedFmu>> made;
  auto& fmu = made[{arm.name, version}];
  if (!fmu) {
    const bool is_v2 = version == FmiVersion::v2;
    const auto exported = fmu::make_fmu(
        {.arm = arm, .settings = settings(), .version = version, .model_identifier = "arm"});
    fmu = std::make_unique<UnpackedFmu>(
        exported.archive, std::string(is_v2 ? fmu::kFmi2Platform : fmu::kFmi3Platform));
  }
  return *fmu;
}

std::unique_ptr<ImportedArm> instantiate(const UnpackedFmu& fmu, FmiVersion version) {
  return version == FmiVersion::v2 ? instantiate2(fmu) : instantiate3(fmu);
}

/// A random torque that is held for some samples, and rests.
std::vector<double> torques() {
  std::mt19937 random(7);
  std::vector<double> made;
  while (made.size() < kSamples) {
    const double level = 0.1 * (static_cast<double>(random() % 2001) / 1000.0 - 1.0);
    const std::size_t samples = 1 + random() % 12;
    made.insert(made.end(), samples, random() % 5 == 0 ? 0.0 : level);
  }
  made.resize(kSamples);
  return made;
}

/// What `flexarm simulate` makes of an arm.
struct Simulated {
  explicit Simulated(const arm::Arm& arm, int substeps = 0)
      : parts(response::take_apart(arm)),
        model(response::time_model(response::make_formulation("exact_tf", arm, 3), parts, 3,
                                   settings().sensors)),
        options{.sample_time_s = kPeriod_s, .substeps = substeps},
        simulator(model, parts, settings().sensors, options) {}

  response::ArmParts parts;
  arm::ModalModel model;
  response::SimulationOptions options;
  response::ArmSimulator simulator;
};

/// The largest difference of two readings over the largest reading.
double distance(std::span<const double> one, std::span<const double> other) {
  double largest = 0.0;
  double difference = 0.0;
  for (std::size_t k = 0; k < one.size(); ++k) {
    largest = std::max(largest, std::abs(other[k]));
    difference = std::max(difference, std::abs(one[k] - other[k]));
  }
  EXPECT_GT(largest, 0.0);
  return difference / largest;
}

using Channels = std::vector<std::vector<double>>;

/// Readings of samples `from` to before `to`, taken once the torque of the sample is set.
void run_open_loop(ImportedArm& arm, std::span<const double> torque_N_m, std::size_t from,
                   std::size_t to, Channels& readings) {
  readings.resize(kOutputs.size());
  std::vector<double> now;
  for (std::size_t k = from; k < to; ++k) {
    ASSERT_EQ(arm.set({"torque"}, {torque_N_m[k]}), Result::ok) << arm.logged;
    ASSERT_EQ(arm.get(kOutputs, now), Result::ok) << arm.logged;
    for (std::size_t j = 0; j < now.size(); ++j) readings[j].push_back(now[j]);
    ASSERT_EQ(arm.step(static_cast<double>(k) * kPeriod_s, kPeriod_s), Result::ok) << arm.logged;
  }
}

void expect_same(const Channels& readings, const Channels& expected, double tolerance) {
  for (std::size_t j = 0; j < kOutputs.size(); ++j) {
    EXPECT_LE(distance(readings[j], expected[j]), tolerance) << kOutputs[j];
  }
}

using VersionAndCase = std::tuple<FmiVersion, std::size_t>;

class FmuMotion : public testing::TestWithParam<VersionAndCase> {
 protected:
  FmuMotion()
      : version_(std::get<0>(GetParam())),
        arm_(arm_of(motion_cases()[std::get<1>(GetParam())])),
        fmu_(fmu_of(arm_, version_)),
        imported_(instantiate(fmu_, version_)) {}

  FmiVersion version_;
  arm::Arm arm_;
  const UnpackedFmu& fmu_;
  std::unique_ptr<ImportedArm> imported_;
};

TEST_P(FmuMotion, IsThatOfSimulate) {
  const std::vector<double> torque_N_m = torques();
  const auto expected = Simulated(arm_).simulator.run(torque_N_m);
  ASSERT_TRUE(imported_->is_there()) << imported_->logged;
  ASSERT_EQ(imported_->start(), Result::ok) << imported_->logged;
  Channels readings;
  run_open_loop(*imported_, torque_N_m, 0, kSamples, readings);
  expect_same(readings, expected.channels, kSameMotion);
}

TEST_P(FmuMotion, IsThatOfAClosedLoopWhereTheControllerIsOutside) {
  const arm::Controller controller{.sensors = {{SensorKind::hub_angle}},
                                   .law = arm::PidController{.kp = 0.2, .kd = 0.02, .ki = 0.05}};
  const std::vector<double> reference(kSamples, 0.2);
  const auto expected = Simulated(arm_).simulator.run({controller, reference});
  ASSERT_EQ(imported_->start(), Result::ok) << imported_->logged;
  response::ControllerRun run(controller, kPeriod_s, {});
  Channels readings(kOutputs.size());
  std::vector<double> now;
  for (std::size_t k = 0; k < kSamples; ++k) {
    const std::array reading = {imported_->value("hub_angle")};
    const double torque_N_m = run.command(reference[k], reading);
    ASSERT_EQ(imported_->set({"torque"}, {torque_N_m}), Result::ok);
    ASSERT_EQ(imported_->get(kOutputs, now), Result::ok);
    for (std::size_t j = 0; j < now.size(); ++j) readings[j].push_back(now[j]);
    ASSERT_EQ(imported_->step(static_cast<double>(k) * kPeriod_s, kPeriod_s), Result::ok);
  }
  expect_same(readings, expected.channels, kSameMotion);
}

TEST_P(FmuMotion, ContinuesFromASavedStateAndFromASerialisedOne) {
  const std::vector<double> torque_N_m = torques();
  constexpr std::size_t kMiddle = 150;
  ASSERT_EQ(imported_->start(), Result::ok);
  Channels begin;
  run_open_loop(*imported_, torque_N_m, 0, kMiddle, begin);
  void* state = nullptr;
  ASSERT_EQ(imported_->save(state), Result::ok);
  std::vector<char> bytes;
  ASSERT_EQ(imported_->serialise(state, bytes), Result::ok) << imported_->logged;
  Channels first;
  run_open_loop(*imported_, torque_N_m, kMiddle, kSamples, first);
  // The same again, to the last bit.
  ASSERT_EQ(imported_->put(state), Result::ok);
  Channels again;
  run_open_loop(*imported_, torque_N_m, kMiddle, kSamples, again);
  EXPECT_EQ(again, first);
  ASSERT_EQ(imported_->free_state(state), Result::ok);
  EXPECT_EQ(state, nullptr);
  // Another instance, from the bytes.
  const auto other = instantiate(fmu_, version_);
  ASSERT_EQ(other->deserialise(bytes, state), Result::ok) << other->logged;
  ASSERT_EQ(other->put(state), Result::ok);
  Channels read;
  run_open_loop(*other, torque_N_m, kMiddle, kSamples, read);
  expect_same(read, first, kSameMotion);
  other->free_state(state);
}

std::string motion_name(const testing::TestParamInfo<VersionAndCase>& info) {
  return std::string(std::get<0>(info.param) == FmiVersion::v2 ? "fmi2_" : "fmi3_") +
         motion_cases()[std::get<1>(info.param)].name;
}

INSTANTIATE_TEST_SUITE_P(Versions, FmuMotion,
                         testing::Combine(testing::Values(FmiVersion::v2, FmiVersion::v3),
                                          testing::Range<std::size_t>(0, 8)),
                         motion_name);

TEST(FmuMotionCases, AreAllRun) {
  EXPECT_EQ(motion_cases().size(), 8U);
}

TEST(FmuSteps, OfAnyLengthReachTheSameMotion) {
  // The torque changes at samples only; communication points divide the samples unevenly.
  const std::vector<double> torque_N_m = torques();
  for (const MotionCase& of : motion_cases()) {
    const arm::Arm arm = arm_of(of);
    constexpr std::size_t kFew = 60;
    const std::span few(torque_N_m.data(), kFew);
    const auto expected = Simulated(arm).simulator.run(few);
    const auto finer = Simulated(arm, 40).simulator.run(few);
    const auto imported = instantiate2(fmu_of(arm, FmiVersion::v2));
    ASSERT_EQ(imported->start(), Result::ok);
    Channels readings(kOutputs.size());
    std::vector<double> now;
    for (std::size_t k = 0; k < kFew; ++k) {
      ASSERT_EQ(imported->set({"torque"}, {torque_N_m[k]}), Result::ok);
      ASSERT_EQ(imported->get(kOutputs, now), Result::ok);
      for (std::size_t j = 0; j < now.size(); ++j) readings[j].push_back(now[j]);
      const double at_s = static_cast<double>(k) * kPeriod_s;
      ASSERT_EQ(imported->step(at_s, 0.37 * kPeriod_s), Result::ok) << imported->logged;
      ASSERT_EQ(imported->step(at_s + 0.37 * kPeriod_s, 0.63 * kPeriod_s), Result::ok)
          << imported->logged;
    }
    for (std::size_t j = 0; j < kOutputs.size(); ++j) {
      const double own = distance(expected.channels[j], finer.channels[j]);
      EXPECT_LE(distance(readings[j], finer.channels[j]), kExactSteps + kOtherSteps * own)
          << of.name << " " << kOutputs[j];
    }
  }
}

TEST(FmuSteps, OfManySamplesHoldTheTorque) {
  const arm::Arm arm = arm_of(motion_cases()[1]);
  std::vector<double> torque_N_m;
  for (const double level : {0.05, -0.08, 0.0, 0.03})
    torque_N_m.insert(torque_N_m.end(), 25, level);
  const auto expected = Simulated(arm).simulator.run(torque_N_m);
  const UnpackedFmu& fmu = fmu_of(arm, FmiVersion::v3);
  const auto imported = instantiate3(fmu);
  ASSERT_EQ(imported->start(), Result::ok);
  double at_s = 0.0;  // added up, as environments do
  for (std::size_t k = 0; k < torque_N_m.size(); k += 25) {
    ASSERT_EQ(imported->set({"torque"}, {torque_N_m[k]}), Result::ok);
    EXPECT_NEAR(imported->value("hub_angle"), expected.channels[0][k], kSameMotion);
    ASSERT_EQ(imported->step(at_s, 25 * kPeriod_s), Result::ok) << imported->logged;
    at_s += 25 * kPeriod_s;
  }
}

TEST(FmuParameters, RebuildTheModel) {
  arm::Arm arm = arm_of(motion_cases()[1]);
  const UnpackedFmu& fmu = fmu_of(arm, FmiVersion::v2);
  const auto imported = instantiate2(fmu);
  ASSERT_EQ(imported->start({{"payload.mass", 0.05}, {"effects.coulomb_friction.torque", 0.03}}),
            Result::ok)
      << imported->logged;
  arm.payload.mass_kg = 0.05;
  arm.effects.at("coulomb_friction").parameters["torque"] = 0.03;
  const std::vector<double> torque_N_m = torques();
  const auto expected = Simulated(arm).simulator.run(torque_N_m);
  Channels readings;
  run_open_loop(*imported, torque_N_m, 0, kSamples, readings);
  expect_same(readings, expected.channels, kSameMotion);
  EXPECT_EQ(imported->value("payload.mass"), 0.05);
  // A reset brings the numbers of the file back.
  ASSERT_EQ(imported->reset(), Result::ok);
  ASSERT_EQ(imported->start(), Result::ok);
  EXPECT_EQ(imported->value("payload.mass"), 0.0);
  const auto filed = Simulated(arm_of(motion_cases()[1])).simulator.run(torque_N_m);
  Channels again;
  run_open_loop(*imported, torque_N_m, 0, kSamples, again);
  expect_same(again, filed.channels, kSameMotion);
}

TEST(FmuInstances, DoNotDisturbEachOther) {
  const arm::Arm arm = arm_of(motion_cases()[2]);
  const UnpackedFmu& fmu = fmu_of(arm, FmiVersion::v3);
  const std::vector<double> torque_N_m = torques();
  std::vector<double> opposite;
  for (const double torque : torque_N_m) opposite.push_back(-torque);
  const Simulated simulated(arm);
  const auto one = instantiate3(fmu);
  const auto other = instantiate3(fmu);
  ASSERT_EQ(one->start(), Result::ok);
  ASSERT_EQ(other->start(), Result::ok);
  Channels of_one;
  Channels of_other;
  for (std::size_t k = 0; k < kSamples; ++k) {
    run_open_loop(*one, torque_N_m, k, k + 1, of_one);
    run_open_loop(*other, opposite, k, k + 1, of_other);
  }
  expect_same(of_one, simulated.simulator.run(torque_N_m).channels, kSameMotion);
  expect_same(of_other, simulated.simulator.run(opposite).channels, kSameMotion);
}

TEST(FmuOutputs, ShowTheJumpOfTheTorqueOnceItIsSet) {
  const UnpackedFmu& fmu = fmu_of(arm_of(motion_cases()[0]), FmiVersion::v2);
  const auto imported = instantiate2(fmu);
  ASSERT_EQ(imported->start(), Result::ok);
  ASSERT_EQ(imported->set({"torque"}, {0.1}), Result::ok);
  const double first = imported->value("tip_acceleration");
  EXPECT_NE(first, 0.0);
  ASSERT_EQ(imported->step(0.0, kPeriod_s), Result::ok);
  const double before = imported->value("tip_acceleration");
  ASSERT_EQ(imported->set({"torque"}, {-0.1}), Result::ok);
  EXPECT_NEAR(imported->value("tip_acceleration") - before, -2.0 * first, 1e-9 * std::abs(first));
  // The hub does not jump.
  const double angle = imported->value("hub_angle");
  ASSERT_EQ(imported->set({"torque"}, {5.0}), Result::ok);
  EXPECT_EQ(imported->value("hub_angle"), angle);
}

}  // namespace
}  // namespace flexarm::testing_export
