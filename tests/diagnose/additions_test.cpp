#include "diagnose/search/additions.hpp"

#include "effects/registry/vocabulary.hpp"
#include "tests/diagnose/simulated_experiments.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string_view>
#include <vector>

namespace flexarm::diagnose {
namespace {

constexpr double kDelay_s = 0.004;

/// A late torque is hidden.
class AdditionsToALateArm : public testing::Test {
 protected:
  std::vector<Addition> beside(const Candidate& base,
                               const DiagnosisProgress& progress = {}) const {
    const ReportedWork work(progress);
    std::vector<const Hypothesis*> others;
    for (const Hypothesis& hypothesis : hypotheses_) others.push_back(&hypothesis);
    return additions(problem_, fit(problem_, base), others, {}, work);
  }
  double left(const Candidate& candidate) const {
    return problem_.residuals(candidate, problem_.estimation_runs())->squaredNorm();
  }

  const Experiment experiment_ = simulated_experiment(
      {effects::named("time_delay", {{"delay", kDelay_s}})}, {.duration_s = 1.0});
  const Problem problem_ = Problem(experiment_);
  const std::vector<Hypothesis> hypotheses_ =
      named(experiment_, {"air_damping", "drive_compliance", "hub_inertia", "time_delay"});
};

TEST_F(AdditionsToALateArm, BeginWithTheDelay) {
  const auto ranked = beside(problem_.as_filed());
  ASSERT_EQ(ranked.size(), hypotheses_.size());
  EXPECT_EQ(ranked.front().effect->effect, "time_delay");
  // Its change is nearly proportional to it: the start is near the delay.
  EXPECT_NEAR(ranked.front().values.front(), kDelay_s, 0.2 * kDelay_s);
  for (const Addition& addition : ranked) EXPECT_LE(addition.share, ranked.front().share);
}

TEST_F(AdditionsToALateArm, ExplainWhatTheyMakeSmaller) {
  const auto delay = beside(problem_.as_filed()).front();
  const double before = left(problem_.as_filed());
  const double after = left(problem_.as_filed().with(*delay.effect, delay.values));
  constexpr double kSecondOrder = 0.1;
  EXPECT_NEAR(delay.share, 1.0 - after / before, kSecondOrder);
}

TEST_F(AdditionsToALateArm, AreNoneOfTheEffectsThatTheBaseHas) {
  const Hypothesis& delay = hypotheses_.back();
  ASSERT_EQ(delay.effect, "time_delay");
  const auto ranked = beside(problem_.as_filed().with(delay, {kDelay_s}));
  EXPECT_EQ(ranked.size(), hypotheses_.size() - 1);
  for (const Addition& addition : ranked) {
    EXPECT_NE(addition.effect->effect, "time_delay");
    // Noise is left, of which some part is along each of a few changes.
    EXPECT_LT(addition.share, 0.02);
  }
}

TEST_F(AdditionsToALateArm, EndWhereTheWorkIsCancelled) {
  const DiagnosisProgress cancel = [](std::string_view, double) { return false; };
  EXPECT_THROW(beside(problem_.as_filed(), cancel), Cancelled);
}

}  // namespace
}  // namespace flexarm::diagnose
