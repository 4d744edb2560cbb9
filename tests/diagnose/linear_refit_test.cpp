#include "diagnose/search/linear_refit.hpp"

#include "diagnose/search/fit.hpp"
#include "effects/registry/vocabulary.hpp"
#include "tests/diagnose/simulated_experiments.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace flexarm::diagnose {
namespace {

constexpr double kDrag_N_s2_per_m3 = 0.05;

Experiment with_drag() {
  return simulated_experiment(
      {effects::named("quadratic_drag", {{"coefficient", kDrag_N_s2_per_m3}})},
      {.duration_s = 1.5});
}

double sum_of_squares(const Problem& problem, const Candidate& candidate) {
  return problem.residuals(candidate, problem.estimation_runs())->squaredNorm();
}

ReportedWork unreported() {
  return ReportedWork({});
}

TEST(LinearRefit, ShowsAnEffectThatTheBaseHasTakenUp) {
  constexpr double kSecondOrder = 1.05;  // of the refit, beside noise
  const Experiment experiment = with_drag();
  const Problem problem(experiment);
  const auto damping = named(experiment, {"air_damping"}).front();
  const auto drag = named(experiment, {"quadratic_drag"}).front();
  const Candidate base = fit(problem, problem.as_filed().with(damping, damping.middle())).candidate;
  const double noise = sum_of_squares(problem, problem.as_filed().with(drag, {kDrag_N_s2_per_m3}));
  const double without = sum_of_squares(problem, base);
  ASSERT_GT(without, 4.0 * noise);
  // The damping stands for the drag, which is then there twice.
  const Candidate with = base.with(drag, {kDrag_N_s2_per_m3});
  EXPECT_GT(sum_of_squares(problem, with), without);
  const LinearRefit refit(problem, base, unreported());
  EXPECT_LT(refit.sum_of_squares(with), kSecondOrder * noise);
  EXPECT_LT(sum_of_squares(problem, refit.refitted(with)), 0.5 * without);
}

TEST(LinearRefit, OfABaseWithoutParametersIsTheSumOfSquares) {
  const Experiment experiment = with_drag();
  const Problem problem(experiment);
  const auto drag = named(experiment, {"quadratic_drag"}).front();
  const Candidate with = problem.as_filed().with(drag, {kDrag_N_s2_per_m3});
  const LinearRefit refit(problem, problem.as_filed(), unreported());
  EXPECT_EQ(refit.sum_of_squares(with), sum_of_squares(problem, with));
  EXPECT_EQ(refit.refitted(with).values, with.values);
}

TEST(LinearRefit, IsInfiniteForAnArmThatIsNone) {
  const Experiment experiment = with_drag();
  const Problem problem(experiment);
  const auto mass = named(experiment, {"payload_mass"}).front();
  const LinearRefit refit(problem, problem.as_filed(), unreported());
  EXPECT_EQ(refit.sum_of_squares(problem.as_filed().with(mass, {-1.0})),
            std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace flexarm::diagnose
