// Scores of made-up answers to rigs.
#include "tests/trials/rig_score.hpp"

#include "tests/trials/results_file.hpp"
#include "tests/trials/scorecard.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

namespace flexarm::trials {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// Leading are Coulomb friction, a late tip sensor and the inertia of the hub.
Truth rig_truth() {
  Truth truth;
  truth.key.rig = true;
  truth.arm = "steel link";
  RigTruth rig{.costs = {}, .counts_per_turn = 2000.0, .validation_floor = 0.02};
  const auto hide = [&](const std::string& name, double cost, const std::string& sensor = "") {
    truth.key.hidden.push_back(name);
    truth.world.hidden.push_back({name, {{"factor", 1.1}}, sensor});
    rig.costs[name] = cost;
  };
  hide("hub_viscous_friction", 0.01);
  hide("coulomb_friction", 0.3);
  hide("hub_inertia", 0.1);
  hide("flexural_rigidity", 0.05);
  hide("sensor_delay", 0.2, "tip_acceleration");
  truth.rig = rig;
  return truth;
}

NamedCause name_of(const std::string& effect, const std::string& sensor = "",
                   std::vector<std::string> confusable = {}) {
  return {.effect = effect,
          .sensor = sensor,
          .parameters = {},
          .confusable_with = std::move(confusable)};
}

Answer answer_with(std::vector<NamedCause> causes, double held_out_error = 0.025) {
  Answer answer;
  answer.verdict = "partly_explained";
  answer.causes = std::move(causes);
  answer.validation.after = held_out_error;
  return answer;
}

RigScore score_of(std::vector<NamedCause> causes) {
  return rig_score(rig_truth(), answer_with(std::move(causes)));
}

TEST(RigScore, LeadingAreTheCausesWhoseAbsenceCostsMost) {
  EXPECT_THAT(rig_truth().rig->leading(),
              ElementsAre("coulomb_friction", "sensor_delay", "hub_inertia"));
}

TEST(RigScore, LeadingCausesAreNamedByTheirNamesOnTheirSensors) {
  const RigScore all = score_of({name_of("coulomb_friction"), name_of("hub_inertia"),
                                 name_of("sensor_delay", "tip_acceleration")});
  EXPECT_EQ(all.leading_named, 3);
  EXPECT_EQ(all.wrong_names, 0);
  const RigScore elsewhere = score_of({name_of("sensor_delay", "hub_angle")});
  EXPECT_EQ(elsewhere.leading_named, 0);
  EXPECT_EQ(elsewhere.wrong_names, 1);
}

TEST(RigScore, OtherHiddenCausesAreNeitherLeadingNorWrong) {
  const RigScore score = score_of({name_of("hub_viscous_friction"), name_of("flexural_rigidity")});
  EXPECT_EQ(score.leading_named, 0);
  EXPECT_EQ(score.wrong_names, 0);
}

TEST(RigScore, AnEffectOfTheSameFamilyStandsForACauseOnTheSameSensor) {
  const RigScore families = score_of({name_of("stribeck_friction"), name_of("hub_radius"),
                                      name_of("sensor_lag", "tip_acceleration")});
  EXPECT_EQ(families.leading_named, 3);
  EXPECT_EQ(families.wrong_names, 0);
  const RigScore of_torque = score_of({name_of("actuator_lag")});
  EXPECT_EQ(of_torque.leading_named, 0);
  EXPECT_EQ(of_torque.wrong_names, 1);
  EXPECT_EQ(score_of({name_of("sensor_lag", "hub_angle")}).wrong_names, 1);
}

TEST(RigScore, AClassOfAtMostThreeStandsForEachMember) {
  const RigScore small = score_of({name_of("torque_gain", "", {"hub_inertia"})});
  EXPECT_EQ(small.leading_named, 1);
  EXPECT_EQ(small.wrong_names, 0);
  const RigScore with_sensor =
      score_of({name_of("sensor_delay", "hub_angle", {"sensor_delay on tip_acceleration"})});
  EXPECT_EQ(with_sensor.leading_named, 1);
  EXPECT_EQ(with_sensor.wrong_names, 0);
  const RigScore large =
      score_of({name_of("torque_gain", "", {"hub_inertia", "payload_mass", "gravity"})});
  EXPECT_EQ(large.leading_named, 0);
  EXPECT_EQ(large.wrong_names, 1);
}

TEST(RigScore, WrongNamesAreOfNoHiddenCauseOrFamily) {
  const RigScore score =
      score_of({name_of("coulomb_friction"), name_of("tuned_mass"), name_of("no_such_effect")});
  EXPECT_EQ(score.leading_named, 1);
  EXPECT_EQ(score.wrong_names, 2);
}

TEST(RigScore, HeldOutErrorIsOverTheFloorOfNoiseAndCounts) {
  EXPECT_DOUBLE_EQ(rig_score(rig_truth(), answer_with({}, 0.03)).error_over_floor, 1.5);
  EXPECT_TRUE(std::isinf(rig_score(rig_truth(), Answer{}).error_over_floor));
}

TEST(RigScore, IsPartOfARigsResultAlone) {
  const TrialResult result = score(rig_truth(), answer_with({name_of("coulomb_friction")}));
  ASSERT_TRUE(result.rig.has_value());
  EXPECT_EQ(result.rig->leading_named, 1);
  EXPECT_EQ(result.strength, "rig");
  Truth other = rig_truth();
  other.rig.reset();
  EXPECT_FALSE(score(other, answer_with({})).rig.has_value());
}

TEST(RigScore, IsReadBackFromResults) {
  const auto file = std::filesystem::path(testing::TempDir()) / "rig-results.csv";
  std::filesystem::remove(file);
  append_result(score(rig_truth(), answer_with({name_of("gravity")})), file);
  append_result(score(rig_truth(), Answer{}), file);
  append_result(TrialResult{}, file);
  const auto read = read_results(file);
  ASSERT_EQ(read.size(), 3U);
  EXPECT_EQ(read[0].rig->leading_named, 0);
  EXPECT_EQ(read[0].rig->wrong_names, 1);
  EXPECT_DOUBLE_EQ(read[0].rig->error_over_floor, 1.25);
  EXPECT_TRUE(std::isinf(read[1].rig->error_over_floor));
  EXPECT_FALSE(read[2].rig.has_value());
}

TEST(RigTable, IsASectionOfItsOwn) {
  TrialResult good =
      score(rig_truth(), answer_with({name_of("coulomb_friction"), name_of("hub_inertia"),
                                      name_of("sensor_delay", "tip_acceleration")}));
  good.processor_s = 10.0;
  TrialResult bad = score(rig_truth(), answer_with({name_of("tuned_mass")}, 0.2));
  bad.processor_s = 30.0;
  bad.arm = "sandwich link";
  const std::string card = scorecard({good, bad});
  EXPECT_THAT(card, HasSubstr("## Rigs"));
  EXPECT_THAT(card, HasSubstr("| all | 2 | 3/6 (50 %) | 0.50 | 1/2 (50 %) | 30.0 | 30.0 |"));
  EXPECT_THAT(card, HasSubstr("| steel link | 1 | 3/3 (100 %) | 0.00 | 1/1 (100 %) |"));
  // No other table counts them.
  EXPECT_THAT(card, Not(HasSubstr("## Results by effect")));
  TrialResult other;
  other.verdict = "adequate";
  other.outcome = Outcome::quiet;
  const std::string with_other = scorecard({other, good});
  EXPECT_THAT(with_other, HasSubstr("| no effect | adequate 1 |"));
  EXPECT_THAT(scorecard({other}), Not(HasSubstr("## Rigs")));
}

}  // namespace
}  // namespace flexarm::trials
