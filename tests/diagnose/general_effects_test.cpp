// Effects that have another as a limit, by themselves: in which order, and what is left untried.
#include "diagnose/search/general_effects.hpp"

#include "effects/registry/vocabulary.hpp"
#include "tests/diagnose/simulated_experiments.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string_view>
#include <vector>

namespace flexarm::diagnose {
namespace {

using testing::ElementsAre;

/// What is tried by itself where Coulomb friction, fitted to an arm with this friction, leaves
/// noise.
Selection beside_coulomb_friction(const arm::Effects& friction) {
  const Experiment experiment = simulated_experiment(friction, {.duration_s = 2.0});
  const Problem problem(experiment);
  const std::vector<Hypothesis> hypotheses =
      named(experiment, {"coulomb_friction", "hub_hysteresis", "stribeck_friction"});
  const SelectionOptions options;
  ReportedWork work({});
  SetFits fits(problem, options, work);
  GeneralEffects general(hypotheses, options, fits);
  Selection made{problem};
  made.nothing = explain(problem, fit(problem, problem.as_filed(), {.most_steps = 0}));
  const Candidate none = made.nothing.fit.candidate;
  fits.add_with(none, general.others(), "effects", 0.5, options.single_effects, made.singles);
  EXPECT_TRUE(made.singles.front().leaves_noise());
  general.try_by_themselves(made, "effects", 1.0);
  return made;
}

TEST(GeneralEffects, AreLeftOutWhereTheirLimitLeavesNoMoreThanNoise) {
  const Selection made =
      beside_coulomb_friction({effects::named("coulomb_friction", {{"torque", 0.008}})});
  ASSERT_EQ(made.singles.size(), 1U);
  EXPECT_EQ(made.singles.front().fit.candidate.label(), "coulomb_friction");
}

TEST(GeneralEffects, AreFittedWhereTheyLeaveLessThanALimitThatLeavesNoise) {
  const Selection made = beside_coulomb_friction({effects::named(
      "stribeck_friction", {{"torque", 0.008}, {"static_torque", 0.0083}, {"velocity", 0.2}})});
  ASSERT_GE(made.singles.size(), 2U);
  EXPECT_EQ(made.singles.front().fit.candidate.label(), "stribeck_friction");
  EXPECT_GE(lead(made.singles.front(), made.singles.back()), 10.0);
}

/// Friction that changes with speed is hidden. It is searched for, and hysteresis, which is not
/// scanned by regression; both have Coulomb friction as a limit.
class GeneralEffectsOfFriction : public testing::Test {
 protected:
  /// With the arm as filed, and no single fitted yet.
  Selection unsearched() const {
    Selection made{problem_};
    made.nothing = explain(problem_, fit(problem_, problem_.as_filed(), {.most_steps = 0}));
    return made;
  }

  const Experiment experiment_ = simulated_experiment(
      {effects::named("stribeck_friction",
                      {{"torque", 0.008}, {"static_torque", 0.014}, {"velocity", 0.2}})},
      {.duration_s = 2.0});
  const Problem problem_ = Problem(experiment_);
  const std::vector<Hypothesis> hypotheses_ =
      named(experiment_, {"coulomb_friction", "hub_hysteresis", "stribeck_friction"});
  const SelectionOptions options_;
};

TEST_F(GeneralEffectsOfFriction, EndWithALawThatLeavesNoise) {
  int reports_after = 0;  // after the first part of the work
  bool is_done = false;
  const DiagnosisProgress count = [&](std::string_view, double done) {
    if (is_done) ++reports_after;
    is_done = is_done || done == 1.0;
    return true;
  };
  ReportedWork work(count);
  SetFits fits(problem_, options_, work);
  GeneralEffects general(hypotheses_, options_, fits);
  Selection made = unsearched();
  general.try_by_themselves(made, "effects", 1.0);
  ASSERT_EQ(made.singles.size(), 1U);
  EXPECT_EQ(made.singles.front().fit.candidate.label(), "stribeck_friction");
  EXPECT_TRUE(made.singles.front().leaves_noise());
  EXPECT_EQ(reports_after, 0) << "hysteresis was tried";
}

TEST_F(GeneralEffectsOfFriction, AreAllUntriedWhereTheWorkEndsInTheirScans) {
  const DiagnosisProgress cancel = [](std::string_view, double) { return false; };
  ReportedWork work(cancel);
  SetFits fits(problem_, options_, work);
  GeneralEffects general(hypotheses_, options_, fits);
  Selection made = unsearched();
  EXPECT_THROW(general.try_by_themselves(made, "effects", 1.0), Cancelled);
  EXPECT_THAT(fits.untried(), ElementsAre("hub_hysteresis", "stribeck_friction"));
}

}  // namespace
}  // namespace flexarm::diagnose
