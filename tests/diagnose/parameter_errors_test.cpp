#include "diagnose/search/parameter_errors.hpp"

#include "effects/registry/vocabulary.hpp"
#include "tests/diagnose/simulated_experiments.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace flexarm::diagnose {
namespace {

/// Of the first parameter.
double standard_error(const Problem& problem, const Explanation& found, int further_modes = 0) {
  return standard_errors(problem, found, further_modes)[0];
}

TEST(StandardErrors, AreTheSpreadOfEstimatesOverSeeds) {
  constexpr int kSeeds = 24;
  // Mean of so many squares of normal numbers is within 0.35 to 2.0 in 999 of 1000; the larger of
  // two estimates of a variance is above either.
  constexpr double kLeast = 0.25;
  constexpr double kMost = 2.0;
  constexpr double kTruth_kg = 0.004;
  double squares = 0.0;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const Experiment experiment =
        simulated_experiment({effects::named("payload_mass", {{"mass", kTruth_kg}})},
                             {.duration_s = 1.0, .seed = static_cast<std::uint64_t>(seed)});
    const Problem problem(experiment);
    const auto hypothesis = named(experiment, {"payload_mass"}).front();
    const Explanation found =
        explain(problem, fit(problem, problem.as_filed().with(hypothesis, {kTruth_kg})));
    const double error = standard_error(problem, found);
    squares += std::pow((found.fit.candidate.values[0] - kTruth_kg) / error, 2);
  }
  EXPECT_GT(squares / kSeeds, kLeast);
  EXPECT_LT(squares / kSeeds, kMost);
}

TEST(StandardErrors, HoldWhatACoarseSimulationIsOff) {
  const Experiment experiment =
      simulated_experiment({effects::named("linear_density", {{"factor", 1.05}})},
                           {.duration_s = 2.0, .relative_noise = 1e-5});
  const Problem coarse(experiment, {.flexible_modes = 1});
  const auto hypothesis = named(experiment, {"linear_density"}).front();
  const Explanation found =
      explain(coarse, fit(coarse, coarse.as_filed().with(hypothesis, {1.05})));
  const double ignored = standard_error(coarse, found);
  const double carried = standard_error(coarse, found, 7);
  const double off = std::abs(found.fit.candidate.values[0] - 1.05);
  EXPECT_GT(carried, ignored);
  EXPECT_LT(off, 3.0 * carried) << "of " << ignored << " and " << carried;
}

TEST(StandardErrors, GrowWhereResidualsGoTogether) {
  // A bias that is not fitted leaves residuals of one sign over long stretches.
  const Experiment experiment = simulated_experiment(
      {effects::named("torque_bias", {{"torque", 0.0005}})}, {.duration_s = 2.0});
  const Problem problem(experiment);
  const auto hypothesis = named(experiment, {"payload_mass"}).front();
  const Explanation found =
      explain(problem, fit(problem, problem.as_filed().with(hypothesis, {0.001})));
  const double of_least_squares =
      1.0 / found.fit.jacobian.norm() *
      std::abs(hypothesis.parameters[0].value(found.fit.candidate.coordinates()(0) + 0.5e-6) -
               hypothesis.parameters[0].value(found.fit.candidate.coordinates()(0) - 0.5e-6)) /
      1e-6;
  EXPECT_GT(standard_error(problem, found), 3.0 * of_least_squares);
}

/// The static torque is looked for as how much it is above the Coulomb torque: its error is that of
/// a fit of the static torque itself.
TEST(StandardErrors, OfAParameterAboveAnotherAreThoseOfItsOwn) {
  const std::vector<double> truth = {0.01, 0.018, 0.2};
  const Experiment experiment = simulated_experiment(
      {effects::named("stribeck_friction",
                      {{"torque", truth[0]}, {"static_torque", truth[1]}, {"velocity", truth[2]}})},
      {.duration_s = 1.5});
  const Problem problem(experiment);
  Hypothesis hypothesis = named(experiment, {"stribeck_friction"}).front();
  ASSERT_TRUE(hypothesis.parameters[1].above_previous);
  const auto errors = [&] {
    const Explanation found =
        explain(problem, fit(problem, problem.as_filed().with(hypothesis, truth)));
    EXPECT_GE(found.fit.candidate.values[1], found.fit.candidate.values[0]);
    return standard_errors(problem, found, 0);
  };
  const std::vector<double> above = errors();
  hypothesis.parameters[1].above_previous = false;
  const std::vector<double> itself = errors();
  ASSERT_EQ(above.size(), 3U);
  for (std::size_t i = 0; i < above.size(); ++i) {
    EXPECT_GT(above[i], 0.0);
    // Both fits end within their tolerance of the same place, with derivatives by differences.
    EXPECT_NEAR(above[i] / itself[i], 1.0, 0.02) << i;
  }
}

TEST(StandardErrors, OfAnUncertainNumberAreAtMostItsUncertainty) {
  // Residuals of many times the signal.
  Experiment experiment = simulated_experiment({effects::named("torque_gain", {{"factor", 20.0}})},
                                               {.duration_s = 1.0});
  experiment.arm.relative_uncertainties = {{"damping.kelvin_voigt", 0.05}};
  const Problem problem(experiment);
  const Explanation found = explain(problem, fit(problem, problem.as_filed()));
  ASSERT_GT(found.estimation.relative_error, 0.9);
  const auto errors = standard_errors(problem, found, 0);
  ASSERT_EQ(errors.size(), 1U);
  // Data with such residuals say nothing of it.
  EXPECT_EQ(errors[0], 1.0);
}

}  // namespace
}  // namespace flexarm::diagnose
