// Calls that the standard does not allow, and values that cannot be taken: an error and a line of
// the log, never a crash.
#include "effects/registry/vocabulary.hpp"
#include "export/fmu/embedded_files.hpp"
#include "export/fmu/fmu_export.hpp"
#include "tests/export/imported_arm.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <memory>

namespace flexarm::testing_export {
namespace {

using fmu::FmiVersion;
using testing::HasSubstr;

fmu::FmuRequest simple_request(FmiVersion version) {
  arm::Arm arm = arm::paper_arm();
  arm.effects = {effects::named("coulomb_friction", {{"torque", 0.02}})};
  return {
      .arm = arm,
      .settings = {.modes = 2,
                   .sample_time_s = 0.002,
                   .sensors = {{arm::SensorKind::hub_angle}, {arm::SensorKind::tip_acceleration}}},
      .version = version,
      .model_identifier = "arm"};
}

std::string platform_of(FmiVersion version) {
  return std::string(version == FmiVersion::v2 ? fmu::kFmi2Platform : fmu::kFmi3Platform);
}

/// Made once.
const UnpackedFmu& simple_fmu(FmiVersion version) {
  static std::map<FmiVersion, std::unique_ptr<UnpackedFmu>> made;
  auto& fmu = made[version];
  if (!fmu) {
    fmu = std::make_unique<UnpackedFmu>(fmu::make_fmu(simple_request(version)).archive,
                                        platform_of(version));
  }
  return *fmu;
}

class FmuCalls : public testing::TestWithParam<FmiVersion> {
 protected:
  FmuCalls() : fmu_(simple_fmu(GetParam())), arm_(make()) {}

  std::unique_ptr<ImportedArm> make(const std::string& token = "") const {
    return GetParam() == FmiVersion::v2 ? instantiate2(fmu_, token) : instantiate3(fmu_, token);
  }
  /// The call failed, and the log says why.
  void expect_error(Result result, const std::string& line) {
    EXPECT_EQ(result, Result::error);
    EXPECT_THAT(arm_->logged, HasSubstr(line));
    EXPECT_EQ(arm_->logged.find('\n'), std::string::npos);
    arm_->logged.clear();
  }

