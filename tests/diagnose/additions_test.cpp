#include "diagnose/search/additions.hpp"

#include "effects/registry/vocabulary.hpp"
#include "tests/diagnose/simulated_experiments.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>
#include <variant>
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
    return additions(problem_, fit(problem_, base), others, others.size(), {}, work);
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

/// The additions of this effect beside nothing.
std::vector<Addition> additions_of(const Experiment& experiment, const Hypothesis& effect) {
  const Problem problem(experiment);
  const ReportedWork work({});
  return additions(problem, fit(problem, problem.as_filed()), {&effect}, 1, {}, work);
}

double largest_torque_N_m(const measured::MeasuredRun& run) {
  double largest_N_m = 0.0;
  for (const double torque_N_m : std::get<measured::TimeRecord>(run.data).torque_N_m) {
    largest_N_m = std::max(largest_N_m, std::abs(torque_N_m));
  }
  return largest_N_m;
}

constexpr SimulatedRuns kOneSecond{.duration_s = 1.0};
constexpr double kLimited = 0.8;

/// The runs of an actuator that saturates at kLimited of the largest torque of this run.
Experiment saturated(double largest_N_m) {
  return simulated_experiment(
      {effects::named("torque_saturation", {{"limit", kLimited * largest_N_m}})}, kOneSecond);
}

TEST(Additions, BeginNearTheLimitOfASaturation) {
  double largest_N_m = 0.0;
  for (const auto& run : simulated_experiment({}, kOneSecond).runs) {
    largest_N_m = std::max(largest_N_m, largest_torque_N_m(run));
  }
  const Experiment experiment = saturated(largest_N_m);
  const auto found = additions_of(experiment, named(experiment, {"torque_saturation"}).front());
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found.front().values.front(), kLimited * largest_N_m, 0.1 * kLimited * largest_N_m);
  EXPECT_GT(found.front().share, 0.5);
}

TEST(Additions, FindTheThresholdOfASaturation) {
  // Values are tried over the torque of all runs: of a run with a small torque the larger ones do
  // nothing, and the next one does far too much. It leads to 2.7 times the limit, which does
  // nothing.
  const Experiment bare = simulated_experiment({}, kOneSecond);
  const double largest_N_m = largest_torque_N_m(bare.runs[0]);
  ASSERT_LT(largest_N_m, 0.5 * largest_torque_N_m(bare.runs[1]));
  const Experiment all = saturated(largest_N_m);
  Experiment with_small_torque = all;
  with_small_torque.runs.resize(1);
  const auto found = additions_of(with_small_torque, named(all, {"torque_saturation"}).front());
  ASSERT_EQ(found.size(), 1U);
  // It saturates.
  EXPECT_LT(found.front().values.front(), largest_N_m);
  EXPECT_NEAR(found.front().values.front(), kLimited * largest_N_m, 0.2 * kLimited * largest_N_m);
  EXPECT_GT(found.front().share, 0.5);
}

TEST(Additions, OfAMassBeginAtSeveralPlaces) {
  const Experiment experiment = simulated_experiment(
      {effects::named("attached_mass", {{"mass", 0.01}, {"position", 0.7}})}, {.duration_s = 1.0});
  const auto found = additions_of(experiment, named(experiment, {"attached_mass"}).front());
  ASSERT_EQ(found.size(), 1U);
  std::set<double> positions_m = {found.front().values.back()};
  for (const auto& values : found.front().values_elsewhere) positions_m.insert(values.back());
  EXPECT_EQ(positions_m.size(), 3U);
}

}  // namespace
}  // namespace flexarm::diagnose
