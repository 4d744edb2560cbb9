// Effects that are the same model by two names: back_emf and hub_viscous_friction.
#include "diagnose/diagnosis.hpp"
#include "diagnose/search/hypothesis.hpp"
#include "effects/registry/vocabulary.hpp"
#include "tests/diagnose/simulated_experiments.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

namespace flexarm::diagnose {
namespace {

constexpr SimulatedRuns kBriefRuns{.duration_s = 2.0};

const std::vector<std::string>& one_name() {
  static const std::vector<std::string> names = {"hub_viscous_friction", "air_damping",
                                                 "coulomb_friction", "payload_mass"};
  return names;
}

std::vector<std::string> both_names() {
  std::vector<std::string> names = one_name();
  names.emplace_back("back_emf");
  return names;
}

const Cause& cause_named(const Diagnosis& made, const std::string& effect) {
  const auto found = std::ranges::find(made.causes, effect, &Cause::effect);
  if (found == made.causes.end()) throw std::out_of_range(effect + " is not named");
  return *found;
}

TEST(SameModel, IsOneHypothesisOfTwoNames) {
  const Experiment experiment = simulated_experiment({}, kBriefRuns);
  const auto all = hypotheses(experiment);
  const auto made = distinct(all);
  EXPECT_EQ(made.size() + 1, all.size());
  const auto friction = std::ranges::find(made, "hub_viscous_friction", &Hypothesis::effect);
  ASSERT_NE(friction, made.end());
  EXPECT_THAT(friction->other_names, testing::ElementsAre("back_emf"));
  EXPECT_EQ(std::ranges::count(made, "back_emf", &Hypothesis::effect), 0);
  EXPECT_EQ(std::ranges::count_if(made, [](const auto& one) { return !one.other_names.empty(); }),
            1);
  const auto alone = distinct(named(experiment, {"back_emf", "payload_mass"}));
  EXPECT_EQ(alone.size(), 2U);
  EXPECT_EQ(std::ranges::count(alone, "back_emf", &Hypothesis::effect), 1);
}

/// Whichever of the two is there, both are named, each with half of what the one had.
TEST(SameModel, IsNamedByBothNamesAndNoneIsLessProbableForIt) {
  const std::vector<arm::Effects::value_type> hidden_effects = {
      effects::named("hub_viscous_friction", {{"coefficient", 0.02}}),
      effects::named("back_emf", {{"constant", 0.02}})};
  for (const auto& hidden : hidden_effects) {
    const Experiment experiment = simulated_experiment({hidden}, kBriefRuns);
    const Diagnosis one = diagnose(experiment, named(experiment, one_name()));
    const Diagnosis both = diagnose(experiment, named(experiment, both_names()));
    EXPECT_EQ(both.verdict, Verdict::explained);
    ASSERT_EQ(both.causes.size(), 1U) << hidden.first;
    const Cause& cause = cause_named(both, "hub_viscous_friction");
    EXPECT_THAT(cause.confusable_with, testing::ElementsAre("back_emf"));
    EXPECT_FALSE(cause.names_family);  // one model by two names
    EXPECT_THAT(cause.evidence, testing::Contains(testing::HasSubstr(
                                    "The same model as back_emf: no data distinguish them.")));
    const Cause& before = cause_named(one, "hub_viscous_friction");
    EXPECT_THAT(before.confusable_with, testing::IsEmpty());
    EXPECT_DOUBLE_EQ(cause.class_confidence, before.class_confidence);
    EXPECT_GT(cause.class_confidence, 0.95);
    EXPECT_DOUBLE_EQ(cause.confidence, 0.5 * before.confidence);
    EXPECT_EQ(cause.parameters[0].value, before.parameters[0].value);
  }
}

TEST(SameModel, BesideAnotherCauseIsNamedByBothNames) {
  const Experiment experiment =
      simulated_experiment({effects::named("back_emf", {{"constant", 0.02}}),
                            effects::named("coulomb_friction", {{"torque", 0.01}})},
                           kBriefRuns);
  const Diagnosis made = diagnose(experiment, named(experiment, both_names()));
  ASSERT_EQ(made.causes.size(), 2U);
  EXPECT_THAT(cause_named(made, "hub_viscous_friction").confusable_with,
              testing::ElementsAre("back_emf"));
  EXPECT_GT(cause_named(made, "hub_viscous_friction").class_confidence, 0.95);
  EXPECT_THAT(cause_named(made, "coulomb_friction").confusable_with, testing::IsEmpty());
}

TEST(SameModel, IsNamedByTheNameThatIsAskedFor) {
  const Experiment experiment =
      simulated_experiment({effects::named("back_emf", {{"constant", 0.02}})}, kBriefRuns);
  const Diagnosis made = diagnose(experiment, named(experiment, {"back_emf", "payload_mass"}));
  ASSERT_EQ(made.causes.size(), 1U);
  EXPECT_EQ(made.causes[0].effect, "back_emf");
  EXPECT_GT(made.causes[0].confidence, 0.95);
}

}  // namespace
}  // namespace flexarm::diagnose