  const UnpackedFmu& fmu_;
  std::unique_ptr<ImportedArm> arm_;
  std::vector<double> values_;
};

TEST_P(FmuCalls, InWrongStatesAreErrors) {
  expect_error(arm_->step(0.0, 0.002), "doing a step: not allowed in state \"instantiated\"");
  expect_error(arm_->exit_initialisation(), "not allowed in state \"instantiated\"");
  expect_error(arm_->terminate(), "not allowed");
  expect_error(arm_->get({"hub_angle"}, values_), "getting hub_angle: not allowed");
  ASSERT_EQ(arm_->set_up(0.0, 1.0), Result::ok);
  expect_error(arm_->set_up(0.0, 1.0), "not allowed in state \"initialization mode\"");
  expect_error(arm_->step(0.0, 0.002), "not allowed in state \"initialization mode\"");
  EXPECT_EQ(arm_->get({"hub_angle"}, values_), Result::ok);
  ASSERT_EQ(arm_->exit_initialisation(), Result::ok);
  expect_error(arm_->exit_initialisation(), "not allowed in state \"step mode\"");
  expect_error(arm_->set({"beam.length"}, {0.3}), "setting beam.length: not allowed");
  ASSERT_EQ(arm_->step(0.0, 0.002), Result::ok);
  ASSERT_EQ(arm_->terminate(), Result::ok);
  expect_error(arm_->step(0.002, 0.002), "not allowed in state \"terminated\"");
  expect_error(arm_->set({"torque"}, {0.3}), "setting torque: not allowed");
  EXPECT_EQ(arm_->get({"hub_angle"}, values_), Result::ok);
  ASSERT_EQ(arm_->reset(), Result::ok);
  EXPECT_EQ(arm_->start(), Result::ok);
}

TEST_P(FmuCalls, WithValuesOutOfRangeAreErrorsAndChangeNothing) {
  expect_error(arm_->set({"beam.length"}, {-0.3}),
               "beam.length = -0.3 m: must be a finite number above 0");
  expect_error(arm_->set({"effects.coulomb_friction.torque"}, {-1.0}),
               "effects.coulomb_friction.torque = -1 N m");
  expect_error(arm_->set({"torque"}, {std::numeric_limits<double>::quiet_NaN()}), "torque = nan");
  expect_error(arm_->set({"hub_angle"}, {1.0}), "setting hub_angle: neither an input nor a");
  expect_error(arm_->set_reference(1000, 1.0), "value reference 1000: unknown");
  ASSERT_EQ(arm_->start(), Result::ok);
  EXPECT_EQ(arm_->value("beam.length"), arm::paper_arm().beam.length_m);
  EXPECT_EQ(arm_->value("torque"), 0.0);
}

TEST_P(FmuCalls, WithNumbersThatDoNotFitTogetherFailWhereTheModelIsMade) {
  // The file gives the flexural rigidity too, so that it contradicts another modulus.
  arm::Arm both = arm::paper_arm();
  both.beam.given_flexural_rigidity_N_m2 = both.beam.flexural_rigidity_N_m2();
  auto asked = simple_request(GetParam());
  asked.arm = both;
  const UnpackedFmu fmu(fmu::make_fmu(asked).archive, platform_of(GetParam()));
  arm_ = GetParam() == FmiVersion::v2 ? instantiate2(fmu) : instantiate3(fmu);
  const double modulus_Pa = 0.5 * *both.beam.youngs_modulus_Pa;
  ASSERT_EQ(arm_->set({"beam.youngs_modulus"}, {modulus_Pa}), Result::ok);
  expect_error(arm_->start(), "beam.flexural_rigidity");
  // Both changed, they fit.
  const double rigidity_N_m2 = 0.5 * *both.beam.given_flexural_rigidity_N_m2;
  ASSERT_EQ(arm_->set({"beam.flexural_rigidity"}, {rigidity_N_m2}), Result::ok);
  EXPECT_EQ(arm_->exit_initialisation(), Result::ok) << arm_->logged;
  arm_.reset();
}

TEST_P(FmuCalls, WithOtherCommunicationPointsAreErrors) {
  ASSERT_EQ(arm_->set_up(1.0, 1.01), Result::ok);
  ASSERT_EQ(arm_->exit_initialisation(), Result::ok);
  EXPECT_EQ(arm_->value("time"), 1.0);
  expect_error(arm_->step(0.0, 0.002), "communication point 0 s: must be 1 s");
  expect_error(arm_->step(1.0, -0.002), "communication step size = -0.002 s");
  ASSERT_EQ(arm_->step(1.0, 0.002), Result::ok) << arm_->logged;
  EXPECT_DOUBLE_EQ(arm_->value("time"), 1.002);
  expect_error(arm_->step(1.0, 0.002), "communication point 1 s: must be 1.002 s");
  expect_error(arm_->step(1.002, 0.01), "beyond the stop time 1.01 s");
  ASSERT_EQ(arm_->step(1.002, 0.008), Result::ok) << arm_->logged;
}

TEST_P(FmuCalls, WithAnotherTokenGiveNoInstance) {
  const auto other = make("{00000000-0000-0000-0000-000000000000}");
  EXPECT_FALSE(other->is_there());
  EXPECT_THAT(other->logged, HasSubstr("that of the model description"));
}

TEST_P(FmuCalls, OnAnInstanceThatIsNoneAreErrors) {
  const auto none = make("no token");
  ASSERT_FALSE(none->is_there());
  EXPECT_EQ(none->step(0.0, 0.002), Result::error);
  EXPECT_EQ(none->set({"torque"}, {0.0}), Result::error);
  EXPECT_EQ(none->reset(), Result::error);
}

TEST_P(FmuCalls, WithBytesOfNoStateAreErrors) {
  ASSERT_EQ(arm_->start(), Result::ok);
  ASSERT_EQ(arm_->step(0.0, 0.002), Result::ok);
  void* state = nullptr;
  ASSERT_EQ(arm_->save(state), Result::ok);
  std::vector<char> bytes;
  ASSERT_EQ(arm_->serialise(state, bytes), Result::ok);
  void* read = nullptr;
  for (const std::size_t size : {std::size_t{10}, bytes.size() - 8}) {
    expect_error(arm_->deserialise({bytes.begin(), bytes.begin() + static_cast<long>(size)}, read),
                 "state: not of this");
    EXPECT_EQ(read, nullptr);
  }
  std::vector<char> spoilt = bytes;
  for (std::size_t i = bytes.size() - 48; i < bytes.size(); ++i) spoilt[i] = '\x7f';
  expect_error(arm_->deserialise(spoilt, read), "state: not of this");
  expect_error(arm_->put(nullptr), "null");
  arm_->free_state(state);
  EXPECT_EQ(arm_->free_state(state), Result::ok);
}

TEST_P(FmuCalls, ThatFailInAStepAreErrorsUntilAReset) {
  ASSERT_EQ(arm_->start(), Result::ok);
  ASSERT_EQ(arm_->set({"torque"}, {1e300}), Result::ok);
  Result result = Result::ok;
  double at_s = 0.0;
  std::vector<double> values;
  for (int k = 0; k < 2000 && result == Result::ok; ++k, at_s += 0.002) {
    result = arm_->step(at_s, 0.002);
    if (result == Result::ok) result = arm_->get({"hub_angle"}, values);
    if (result == Result::ok) result = arm_->set({"torque"}, {k % 2 == 0 ? -1e307 : 1e307});
  }
  EXPECT_NE(result, Result::other);
  EXPECT_EQ(arm_->reset(), Result::ok);
  EXPECT_EQ(arm_->start(), Result::ok);
}

INSTANTIATE_TEST_SUITE_P(Versions, FmuCalls, testing::Values(FmiVersion::v2, FmiVersion::v3),
                         [](const auto& of) {
                           return of.param == FmiVersion::v2 ? "fmi2" : "fmi3";
                         });

TEST(FmuLibrary, HasEveryFunctionOfTheStandardAndNothingElse) {
  const UnpackedFmu& fmu = simple_fmu(FmiVersion::v3);
  for (const char* const name : {"fmi3GetVersion",
                                 "fmi3InstantiateModelExchange",
                                 "fmi3InstantiateScheduledExecution",
                                 "fmi3EnterEventMode",
                                 "fmi3EnterStepMode",
                                 "fmi3GetFloat32",
                                 "fmi3SetUInt64",
                                 "fmi3GetBinary",
                                 "fmi3SetClock",
                                 "fmi3GetDirectionalDerivative",
                                 "fmi3GetAdjointDerivative",
                                 "fmi3EnterConfigurationMode",
                                 "fmi3ExitConfigurationMode",
                                 "fmi3GetIntervalDecimal",
                                 "fmi3SetShiftFraction",
                                 "fmi3EvaluateDiscreteStates",
                                 "fmi3UpdateDiscreteStates",
                                 "fmi3EnterContinuousTimeMode",
                                 "fmi3CompletedIntegratorStep",
                                 "fmi3SetTime",
                                 "fmi3SetContinuousStates",
                                 "fmi3GetContinuousStateDerivatives",
                                 "fmi3GetEventIndicators",
                                 "fmi3GetContinuousStates",
                                 "fmi3GetNominalsOfContinuousStates",
                                 "fmi3GetNumberOfEventIndicators",
                                 "fmi3GetNumberOfContinuousStates",
                                 "fmi3GetOutputDerivatives",
                                 "fmi3ActivateModelPartition",
                                 "fmi2GetTypesPlatform",
                                 "fmi2GetVersion",
                                 "fmi2SetRealInputDerivatives",
                                 "fmi2GetRealOutputDerivatives",
                                 "fmi2CancelStep",
                                 "fmi2GetStringStatus",
                                 "fmi2GetDirectionalDerivative"}) {
    EXPECT_TRUE(fmu.has_symbol(name)) << name;
  }
  EXPECT_FALSE(fmu.has_symbol("_ZN7flexarm3arm9paper_armEv"));
  EXPECT_STREQ(fmu.function<const char*()>("fmi3GetVersion")(), "3.0");
  EXPECT_STREQ(fmu.function<const char*()>("fmi2GetVersion")(), "2.0");
}

}  // namespace
}  // namespace flexarm::testing_export
