#include "diagnose/diagnosis.hpp"
#include "diagnose/planning/plan.hpp"
#include "diagnose/search/explanation.hpp"
#include "diagnose/search/hypothesis.hpp"
#include "effects/registry/vocabulary.hpp"
#include "tests/diagnose/simulated_experiments.hpp"
#include "tests/diagnose/start_on_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace flexarm::diagnose {
namespace {

/// What was foretold of an effect against a rival, and what noisy data of another formulation and
/// integrator then gave: the lead of the effect, both refitted.
struct Foretold {
  double expected = 0.0;
  double found = 0.0;
};

Foretold foretell(const std::string& effect, double value, const std::string& rival) {
  const auto named = [](const Experiment& experiment, const std::string& name) {
    const auto all = hypotheses(experiment);
    return *std::ranges::find(all, name, &Hypothesis::effect);
  };
  // The plan knows the torques, the sensors and the noise, but no data with the effect.
  const Experiment without = simulated_experiment({});
  const Problem measured_without(without);
  const PlannedExperiment planned(without.arm, planned_as_measured(measured_without));
  const Hypothesis cause = named(planned.experiment(), effect);
  const Hypothesis other = named(planned.experiment(), rival);
  const Candidate truth{{cause}, {value}};
  const std::vector<bool> all(planned.experiment().runs.size(), true);
  const Problem foreseen =
      planned.problem(planned.as_described().predictor()(truth.extend(without.arm), all));
  const Candidate start =
      start_on_grid(foreseen, Candidate{{other}, {other.parameters[0].value(0.5)}}, 60);
  Foretold made;
  made.expected = separate_by_fit(foreseen, truth, start).lead;

  const std::string parameter = cause.parameters[0].name;
  const Experiment data = simulated_experiment({effects::named(effect, {{parameter, value}})});
  const Problem problem(data);
  const Explanation right = explain(problem, fit(problem, truth));
  const Candidate at_rival = separate_by_fit(foreseen, truth, start).rival;
  const Explanation wrong = explain(problem, fit(problem, at_rival));
  made.found = wrong.fit.sum_of_squares - right.fit.sum_of_squares;
  return made;
}

/// A lead of L, a sum of squares along one direction with noise, scatters by 2 sqrt(L).
double scatter(double lead) {
  return 2.0 * std::sqrt(std::max(1.0, lead));
}

TEST(Separation, ThatIsForetoldToBeATieIsOneInNoisyData) {
  const Foretold made = foretell("time_delay", 3e-5, "actuator_lag");
  EXPECT_LT(made.expected, kToldLead);
  EXPECT_LT(made.found, kToldLead);
}

TEST(Separation, ThatIsForetoldToBeToldIsToldByNoisyDataByAsMuch) {
  const Foretold made = foretell("flexural_rigidity", 1.0003, "linear_density");
  EXPECT_GT(made.expected, 10.0 * kToldLead);
  // The noise is estimated from data, to 10 % of its power; then four standard deviations.
  EXPECT_NEAR(made.found, made.expected, 0.1 * made.expected + 4.0 * scatter(made.expected));
}

TEST(Separation, ToFirstOrderIsThatOfAFit) {
  // Three numbers, one parameter: r = (1, 2, 2), J = (1, 0, 0): 8 is left of 9.
  Eigen::MatrixXd jacobian(3, 1);
  jacobian << 1.0, 0.0, 0.0;
  const Eigen::Vector3d residuals(1.0, 2.0, 2.0);
  EXPECT_NEAR(expected_lead(information_of(jacobian, residuals), 1, 3.0), 8.0, 1e-12);
  // A truth of one parameter more pays for it.
  EXPECT_NEAR(expected_lead(information_of(jacobian, residuals), 2, 3.0), 8.0 - std::log(3.0),
              1e-12);
  // Places that do the same are no more than one.
  Eigen::MatrixXd twice(3, 2);
  twice << jacobian, 2.0 * jacobian;
  EXPECT_NEAR(expected_lead(information_of(twice, residuals), 2, 3.0), 8.0, 1e-9);
}

/// Frequency responses of the hub alone, which leave delay and lag the same.
MeasurementPlan hub_response() {
  PlannedRun run;
  run.id = "hub";
  run.kind = measured::RunKind::frf;
  run.sensors = {{{arm::SensorKind::hub_angle}, 0.01}};
  run.frequencies = PlannedBand{0.5, 60.0, 60};
  return {"hub", {run}};
}

std::vector<Hypothesis> some_of(const arm::Arm& arm, const MeasurementPlan& plan,
                                const std::vector<std::string>& names) {
  auto all = hypotheses_of(arm, plan);
  std::erase_if(all, [&](const Hypothesis& hypothesis) {
    return std::ranges::find(names, hypothesis.effect) == names.end();
  });
  return all;
}

TEST(Plan, TiesDelayWithLagAndFindsTheRunThatTellsThem) {
  const arm::Arm arm = trial_arm();
  const MeasurementPlan hub = hub_response();
  const auto some = some_of(arm, hub, {"time_delay", "actuator_lag", "hub_inertia"});
  const Plan plan = plan_experiment(arm, hub, some);
  ASSERT_EQ(plan.ties.size(), 1U);
  ASSERT_EQ(plan.classes.size(), 1U);
  EXPECT_EQ(plan.classes.front().size(), 2U);
  EXPECT_GT(plan.separations[plan.ties[0].truth][plan.ties[0].rival]->cosine, 0.99);
  ASSERT_FALSE(plan.added.empty());
  // What adds up to first order is what a fit to all runs leaves.
  const double expected = plan.added.back().leads.front();
  EXPECT_GE(expected, kToldLead);
  EXPECT_NEAR(*plan.ties[0].lead_with_more, expected, 0.2 * expected);
  const MeasurementPlan better =
      parse_measurement_plan(format_measurement_plan(plan.better), "better.toml");
  EXPECT_EQ(better.runs.size(), 1 + plan.added.size());
  // Delay and lag are nothing at place 0, so that more runs find them at a lower one.
  const Plan again = plan_experiment(arm, better, some);
  for (const std::size_t i : plan.classes.front()) {
    EXPECT_LT(again.effects[i].smallest->coordinates()[0],
              plan.effects[i].smallest->coordinates()[0]);
  }
}

TEST(Plan, WithUnknownSizesTiesPayloadMassWithTorqueGain) {
  // What a torque that is too weak does to all responses, a payload and a lighter, softer beam do.
  const arm::Arm arm = trial_arm();
  const MeasurementPlan hub = hub_response();
  const auto some = some_of(arm, hub, {"payload_mass", "torque_gain"});
  EXPECT_TRUE(plan_experiment(arm, hub, some).ties.empty());
  PlanOptions options;
  options.unknown = {"flexural_rigidity", "linear_density", "hub_inertia"};
  const Plan plan = plan_experiment(arm, hub, some, options);
  ASSERT_EQ(plan.ties.size(), 1U);
  ASSERT_FALSE(plan.added.empty());
  EXPECT_EQ(plan.added.front().further.like, "hub");
  EXPECT_GT(plan.added.front().further.run.payload.value_or(arm::Payload{}).mass_kg, 0.0);
  // Velocity is what the angle says, in a channel more: with the angle again, three times the lead.
  const auto again = std::ranges::find_if(plan.further, [](const NextExperiment& next) {
    return next.further.run.id == "hub-hub_velocity";
  });
  ASSERT_NE(again, plan.further.end());
  EXPECT_NEAR(again->leads.front(), 3.0 * plan.ties.front().lead, 0.2 * plan.ties.front().lead);
}

TEST(Plan, IsEndedByItsProgress) {
  const arm::Arm arm = trial_arm();
  const MeasurementPlan hub = hub_response();
  const Plan plan = plan_experiment(arm, hub, some_of(arm, hub, {"hub_inertia", "hub_spring"}), {},
                                    [](std::string_view, double) { return false; });
  EXPECT_TRUE(plan.cancelled);
}

TEST(FurtherRuns, HaveIdsOfTheirOwnAndAPurpose) {
  const auto further = further_runs(trial_arm(), hub_response().runs);
  std::vector<std::string> ids = {"hub"};
  for (const FurtherRun& entry : further) {
    EXPECT_EQ(entry.run.purpose, measured::Purpose::estimation);
    EXPECT_EQ(std::ranges::find(ids, entry.run.id), ids.end()) << entry.run.id;
    ids.push_back(entry.run.id);
  }
  EXPECT_GE(further.size(), 6U);
}

TEST(WhatNext, OfADiagnosisThatIsSureIsNothing) {
  const Experiment experiment =
      simulated_experiment({effects::named("hub_inertia", {{"factor", 1.3}})}, {.duration_s = 2.0});
  auto some = hypotheses(experiment);
  std::erase_if(some, [](const Hypothesis& hypothesis) {
    return hypothesis.effect != "hub_inertia" && hypothesis.effect != "structural_damping";
  });
  const Diagnosis sure = diagnose(experiment, some);
  ASSERT_EQ(sure.verdict, Verdict::explained);
  EXPECT_TRUE(sure.next_experiments.empty());
}

// A delay of 2 % of a sampling period ties with a lag, and is below what the search names.
TEST(WhatNext, DISABLED_OfCausesThatAreTiedIsARunThatTellsThem) {
  const Experiment experiment =
      simulated_experiment({effects::named("time_delay", {{"delay", 4e-5}})}, {.duration_s = 2.0});
  auto some = hypotheses(experiment);
  std::erase_if(some, [](const Hypothesis& hypothesis) {
    return hypothesis.effect != "time_delay" && hypothesis.effect != "actuator_lag";
  });
  const Diagnosis tied = diagnose(experiment, some);
  ASSERT_EQ(tied.causes.size(), 1U);
  ASSERT_EQ(tied.causes.front().confusable_with.size(), 1U);
  ASSERT_FALSE(tied.next_experiments.empty());
  EXPECT_LE(tied.next_experiments.size(), kMostShown);
  const auto& scores = tied.next_experiments;
  EXPECT_TRUE(std::ranges::is_sorted(scores, std::ranges::greater{}, &NextExperiment::score));

  int asked = 0;
  const auto until_here = [&](std::string_view what, double) {
    if (what == "additional runs") ++asked;
    return asked < 2;
  };
  EXPECT_TRUE(diagnose(experiment, some, {}, until_here).cancelled);
  EXPECT_GE(asked, 2);
}

}  // namespace
}  // namespace flexarm::diagnose
