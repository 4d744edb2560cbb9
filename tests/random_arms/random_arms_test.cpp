#include "arm/input_error.hpp"
#include "compare/standard_models.hpp"
#include "effects/registry/vocabulary.hpp"
#include "measured/files/arm_file.hpp"
#include "response/formulation_maker.hpp"
#include "tests/random_arms/agreement.hpp"
#include "tests/random_arms/random_arm.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>

namespace flexarm::random_arms {
namespace {

using testing::HasSubstr;

constexpr std::uint64_t kSeed = 1;

std::string described(const Agreement& agreement) {
  std::string text;
  if (agreement.worst) {
    text = agreement.worst->quantity + " of " + agreement.worst->first + " and " +
           agreement.worst->second + ": " + std::to_string(agreement.worst->distance);
  }
  for (const Refusal& refusal : agreement.refusals) {
    text += "; " + refusal.formulation + ": " + refusal.message;
  }
  return text;
}

TEST(RandomArm, DependsOnSeedAndIndexAlone) {
  const arm::Arm third = random_arm(kSeed, 3);
  random_arm(kSeed, 4);
  EXPECT_EQ(random_arm(kSeed, 3), third);
  EXPECT_NE(random_arm(kSeed, 4), third);
  EXPECT_NE(random_arm(kSeed + 1, 3), third);
}

TEST(RandomArm, HasNumbersInTheirRanges) {
  for (std::uint64_t k = 0; k < 500; ++k) {
    const arm::Arm arm = random_arm(kSeed, k);
    EXPECT_LE(arm.effects.size(), static_cast<std::size_t>(kMostEffects));
    EXPECT_NO_THROW(arm::require_valid(arm.beam));
    for (const auto& [name, effect] : arm.effects) {
      EXPECT_TRUE(effect.definition->is_of_linear_arm()) << name;
      for (const auto& parameter : effect.definition->parameters) {
        EXPECT_TRUE(parameter.range.contains(effect.value(parameter.name)))
            << name << " " << parameter.name;
      }
    }
  }
}

arm::Arm filed_arm(const std::filesystem::path& file) {
  return measured::read_arm_file(file, effects::vocabulary());
}

const std::filesystem::path kFolder = FLEXARM_SOURCE_DIR "/tests/random_arms";

// Heavy payloads, axial tension, soft roots: zeros of the tip that a dense eigenproblem loses. A
// mass suspended at the tip: one that it finds twice. A soft root: a first mode so slow that
// Lanczos vectors keep few digits of the others. A heavy hub behind a compliant drive: one so slow
// that inverse iteration brings it back into the others.
TEST(HardArms, Agree) {
  int count = 0;
  for (const auto& file : std::filesystem::directory_iterator(kFolder / "hard")) {
    const Agreement agreement = agreement_of(filed_arm(file.path()));
    EXPECT_EQ(agreement.outcome, Outcome::agree) << file.path() << ": " << described(agreement);
    ++count;
  }
  EXPECT_EQ(count, 10);
}

// The tension of the payload's weight makes tip zeros so steep that the elements of the default
// mesh do not resolve the sixth to the tolerance: fem says so.
TEST(StatedDifference, IsOfFemWhereItsMeshIsCoarse) {
  const Agreement agreement = agreement_of(filed_arm(kFolder / "stated" / "arm-9730.toml"));
  EXPECT_EQ(agreement.outcome, Outcome::stated) << described(agreement);
  EXPECT_EQ(agreement.alone, "fem");
  ASSERT_TRUE(agreement.worst);
  EXPECT_LT(agreement.worst->distance, 1e-7);
  EXPECT_LT(agreement.worst->stated, 1e-5);
}

TEST(RandomArms, AgreeOrSaySo) {
  constexpr std::uint64_t kArms = 30;
  int agree = 0;
  for (std::uint64_t k = 0; k < kArms; ++k) {
    const Agreement agreement = agreement_of(random_arm(kSeed, k));
    agree += agreement.outcome == Outcome::agree ? 1 : 0;
    EXPECT_NE(agreement.outcome, Outcome::disagree) << k << ": " << described(agreement);
    EXPECT_NE(agreement.outcome, Outcome::failed) << k << ": " << described(agreement);
  }
  EXPECT_GE(agree, 15);
}

/// The standard models, `made` in the place of fem.
std::vector<compare::Model> models_with(
    std::function<response::AnyFormulation(const arm::Arm&)> made) {
  auto models = compare::standard_models(10);
  models[1].make = std::move(made);
  return models;
}

TEST(Agreement, SeesAFormulationOfAnotherArm) {
  const Agreement agreement = agreement_of(arm::paper_arm(), models_with([](const arm::Arm& given) {
                                             arm::Arm other = given;
                                             arm::scale_flexural_rigidity(other.beam, 1.0 + 1e-8);
                                             return response::make_formulation("fem", other, 10);
                                           }));
  EXPECT_EQ(agreement.outcome, Outcome::disagree);
  EXPECT_EQ(agreement.alone, "fem");
}

TEST(Agreement, TellsRefusalFromFailure) {
  const Agreement refused =
      agreement_of(arm::paper_arm(), models_with([](const arm::Arm&) -> response::AnyFormulation {
                     throw arm::InputError("beam.length = 1 m: must be less");
                   }));
  EXPECT_EQ(refused.outcome, Outcome::refused);
  EXPECT_EQ(refused.refusals.size(), 1U);
  const Agreement failed =
      agreement_of(arm::paper_arm(), models_with([](const arm::Arm&) -> response::AnyFormulation {
                     throw std::domain_error("no root");
                   }));
  EXPECT_EQ(failed.outcome, Outcome::failed);
}

TEST(Agreement, NumbersThatNoFormulationResolvesAreRefusedByAll) {
  arm::Arm damped = arm::paper_arm();
  damped.effects.insert(effects::named("air_damping", {{"coefficient", 1e28}}));
  arm::Arm offset = arm::paper_arm();
  offset.payload.mass_kg = 1e5;
  offset.effects.insert(effects::named("payload_offset", {{"offset", 0.1}}));
  for (const auto& [arm, key] : {std::pair{damped, "effects.air_damping.coefficient"},
                                 std::pair{offset, "effects.payload_offset.offset"}}) {
    const Agreement agreement = agreement_of(arm);
    EXPECT_EQ(agreement.outcome, Outcome::refused);
    ASSERT_EQ(agreement.refusals.size(), 3U);
    for (const Refusal& refusal : agreement.refusals) EXPECT_THAT(refusal.message, HasSubstr(key));
  }
}

}  // namespace
}  // namespace flexarm::random_arms
