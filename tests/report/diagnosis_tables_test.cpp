#include "report/tables/diagnosis_tables.hpp"

#include "report/json/diagnosis_json.hpp"
#include "report/tables/evidence_tables.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace flexarm::report {
namespace {

using diagnose::Diagnosis;
using diagnose::Verdict;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

Diagnosis with_gain(Verdict verdict) {
  Diagnosis made;
  made.verdict = verdict;
  made.estimation = {.before = 1.07, .after = 0.01, .noise_floor = 0.01};
  made.converged = true;
  return made;
}

diagnose::RefittedNumber number(const char* key, double value, double std_error) {
  return {.key = key,
          .file_value = 0.5,
          .uncertainty = 0.03,
          .value = value,
          .std_error = std_error,
          .unit = "m"};
}

diagnose::Cause cause(const char* effect, double confidence) {
  diagnose::Cause made;
  made.effect = effect;
  made.confidence = confidence;
  made.class_confidence = confidence;
  return made;
}

TEST(VerdictText, HasTheUncertainNumberThatExplainsTheDataInFront) {
  Diagnosis made = with_gain(Verdict::explained);
  made.refitted = {number("beam.length", 0.51, 0.0002), number("beam.thickness", 0.50001, 0.001)};
  EXPECT_THAT(verdict_text(made),
              StartsWith("Explained by beam.length = 0.51 +- 0.0002 m: the residuals are noise."));
  EXPECT_THAT(verdict_text(made), Not(HasSubstr("beam.thickness")));
  EXPECT_THAT(verdict_text(made), HasSubstr("NRMSE falls from 107 to 1 %"));
}

TEST(GradedVerdictText, HasCausesWithValuesAndGradesAndWhatIsLeft) {
  Diagnosis made = with_gain(Verdict::partly_explained);
  made.validation = {.before = 65.2, .after = 0.65, .noise_floor = 0.01};
  made.causes = {cause("coulomb_friction", 0.9)};
  made.causes[0].parameters = {{.name = "torque", .value = 0.021, .unit = "N m"}};
  made.causes[0].confusable_with = {"torque_dead_zone"};
  made.causes[0].grade = diagnose::Grade::supported;
  made.causes[0].figures = diagnose::EffectEvidence{.estimation = 40.0, .error_without = 0.8};
  diagnose::BandError& band = made.symptoms.bands.emplace_back();
  band.run_id = "low";
  band.sensor = "hub_angle";
  band.band = {"around mode 1", 2.0, 9.0};
  band.after = 0.5;
  band.noise = 0.01;
  EXPECT_EQ(verdict_text(made),
            "Partly explained: coulomb_friction 0.021 N m, or torque_dead_zone (supported). "
            "Held-out NRMSE falls from 6.52e+03 to 65 %; the noise floor is 1 %. The residuals are "
            "not noise: largest from 2 to 9 Hz at hub_angle (run low), 50 % of its signal.");
  const Table table = loss_table(made);
  ASSERT_EQ(table.rows.size(), 1u);
  EXPECT_EQ(std::get<std::string>(table.rows[0][1]), "supported");
}

TEST(GradedVerdictText, NamesTheFamilyWhereItsEffectsAloneAreTied) {
  Diagnosis made = with_gain(Verdict::partly_explained);
  made.causes = {cause("coulomb_friction", 0.6)};
  made.causes[0].confusable_with = {"torque_dead_zone"};
  made.causes[0].parameters = {{.name = "torque", .value = 0.021, .unit = "N m"}};
  made.causes[0].family = "dry friction of the hub";
  made.causes[0].names_family = true;
  made.causes[0].figures = diagnose::EffectEvidence{};
  EXPECT_THAT(verdict_text(made),
              StartsWith("Partly explained: dry friction of the hub: "
                         "coulomb_friction 0.021 N m, or torque_dead_zone (candidate)"));
}

TEST(VerdictText, TellsTheNumericalErrorFromNoise) {
  Diagnosis made = with_gain(Verdict::adequate);
  EXPECT_THAT(verdict_text(made), StartsWith("Adequate: the residuals are noise."));
  EXPECT_THAT(verdict_text(made), EndsWith("the noise floor is 1 %."));
  made.estimation.numerical_error = 0.05;
  EXPECT_THAT(verdict_text(made),
              StartsWith("Adequate: the residuals are within the numerical error"));
  EXPECT_THAT(verdict_text(made),
              EndsWith("the noise floor is 1 %, the numerical error of the simulation 5 %."));
}

TEST(VerdictText, SaysWhyAProbableEffectIsNotNamed) {
  Diagnosis made = with_gain(Verdict::unexplained);
  EXPECT_THAT(
      verdict_text(made),
      StartsWith("Unexplained: no effect that was tried has a probability of 0.5 or more."));
  made.near_misses = {{"air_damping", 0.91, 0.004, 523.0, 0.985}};
  EXPECT_THAT(verdict_text(made),
              StartsWith("Unexplained: no effect is identified. The most probable set, air_damping "
                         "(0.91), does not predict the validation runs better than the arm as "
                         "filed."));
}

TEST(ImplausibleNumbersText, HasThoseBeyondThreeStandardDeviations) {
  Diagnosis made = with_gain(Verdict::partly_explained);
  made.refitted = {number("beam.length", 0.51, 0.0002), number("beam.thickness", 0.6, 0.001)};
  EXPECT_EQ(implausible_numbers_text(made), "");
  made.refitted[1].deviation = -4.2;
  const std::string text = implausible_numbers_text(made);
  EXPECT_THAT(text, HasSubstr("beam.thickness = 0.6 m (4.2 standard deviations from "));
  EXPECT_THAT(text, Not(HasSubstr("beam.length")));
}

TEST(VerdictText, HasANumberThatMovedBesideTheCause) {
  Diagnosis made = with_gain(Verdict::explained);
  made.causes = {cause("coulomb_friction", 0.98)};
  made.refitted = {number("beam.length", 0.51, 0.0002)};
  EXPECT_THAT(
      verdict_text(made),
      StartsWith("Explained by coulomb_friction (probability 0.98), with beam.length = 0.51"));
}

TEST(VerdictText, OfIndistinguishableCausesHeadlinesTheirClass) {
  Diagnosis made = with_gain(Verdict::explained);
  made.causes = {cause("time_delay", 0.45)};
  made.causes[0].confusable_with = {"actuator_lag"};
  made.causes[0].class_confidence = 0.97;
  EXPECT_THAT(
      verdict_text(made),
      StartsWith("Explained by one of time_delay, actuator_lag (probability 0.97 together)"));
}

TEST(VerdictText, SaysThatTheFitDidNotConverge) {
  Diagnosis made = with_gain(Verdict::partly_explained);
  made.causes = {cause("coulomb_friction", 0.98)};
  EXPECT_THAT(verdict_text(made), Not(HasSubstr("converge")));
  made.converged = false;
  EXPECT_THAT(verdict_text(made), HasSubstr("The fit did not converge."));
}

TEST(VerdictText, NamesThePartOfTheResidualTestThatFails) {
  Diagnosis made = with_gain(Verdict::partly_explained);
  made.causes = {cause("coulomb_friction", 0.98)};
  made.validation_test.whiteness_p_value = 1e-9;
  const std::string text = verdict_text(made);
  EXPECT_THAT(text, HasSubstr("The residuals of the validation (whiteness p = 1e-09) runs"));
  EXPECT_THAT(text, EndsWith("Something else is present."));
}

TEST(VerdictText, OfAnIncompleteSearchLeavesOtherCausesOpen) {
  Diagnosis made = with_gain(Verdict::partly_explained);
  made.causes = {cause("coulomb_friction", 0.98)};
  made.search_end = diagnose::SearchEnd{"sets of effects", {"coulomb_friction + time_delay"}};
  made.time_limit_s = 60.0;
  EXPECT_THAT(verdict_text(made), EndsWith("other causes may explain the data as well."));
  EXPECT_THAT(search_text(made),
              HasSubstr("the time limit of 60 s ended it at the stage \"sets of effects\"."));
  EXPECT_THAT(search_text(made),
              HasSubstr("Not tried at this stage: coulomb_friction + time_delay."));
  made.estimation_test.level_p_value = 0.0;
  EXPECT_THAT(verdict_text(made), EndsWith("Something else is present."));
}

TEST(SearchText, ListsTheFirstOfManyUntriedSets) {
  Diagnosis made = with_gain(Verdict::unexplained);
  made.search_end = diagnose::SearchEnd{"sets of effects", {"a", "b", "c", "d", "e", "f"}};
  EXPECT_THAT(search_text(made), HasSubstr("Not tried at this stage: a, b, c, d, e, f."));
  made.search_end->untried.insert(made.search_end->untried.end(), {"g", "h"});
  EXPECT_THAT(search_text(made),
              HasSubstr("Not tried at this stage: a, b, c, d, e, f, and 2 others."));
}

TEST(SearchText, IsEmptyWhereAllWasSearched) {
  Diagnosis made = with_gain(Verdict::explained);
  EXPECT_EQ(search_text(made), "");
  made.excluded = {"gravity"};
  EXPECT_EQ(search_text(made), "Excluded from the search: gravity.");
}

TEST(DiagnosisTables, AShareIsFromNothingToAll) {
  EXPECT_EQ(explained_percent(-0.5), 0.0);
  EXPECT_EQ(explained_percent(0.25), 25.0);
  EXPECT_EQ(explained_percent(1.2), 100.0);
  Diagnosis made = with_gain(Verdict::unexplained);
  made.near_misses = {{"air_damping", 0.9, -0.5, 12.0, 0.04}};
  EXPECT_EQ(std::get<double>(near_miss_table(made).rows.at(0).at(2)), 0.0);
  made.causes.emplace_back().effect = "air_damping";
  made.causes[0].parameters.push_back({"coefficient", 1.0, 0.1, "N s/m^2"});
  made.causes[0].share = -0.5;
  EXPECT_EQ(std::get<double>(cause_table(made).rows.at(0).at(5)), 0.0);
  // The JSON as the text.
  made.causes.push_back(made.causes[0]);
  made.causes[1].share = 0.25;
  made.missing_force.emplace().ports = {{.place = "hub", .share = -0.2, .std_error = 0.1}};
  const auto json = diagnosis_json(made, "");
  EXPECT_EQ(json["causes"][0]["explained_share"], 0.0);
  EXPECT_EQ(json["causes"][1]["explained_share"], 0.25);
  EXPECT_EQ(json["candidates"][0]["explained_share"], 0.0);
  EXPECT_EQ(json["missing_force"]["ports"][0]["explained_share"], 0.0);
}

}  // namespace
}  // namespace flexarm::report
