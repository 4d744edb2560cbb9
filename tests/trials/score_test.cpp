#include "tests/trials/score.hpp"

#include "tests/trials/clopper_pearson.hpp"
#include "tests/trials/results_file.hpp"
#include "tests/trials/scorecard.hpp"
#include "tests/trials/trial_list.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace flexarm::trials {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

Truth truth_of(std::vector<std::string> hidden) {
  Truth truth;
  truth.key.hidden = std::move(hidden);
  for (const auto& name : truth.key.hidden) {
    truth.world.hidden.push_back({name, {{"torque", 0.01}}});
  }
  return truth;
}

NamedCause named(const std::string& effect, std::vector<std::string> confusable = {}) {
  return {.effect = effect,
          .sensor = {},
          .parameters = {{"torque", {0.0102, 0.00015}}},
          .confusable_with = std::move(confusable),
          .probability = 0.9};
}

Answer answered(const std::string& verdict, std::vector<NamedCause> causes = {}) {
  Answer answer;
  answer.verdict = verdict;
  answer.causes = std::move(causes);
  return answer;
}

Outcome outcome(const Truth& truth, const Answer& answer) {
  return score(truth, answer).outcome;
}

TEST(Score, ANameIsExactInAClassPartlyRightOrWrong) {
  const Truth truth = truth_of({"coulomb_friction"});
  EXPECT_EQ(outcome(truth, answered("explained", {named("coulomb_friction")})), Outcome::exact);
  EXPECT_EQ(outcome(truth, answered("explained", {named("torque_bias", {"coulomb_friction"})})),
            Outcome::in_class);
  EXPECT_EQ(
      outcome(truth, answered("explained", {named("torque_bias", {"coulomb_friction", "hub_spring",
                                                                  "torque_gain"})})),
      Outcome::wrong);
  EXPECT_EQ(outcome(truth, answered("explained", {named("coulomb_friction"), named("gravity")})),
            Outcome::partly);
  EXPECT_EQ(outcome(truth, answered("adequate")), Outcome::missed);
  EXPECT_EQ(outcome(truth, answered("unexplained")), Outcome::abstained);
  EXPECT_EQ(outcome(truth, Answer{}), Outcome::no_answer);
}

TEST(Score, AWrongCauseBesidePartlyExplainedIsWrong) {
  const Truth truth = truth_of({"coulomb_friction", "hub_spring"});
  EXPECT_EQ(outcome(truth, answered("partly_explained", {named("coulomb_friction")})),
            Outcome::partly);
  EXPECT_EQ(
      outcome(truth, answered("partly_explained", {named("coulomb_friction"), named("gravity")})),
      Outcome::wrong);
}

TEST(Score, ClaimsAreRightWhereTheCauseWasHidden) {
  const auto result = score(truth_of({"coulomb_friction"}),
                            answered("explained", {named("coulomb_friction"),
                                                   named("torque_bias", {"coulomb_friction"})}));
  ASSERT_EQ(result.claims.size(), 2U);
  EXPECT_EQ(result.claims[0].probability, 0.9);
  EXPECT_TRUE(result.claims[0].right);
  EXPECT_FALSE(result.claims[1].right);
}

TEST(Score, AnEffectOnAnotherSensorIsAnotherCause) {
  Truth truth = truth_of({"sensor_gain"});
  truth.world.hidden[0].sensor = "hub_velocity";
  NamedCause cause = named("sensor_gain");
  cause.sensor = "hub_velocity";
  EXPECT_EQ(outcome(truth, answered("explained", {cause})), Outcome::exact);
  cause.sensor = "tip_acceleration";
  const auto result = score(truth, answered("explained", {cause}));
  EXPECT_EQ(result.outcome, Outcome::wrong);
  EXPECT_EQ(result.parameters, 0);
  EXPECT_FALSE(result.claims[0].right);
}

TEST(Score, WithNothingToNameSilenceIsRight) {
  EXPECT_EQ(outcome(truth_of({}), answered("adequate")), Outcome::quiet);
  EXPECT_EQ(outcome(truth_of({}), answered("explained", {named("gravity")})), Outcome::false_alarm);
  EXPECT_EQ(outcome(truth_of({}), answered("unexplained")), Outcome::doubted);
  EXPECT_EQ(outcome(truth_of({}), answered("explained")), Outcome::quiet);
  const Truth outside = truth_of({"random_disturbance"});
  EXPECT_EQ(outcome(outside, answered("unexplained")), Outcome::recognised);
  EXPECT_EQ(outcome(outside, answered("partly_explained", {named("gravity")})), Outcome::wrong);
  NamedCause unlikely = named("gravity");
  unlikely.probability = 0.4;
  EXPECT_EQ(outcome(outside, answered("partly_explained", {unlikely})), Outcome::recognised);
  EXPECT_EQ(outcome(outside, answered("explained", {named("gravity")})), Outcome::mistaken);
}

