#include "tests/app/flexarm_fixture.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace flexarm::testing_app {
namespace {

using Json = nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// The hub's response, which leaves delay and lag the same.
constexpr const char* kHubPlan =
    "[[run]]\nid = \"hub\"\nkind = \"frf\"\nsensors = [\"hub_angle\"]\nnoise = 0.01\n"
    "frequencies = { from = 0.5, to = 60.0, count = 60 }\n";
const std::vector<std::string> kFew = {"plan", "rig.toml", "measurement-plan.toml", "--effects",
                                       "time_delay,actuator_lag,hub_inertia"};

class PlanCommand : public Flexarm {
 protected:
  PlanCommand() {
    run({"new", "rig.toml"});
    write("measurement-plan.toml", kHubPlan);
  }
  Ended plan(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = kFew;
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }
};

TEST_F(PlanCommand, SaysWhatIsTiedAndProposesMore) {
  EXPECT_THAT(plan().output, AllOf(testing::StartsWith("3 of 3 effects are detectable"),
                                   HasSubstr("Improved plan"),
                                   testing::Not(HasSubstr("Value of one additional run"))));
  const Ended ended = plan({"--verbose"});
  EXPECT_EQ(ended.status, 0) << ended.errors;
  EXPECT_THAT(
      ended.output,
      AllOf(
          HasSubstr("3 of 3 effects are detectable"),
          HasSubstr(
              "1 pair is indistinguishable. Equivalence classes:\nactuator_lag / time_delay."),
          HasSubstr("Distinguishability of an effect that is present (row) from another (column)"),
          HasSubstr("Value of one additional run"), HasSubstr("Improved plan"),
          HasSubstr("\nnext: ")));
}

TEST_F(PlanCommand, WorksAsItsHelpSays) {
  const Ended help = run({"plan", "--help"});
  EXPECT_EQ(help.status, 0);
  const Ended ended = run(example_in(help.output));
  EXPECT_EQ(ended.status, 0) << ended.errors;
  EXPECT_THAT(names_in(), testing::Contains("improved-plan.toml"));
}

TEST_F(PlanCommand, TakesPrbsSineAndStepAsExcitations) {
  const std::string run_of =
      "[[run]]\nid = \"{}\"\nkind = \"time\"\nsensors = [\"hub_angle\"]\nduration = 1.0\n"
      "sample_time = 0.002\nexcitation = {{ kind = \"{}\", {} }}\n";
  write("measurement-plan.toml",
        fmt::format(fmt::runtime(run_of), "a", "prbs", "amplitude = 0.05, clock = 0.01") +
            fmt::format(fmt::runtime(run_of), "b", "sine", "frequency = 3.0, start = 0.1") +
            fmt::format(fmt::runtime(run_of), "c", "step", "amplitude = 0.02"));
  const Ended ended = plan();
  EXPECT_EQ(ended.status, 0) << ended.errors;
  EXPECT_THAT(ended.output, HasSubstr("of 3 effects are detectable"));
  write("measurement-plan.toml",
        fmt::format(fmt::runtime(run_of), "a", "prbs", "amplitude = 0.05, frequency = 1.0"));
  EXPECT_EQ(plan().status, 2);
  EXPECT_THAT(plan().errors, HasSubstr("allowed: amplitude, clock, register, seed"));
}

TEST_F(PlanCommand, WritesABetterPlanThatItAccepts) {
  ASSERT_EQ(plan({"--write", "better.toml"}).status, 0);
  const Ended again = run({"plan", "rig.toml", "better.toml", "--effects", "time_delay"});
  EXPECT_EQ(again.status, 0) << again.errors;
  EXPECT_THAT(again.output, HasSubstr("all pairs are distinguishable"));
}

TEST_F(PlanCommand, WritesTablesAndAllOfItAsJson) {
  const Ended ended = plan({"--out", "planned", "--json", "out.json"});
  EXPECT_EQ(ended.status, 0) << ended.errors;
  EXPECT_EQ(names_in("planned"),
            (std::vector<std::string>{"effects.csv", "improved-plan.toml", "leads.csv", "plan.json",
                                      "separations.csv", "separations.svg"}));
  EXPECT_THAT(text_of("planned/separations.svg"), HasSubstr("actuator lag"));
  const Json document = Json::parse(text_of("out.json"));
  EXPECT_EQ(document["schema"], "flexarm.plan/2");
  EXPECT_EQ(document["effects"].size(), 3U);
  EXPECT_EQ(document["separations"].size(), 6U);
  EXPECT_EQ(document["indistinguishable_pairs"].size(), 1U);
}

TEST_F(PlanCommand, RefusesWhatItCannotUse) {
  write("measurement-plan.toml", std::string(kHubPlan) + "sensor = \"tip\"\n");
  expect_refused(plan(),
                 "measurement-plan.toml:7: run (frf).sensor: unknown key (did you mean sensors?); "
                 "allowed: id, kind, purpose, payload, sensors, noise, frequencies");
  write("measurement-plan.toml", kHubPlan);
  const Ended typo = run({"plan", "rig.toml", "measurement-plan.toml", "--effects", "time_dely"});
  EXPECT_EQ(typo.status, 2);
  EXPECT_THAT(typo.errors, HasSubstr("--effects time_dely: unknown effect (did you mean "
                                     "time_delay?)"));
  const Ended unseen =
      run({"plan", "rig.toml", "measurement-plan.toml", "--effects", "coulomb_friction"});
  EXPECT_EQ(unseen.status, 2);
  EXPECT_THAT(unseen.errors, HasSubstr("has no influence on these runs"));
  const Ended over = plan({"--write", "measurement-plan.toml"});
  EXPECT_EQ(over.status, 2);
  EXPECT_EQ(text_of("measurement-plan.toml"), kHubPlan);
  EXPECT_THAT(names_in(), Not(testing::Contains("improved-plan.toml")));
}

TEST_F(PlanCommand, RefusesASensorThatTheArmCannotCarry) {
  write("measurement-plan.toml",
        "[[run]]\nid = \"far\"\nkind = \"frf\"\nsensors = [\"strain@9\"]\nfrequencies = [1.0]\n");
  const Ended ended = run({"plan", "rig.toml", "measurement-plan.toml"});
  EXPECT_EQ(ended.status, 2);
  EXPECT_THAT(ended.errors, HasSubstr("run far: "));
}

}  // namespace
}  // namespace flexarm::testing_app
