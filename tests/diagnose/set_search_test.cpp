// Sets of effects that are found on the beginning of the runs.
#include "diagnose/search/set_search.hpp"

#include "diagnose/search/explanation.hpp"
#include "effects/registry/vocabulary.hpp"
#include "tests/diagnose/simulated_experiments.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::diagnose {
namespace {

using testing::Contains;
using testing::Each;
using testing::SizeIs;

/// Three hidden effects, two of which shift the frequencies.
class SetSearchOfThree : public testing::Test {
 protected:
  SetSearch search(const CoarseProblems& parts, ReportedWork& work) const {
    std::vector<const Hypothesis*> effects;
    for (const Hypothesis& hypothesis : hypotheses_) effects.push_back(&hypothesis);
    return {parts, effects, {}, options_, work};
  }
  static std::vector<std::set<std::string>> labels(const std::vector<Fit>& sets) {
    std::vector<std::set<std::string>> made;
    for (const Fit& set : sets) made.push_back(set.candidate.labels());
    return made;
  }

  const Experiment experiment_ =
      simulated_experiment({effects::named("hub_viscous_friction", {{"coefficient", 0.004}}),
                            effects::named("flexural_rigidity", {{"factor", 0.97}}),
                            effects::named("root_compliance", {{"stiffness", 60.0}})},
                           {.duration_s = 3.0});
  const Problem problem_ = Problem(experiment_);
  const std::vector<Hypothesis> hypotheses_ =
      named(experiment_, {"air_damping", "beam_length", "coulomb_friction", "flexural_rigidity",
                          "hub_inertia", "hub_viscous_friction", "linear_density", "payload_mass",
                          "root_compliance", "structural_damping", "time_delay", "torque_gain"});
  const SelectionOptions options_;
};

TEST_F(SetSearchOfThree, FindsThemWithoutBeingToldOfAny) {
  ReportedWork work({});
  const CoarseProblems parts(problem_, options_);
  ASSERT_TRUE(parts.is_early_shorter());
  SetSearch of_three = search(parts, work);
  of_three.begin(problem_.as_filed(), {});
  const auto pairs = of_three.grow("sets", 0.5);
  EXPECT_THAT(labels(pairs), Each(SizeIs(2)));
  const auto triples = of_three.grow("sets", 1.0);
  ASSERT_FALSE(triples.empty());
  EXPECT_EQ(
      triples.front().candidate.labels(),
      (std::set<std::string>{"flexural_rigidity", "hub_viscous_friction", "root_compliance"}));
  // On all data the fit from there leaves noise.
  EXPECT_TRUE(explain(problem_, fit(problem_, triples.front().candidate)).leaves_noise());
}

TEST_F(SetSearchOfThree, BeginsWithTheSinglesThatItIsGiven) {
  ReportedWork work({});
  const CoarseProblems parts(problem_, options_);
  const auto rigidity = named(experiment_, {"flexural_rigidity"}).front();
  const Candidate single = problem_.as_filed().with(rigidity, {0.97});
  const auto damping = named(experiment_, {"air_damping"}).front();
  SetSearch from_single(parts, {&damping}, {}, options_, work);
  from_single.begin(problem_.as_filed(), {single});
  EXPECT_THAT(labels(from_single.grow("sets", 1.0)),
              Contains(std::set<std::string>{"air_damping", "flexural_rigidity"}));
}

TEST_F(SetSearchOfThree, EndsWhereTheWorkIsCancelled) {
  const DiagnosisProgress cancel = [](std::string_view, double) { return false; };
  ReportedWork work(cancel);
  const CoarseProblems parts(problem_, options_);
  SetSearch cancelled = search(parts, work);
  EXPECT_THROW(cancelled.begin(problem_.as_filed(), {}), Cancelled);
}

}  // namespace
}  // namespace flexarm::diagnose