TEST(Score, ThePortOfWhatIsOutsideIsRightAmongThoseStated) {
  const auto port = [](const char* hidden, std::vector<std::string> ports) {
    Answer answer = answered("unexplained");
    answer.ports = std::move(ports);
    return score(truth_of({hidden}), answer).port_answer;
  };
  EXPECT_EQ(port("backlash", {"hub"}), PortAnswer::right);
  EXPECT_EQ(port("backlash", {"root", "hub"}), PortAnswer::right);
  EXPECT_EQ(port("backlash", {"beam"}), PortAnswer::wrong);
  EXPECT_EQ(port("backlash", {}), PortAnswer::undetermined);
  EXPECT_EQ(port("cross_talk", {"sensor strain@0.05"}), PortAnswer::right);
  EXPECT_EQ(port("cross_talk", {"sensor hub_angle"}), PortAnswer::wrong);
  EXPECT_EQ(port("coulomb_friction", {"hub"}), PortAnswer::none);
  EXPECT_EQ(score(truth_of({"backlash"}), Answer{}).port_answer, PortAnswer::none);
}

TEST(Scorecard, CountsThePortsThatAreRight) {
  TrialResult one;
  one.kind = "time";
  one.noise = 0.005;
  one.strength = "middle";
  one.hidden = {"backlash"};
  one.outside = true;
  one.outcome = Outcome::recognised;
  one.port_answer = PortAnswer::right;
  TrialResult other = one;
  other.port_answer = PortAnswer::undetermined;
  TrialResult unasked = one;
  unasked.port_answer = PortAnswer::none;
  EXPECT_THAT(scorecard({one, other, unasked}),
              HasSubstr("| effect outside the library: port right | 1/2 (50 %) |"));
}

TEST(Score, TheDirtOfARecordingIsNoPhysicalCause) {
  Truth truth = truth_of({});
  truth.key.dirt = "late_sensor";
  truth.world.hidden.push_back({"sensor_delay", {{"torque", 0.01}}, "tip_acceleration"});
  NamedCause delay = named("sensor_delay");
  delay.sensor = "tip_acceleration";
  auto result = score(truth, answered("explained", {delay}));
  EXPECT_EQ(result.outcome, Outcome::quiet);
  EXPECT_EQ(result.dirt_answer, DirtAnswer::named);
  EXPECT_TRUE(result.named.empty());
  result = score(truth, answered("partly_explained", {delay, named("gravity")}));
  EXPECT_EQ(result.outcome, Outcome::false_alarm);
  EXPECT_THAT(result.named, ElementsAre("gravity"));
  result = score(truth, answered("unexplained"));
  EXPECT_EQ(result.outcome, Outcome::doubted);
  EXPECT_EQ(result.dirt_answer, DirtAnswer::unnamed);
  // On another sensor it is another cause.
  delay.sensor = "hub_velocity";
  result = score(truth, answered("explained", {delay}));
  EXPECT_EQ(result.outcome, Outcome::false_alarm);
  EXPECT_EQ(result.dirt_answer, DirtAnswer::unnamed);
}

TEST(Score, BesideDirtTheHiddenCauseCounts) {
  Truth truth = truth_of({"coulomb_friction"});
  truth.key.dirt = "torque_offset";
  truth.world.hidden.push_back({"torque_bias", {{"torque", 0.01}}});
  const NamedCause friction = named("coulomb_friction");
  auto result = score(truth, answered("explained", {friction, named("torque_bias")}));
  EXPECT_EQ(result.outcome, Outcome::exact);
  EXPECT_EQ(result.dirt_answer, DirtAnswer::named);
  result = score(truth, answered("explained", {named("torque_bias", {"coulomb_friction"})}));
  EXPECT_EQ(result.outcome, Outcome::in_class);
  EXPECT_EQ(result.dirt_answer, DirtAnswer::unnamed);
  truth.key.dirt = "drift";
  EXPECT_EQ(score(truth, answered("explained", {friction})).dirt_answer, DirtAnswer::none);
}

