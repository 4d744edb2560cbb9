// What FemArm accepts and refuses, and that it may be shared by threads.
#include "fem/fem_arm.hpp"

#include "arm/input_error.hpp"
#include "effects/registry/vocabulary.hpp"
#include "tests/fem/constants.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace flexarm::fem {
namespace {

using ::testing::HasSubstr;

TEST(FemArm, RefusesEveryOtherEffectByName) {
  for (const auto& effect : effects::vocabulary()) {
    if (effect->is_of_linear_arm()) continue;
    arm::Arm arm = arm::paper_arm();
    arm.effects[effect->name] = effects::example(effect);
    try {
      FemArm{arm};
      FAIL() << effect->name << " was accepted";
    } catch (const arm::InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(effect->name));
    }
  }
}

TEST(FemArm, RefusesBadArmsOptionsAndQuestions) {
  arm::Arm bad = arm::paper_arm();
  bad.payload.mass_kg = -1.0;
  EXPECT_THROW(FemArm{bad}, arm::InputError);
  EXPECT_THROW(FemArm(arm::paper_arm(), {.degree = 2}), arm::InputError);
  EXPECT_THROW(FemArm(arm::paper_arm(), {.degree = FemArm::kHighestDegree + 1}), arm::InputError);
  EXPECT_THROW(FemArm(arm::paper_arm(), {.mesh = {.elements = 0}}), arm::InputError);
  EXPECT_THROW(FemArm(arm::paper_arm(), {.mesh = {.elements = kMostElements + 1}}),
               arm::InputError);
  EXPECT_THROW(FemArm(arm::paper_arm(), {.checking_degrees = 0}), arm::InputError);
  EXPECT_THROW(FemArm(arm::paper_arm(), {.zero_agreement = 0.0}), arm::InputError);
  EXPECT_THROW(FemArm(arm::paper_arm(), {.eigen_tolerance = -1.0}), arm::InputError);
  const FemArm model(arm::paper_arm());
  EXPECT_THROW(model.poles(0), arm::InputError);
  EXPECT_THROW(model.zeros(arm::parse_sensor("strain@2"), 1), arm::InputError);
  const std::vector<double> beyond = {1.0};
  EXPECT_THROW(model.modes(1, {}, beyond), arm::InputError);
}

TEST(FemArm, NamesTheDegreesItAllows) {
  try {
    FemArm(arm::paper_arm(), {.degree = 99});
    FAIL();
  } catch (const arm::InputError& error) {
    EXPECT_STREQ(error.what(), "degree = 99: must be 3 to 25");
  }
}

TEST(FemArm, HasNoMorePolesThanDegreesOfFreedom) {
  const FemArm model(arm::paper_arm(), {.mesh = {.elements = 1}, .degree = 3});
  EXPECT_EQ(model.degrees_of_freedom(), 3);
  EXPECT_EQ(model.poles(10).omega_rad_per_s.size(), 2u);
  EXPECT_EQ(model.zeros(kHubAngle, 10).s_rad_per_s.size(), 2u);
}

TEST(FemArm, AnswersTheSameInEveryThread) {
  const FemArm model(arm::paper_arm(), {.mesh = {.elements = 60}, .degree = 5});
  const arm::Sensor tip{arm::SensorKind::tip_acceleration};
  struct Answers {
    std::vector<double> poles;
    std::vector<std::complex<double>> zeros;
    std::complex<double> response;
    bool operator==(const Answers&) const = default;
  };
  const auto ask = [&] {
    return Answers{model.poles(4).omega_rad_per_s, model.zeros(tip, 2).s_rad_per_s,
                   model.transfer_function(tip, {0.0, 50.0})};
  };
  const Answers alone = ask();
  std::vector<Answers> together(4);
  std::vector<std::thread> threads;
  for (Answers& answers : together) threads.emplace_back([&] { answers = ask(); });
  for (std::thread& thread : threads) thread.join();
  for (const Answers& answers : together) EXPECT_TRUE(answers == alone);
}

}  // namespace
}  // namespace flexarm::fem