TEST(Scorecard, HasALineAKindOfDirt) {
  Truth truth = truth_of({});
  truth.key.dirt = "drift";
  const auto quiet = score(truth, answered("adequate"));
  const auto alarm = score(truth, answered("explained", {named("gravity")}));
  const std::string card = scorecard({quiet, alarm});
  EXPECT_THAT(card, HasSubstr("| drift | 1/2 (50 %) | - |"));
  EXPECT_THAT(card, HasSubstr("### With dirt"));
  EXPECT_THAT(card, HasSubstr("\n2 of them are recorded with dirt"));
}

TEST(Scorecard, HasNoSectionWithoutTrials) {
  Truth truth = truth_of({});
  truth.key.dirt = "drift";
  const std::string card = scorecard({score(truth, answered("adequate"))});
  EXPECT_THAT(card, Not(HasSubstr("## Wrong geometry")));
  EXPECT_THAT(card, Not(HasSubstr("## Results by effect")));
  EXPECT_THAT(card, HasSubstr("### Stated probabilities and intervals"));
}

TEST(Score, OutcomesAreReadBack) {
  for (int i = 0; i <= static_cast<int>(Outcome::no_answer); ++i) {
    EXPECT_EQ(parse_outcome(to_string(static_cast<Outcome>(i))), static_cast<Outcome>(i));
  }
}

TEST(Score, ParametersAreComparedWithThoseHidden) {
  const auto result = score(truth_of({"coulomb_friction"}),
                            answered("explained", {named("coulomb_friction"), named("gravity")}));
  EXPECT_EQ(result.parameters, 1);
  EXPECT_EQ(result.recovered, 1);  // 2 % off
  EXPECT_EQ(result.covered, 1);    // by 1.3 standard errors
}

TEST(ClopperPearson, BoundsAreThoseOfTheTables) {
  // 1 - 0.05^(1/n) for no event.
  EXPECT_NEAR(upper_bound_95(0, 300), 0.00994, 1e-5);
  EXPECT_NEAR(lower_bound_95(60, 60), 0.95130, 1e-5);
  EXPECT_EQ(upper_bound_95(5, 5), 1.0);
  EXPECT_EQ(lower_bound_95(0, 5), 0.0);
}

TEST(ResultsFile, IsReadBack) {
  const auto file = std::filesystem::path(testing::TempDir()) / "results.csv";
  std::filesystem::remove(file);
  TrialResult result = score(truth_of({"coulomb_friction", "gravity"}),
                             answered("explained", {named("coulomb_friction")}));
  result.arm = "steel link";
  result.version = "0123abc";
  result.time_s = 1.25;
  result.processor_s = 2.5;
  append_result(result, file);
  TrialResult quiet = score(truth_of({}), answered("adequate"));
  quiet.version = "0123abc";
  quiet.port_answer = PortAnswer::right;
  quiet.ports = {"hub", "sensor hub_angle+hub_velocity"};
  append_result(quiet, file);
  const auto read = read_results(file);
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(read[0].id, result.id);
  EXPECT_EQ(read[0].time_s, 1.25);
  EXPECT_EQ(read[0].processor_s, 2.5);
  EXPECT_EQ(read[0].hidden, result.hidden);
  EXPECT_EQ(read[0].named, result.named);
  ASSERT_EQ(read[0].claims.size(), 1U);
  EXPECT_EQ(read[0].claims[0].probability, 0.9);
  EXPECT_TRUE(read[0].claims[0].right);
  EXPECT_EQ(read[0].outcome, Outcome::partly);
  EXPECT_EQ(read[0].values, result.values);
  EXPECT_EQ(read[1].outcome, Outcome::quiet);
  EXPECT_TRUE(read[1].hidden.empty());
  EXPECT_EQ(read[0].port_answer, PortAnswer::none);
  EXPECT_TRUE(read[0].ports.empty());
  EXPECT_EQ(read[1].port_answer, PortAnswer::right);
  EXPECT_EQ(read[1].ports, quiet.ports);
  EXPECT_THAT(scorecard(read), HasSubstr("Version: 0123abc (clean source tree)."));
  EXPECT_THAT(scorecard(read), HasSubstr("| two effects: one identified | 1/1 (100 %) |"));
  EXPECT_THAT(scorecard(read),
              HasSubstr("| no effect present: effect identified (false alarm) | 0/1 (0 %) |"));
}

TEST(ResultsFile, OfAnotherFormIsRefused) {
  const auto file = std::filesystem::path(testing::TempDir()) / "old-results.csv";
  std::ofstream(file) << "id,kind,arm\n";
  EXPECT_ANY_THROW(read_results(file));
}

TEST(Scorecard, RefusesResultsOfSeveralVersions) {
  TrialResult one;
  one.version = "0123abc";
  TrialResult other = one;
  EXPECT_NO_THROW(scorecard({one, other}));
  other.version = "0123abc+changes-12ab34cd";
  EXPECT_THAT(scorecard({other}),
              HasSubstr("Version: 0123abc+changes-12ab34cd (modified source tree)."));
  EXPECT_ANY_THROW(scorecard({one, other}));
  EXPECT_ANY_THROW(require_one_version({one}, "4567def"));
}

TEST(Scorecard, SmallestEffectIsAMultipleOfTheNoise) {
  const auto trial = [](const char* strength, double error, Outcome outcome) {
    TrialResult one;
    one.kind = "frf";
    one.noise = 0.03;
    one.strength = strength;
    one.hidden = {"gravity"};
    one.error = error;
    one.outcome = outcome;
    return one;
  };
  // As many as a statement on 90 % of them takes.
  constexpr int kEnough = 20;
  std::vector<TrialResult> found;
  for (int i = 0; i < kEnough; ++i) {
    found.push_back(trial("weak", 0.048, Outcome::exact));
    found.push_back(trial("strong", 0.5, Outcome::in_class));
  }
  EXPECT_THAT(scorecard(found), HasSubstr("| smallest strength | < 1.6 (20) |"));
  // Where lesser ones are lost, it is the least that is found.
  auto with_faint = found;
  for (int i = 0; i < kEnough; ++i) with_faint.push_back(trial("faint", 0.015, Outcome::missed));
  EXPECT_THAT(scorecard(with_faint), HasSubstr("| smallest strength | 1.6 (20) |"));
  EXPECT_THAT(scorecard(with_faint), HasSubstr("| no effect identified | 20/20 (100 %) |"));
  // Faint ones are not among those that the first table counts.
  EXPECT_THAT(scorecard(with_faint), HasSubstr("| one effect: identified | 20/40 (50 %) |"));
  // One that is found by chance below others that are lost does not count.
  auto by_chance = with_faint;
  for (auto& one : by_chance) {
    if (one.strength == "strong") one.outcome = Outcome::wrong;
  }
  EXPECT_THAT(scorecard(by_chance), HasSubstr("| smallest strength | none |"));
  // Nothing is claimed of fewer trials.
  found.pop_back();
  EXPECT_THAT(scorecard(found), HasSubstr("| smallest strength | few (19) |"));
}

TEST(TrialList, HidesOnlyWhatTheDataShow) {
  const auto friction = list_trials({.effects = {"coulomb_friction"}, .strengths = {"middle"}});
  EXPECT_EQ(friction.size(), 2U);  // two noises, in time alone
  for (const auto& key : friction) EXPECT_EQ(key.kind, measured::RunKind::time);
  EXPECT_EQ(list_trials({.effects = {"none"}, .trials = 5}).size(), 30U);
  EXPECT_ANY_THROW(list_trials({.effects = {"friction"}}));
  const auto together = list_trials({.effects = {"coulomb_friction+hub_inertia"}, .trials = 2});
  ASSERT_EQ(together.size(), 12U);  // of three strengths
  EXPECT_THAT(together.front().hidden, ElementsAre("coulomb_friction", "hub_inertia"));
}

TEST(TrialList, AGivenSizeStandsInPlaceOfTheStrength) {
  const auto list = list_trials({.kinds = {"time"},
                                 .effects = {"beam_length"},
                                 .noises = {0.01},
                                 .trials = 5,
                                 .arm = "steel ruler",
                                 .size = 0.02});
  ASSERT_EQ(list.size(), 5U);
  EXPECT_EQ(list.front().id(), "time-beam_length-steel ruler-0.02-1-1@1");
}

TEST(Scorecard, WrongGeometryIsATableOfItsOwn) {
  TrialResult one;
  one.kind = "time";
  one.arm = "steel ruler";
  one.noise = 0.01;
  one.strength = "0.02";
  one.hidden = {"beam_length"};
  one.named = {"beam_length"};
  one.outcome = Outcome::exact;
  one.parameters = one.covered = 1;
  TrialResult crack = one;
  crack.named = {"local_stiffness_loss"};
  crack.outcome = Outcome::wrong;
  crack.covered = 0;
  const std::string card = scorecard({one, crack});
  EXPECT_THAT(card, HasSubstr("| beam_length, size 0.02, noise 1 % | 1/2 (50 %) | 1/2 (50 %) | "
                              "1/2 (50 %) |"));
  EXPECT_THAT(card, HasSubstr("\n2 simulated experiments"));
}

}  // namespace
}  // namespace flexarm::trials
