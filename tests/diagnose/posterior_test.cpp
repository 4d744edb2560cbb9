#include "diagnose/search/posterior.hpp"

#include "diagnose/search/admission.hpp"
#include "diagnose/search/rivals.hpp"
#include "tests/diagnose/simulated_experiments.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace flexarm::diagnose {
namespace {

constexpr double kNumbers = 4000.0;
constexpr std::size_t kHypotheses = 25;

/// A set of these effects that leaves `excess` beyond noise.
Explanation set_of(const std::vector<std::string>& effects, double excess) {
  Explanation made;
  for (const std::string& effect : effects) {
    made.fit.candidate.effects.push_back({.effect = effect});
    made.fit.candidate.values.push_back(1.0);
  }
  made.estimation.count = kNumbers;
  made.estimation.sum_of_squares = kNumbers + excess;
  if (excess > 0.0) made.estimation_test.level_p_value = 0.0;
  return made;
}

TEST(Posterior, SumsToOneOverCausesThatExcludeEachOther) {
  const Explanation nothing = set_of({}, 300.0);
  const Explanation one = set_of({"payload_mass"}, 10.0);
  const Explanation other = set_of({"hub_inertia"}, 20.0);
  const Posterior posterior({&nothing, &one, &other}, kHypotheses, {});
  const double sum = posterior.of_set({}) + posterior.of({.effect = "payload_mass"}) +
                     posterior.of({.effect = "hub_inertia"});
  EXPECT_NEAR(sum, 1.0, 1e-12);
  EXPECT_GT(posterior.of({.effect = "payload_mass"}), posterior.of({.effect = "hub_inertia"}));
}

TEST(Posterior, IsSureOfACauseThatLeavesNoise) {
  const Explanation nothing = set_of({}, 1e6);
  const Explanation right = set_of({"payload_mass"}, 0.0);
  const Explanation wrong = set_of({"hub_inertia"}, 1e5);
  const Posterior posterior({&nothing, &right, &wrong}, kHypotheses, {});
  EXPECT_GT(posterior.of({.effect = "payload_mass"}), 0.999);
  EXPECT_LT(posterior.of_something_else(), 0.001);
}

TEST(Posterior, PrefersSomethingElseToACauseThatRemovesAPart) {
  // Of a deviation of another kind one of many effects removes three quarters by chance.
  const Explanation nothing = set_of({}, 1e6);
  const Explanation wrong = set_of({"hub_inertia"}, 2.5e5);
  const Posterior posterior({&nothing, &wrong}, kHypotheses, {});
  EXPECT_LT(posterior.of({.effect = "hub_inertia"}), 0.5);
  EXPECT_DOUBLE_EQ(posterior.of_something_else(), 1.0);
}

TEST(Posterior, OfEqualSetsIsEqualAndOfTheirClassSure) {
  const Explanation nothing = set_of({}, 1e6);
  const Explanation lag = set_of({"actuator_lag"}, 0.0);
  const Explanation delay = set_of({"time_delay"}, 0.0);
  const Posterior posterior({&nothing, &lag, &delay}, kHypotheses, {});
  const Hypothesis other{.effect = "time_delay"};
  EXPECT_NEAR(posterior.of({.effect = "actuator_lag"}), 0.5, 1e-3);
  EXPECT_GT(posterior.of_any({.effect = "actuator_lag"}, {&other}), 0.999);
}

TEST(ClassProbability, CountsRivalsThatFitAsWellAndNoneThatIsFarBetter) {
  const Explanation nothing = set_of({}, 1e6);
  const Explanation lag = set_of({"actuator_lag"}, 0.0);
  const Hypothesis rival{.effect = "time_delay"};
  const auto of_class = [&](double excess) {
    const Explanation worse = set_of({"time_delay"}, excess);
    const Posterior posterior({&nothing, &lag, &worse}, kHypotheses, {});
    const double odds = posterior.of_set(worse.fit.candidate) / posterior.of_set(lag.fit.candidate);
    const Hypothesis better{.effect = "actuator_lag"};
    return class_probability(rival, {{&better, odds, 0.0}}, posterior);
  };
  EXPECT_GT(of_class(0.0), 0.999);
  EXPECT_LT(of_class(1e5), 0.001);
}

TEST(Posterior, PrefersFewerParametersOfEqualFit) {
  const Explanation nothing = set_of({}, 1e6);
  const Explanation simple = set_of({"coulomb_friction"}, 0.0);
  Explanation general = set_of({"stribeck_friction"}, 0.0);
  general.fit.candidate.values = {1.0, 1.0, 1.0};
  const Posterior posterior({&nothing, &simple, &general}, kHypotheses, {});
  EXPECT_GT(posterior.of({.effect = "coulomb_friction"}), 0.95);
}

TEST(Posterior, TakesNoSmallDifferenceBesideAGrantedErrorForEvidence) {
  // Both pass as noise, with the error that a simulation is granted.
  const Explanation nothing = set_of({}, 1e6);
  Explanation simple = set_of({"coulomb_friction"}, 4000.0);
  Explanation general = set_of({"stribeck_friction"}, 3900.0);
  general.fit.candidate.values = {1.0, 1.0, 1.0};
  for (Explanation* set : {&simple, &general}) set->estimation_test = {};
  const Posterior posterior({&nothing, &simple, &general}, kHypotheses, {});
  EXPECT_GT(posterior.of({.effect = "coulomb_friction"}), 0.95);
}

TEST(Posterior, ExcusesNothingByTheNoiseLevelWhereNoSetLeavesNoise) {
  // Three effects bring the power of the residuals to 1.09 times that of the noise, which the
  // uncertainty of the noise level would excuse; but their residuals are not white.
  const Explanation nothing = set_of({}, 4.0 * kNumbers);
  Explanation three = set_of({"payload_mass", "beam_length", "hub_radius"}, 0.09 * kNumbers);
  ASSERT_EQ(three.estimation.excess(), 0.0);
  ASSERT_FALSE(three.leaves_noise());
  const Hypothesis payload_mass{.effect = "payload_mass"};
  EXPECT_LT(Posterior({&nothing, &three}, kHypotheses, {}).of(payload_mass), 0.1);
  const Explanation complete = set_of({"hub_inertia"}, 0.0);
  EXPECT_LT(Posterior({&nothing, &three, &complete}, kHypotheses, {}).of(payload_mass), 0.1);
  three.estimation_test = {};
  EXPECT_GT(Posterior({&nothing, &three}, kHypotheses, {}).of(payload_mass), 0.9)
      << "white: the noise level is all that differs";
}

/// A cause with one parameter at this coordinate with this standard error.
Explanation at_coordinate(double coordinate, double std_error) {
  Explanation made = set_of({"payload_mass"}, 0.0);
  const SearchedParameter mass{"mass", 0.001, 1.0, effects::Spacing::from_zero};
  made.fit.candidate.effects[0].parameters = {mass};
  made.fit.candidate.values = {mass.value(coordinate)};
  made.fit.jacobian = Eigen::MatrixXd::Constant(1, 1, 1.0 / std_error);
  made.estimation.independent = kNumbers;
  return made;
}

TEST(Admission, NeedsAParameterInsideItsRangeAndLargerThanItsError) {
  EXPECT_TRUE(is_identified(at_coordinate(0.4, 0.01)));
  EXPECT_FALSE(is_identified(at_coordinate(0.4, 0.5))) << "smaller than its standard error";
  EXPECT_FALSE(is_identified(at_coordinate(1.2, 0.01))) << "beyond the end";
  EXPECT_FALSE(is_identified(at_coordinate(1.0, 1e-5))) << "at the end";
  EXPECT_TRUE(is_identified(at_coordinate(1.004, 0.008))) << "inside by its error";
}

TEST(Admission, NeedsAParameterLargerThanTheErrorThatIsStated) {
  // Least squares says 0.01; with the correlation of the residuals it is 0.5.
  const Explanation found = at_coordinate(0.4, 0.01);
  const Candidate& candidate = found.fit.candidate;
  EXPECT_FALSE(unidentified_effect(candidate, Eigen::VectorXd::Constant(1, 0.01)).has_value());
  EXPECT_EQ(unidentified_effect(candidate, Eigen::VectorXd::Constant(1, 0.5)), 0);
  EXPECT_EQ(unidentified_effect(candidate, Eigen::VectorXd()), 0) << "a fit that failed";
}

TEST(Admission, CountsAnErrorThatTheToleranceOfTheNoiseLevelHides) {
  // A power of 1.08 times that of the noise is noise within the tolerance. Beside noise of 15 % of
  // the signal it may hide an error of 4 %, beside noise of 0.5 % only one of 0.14 %.
  const auto clears_beside = [](double noise_floor) {
    Explanation simpler = at_coordinate(0.4, 0.01);
    Explanation fuller = simpler;
    simpler.fit.candidate = {};
    simpler.estimation.sum_of_squares = 1.08 * kNumbers;
    for (Explanation* set : {&simpler, &fuller}) {
      Misfit& left = set->estimation;
      left.noise_floor = noise_floor;
      left.relative_error = noise_floor * std::sqrt(left.sum_of_squares / kNumbers);
    }
    EXPECT_TRUE(simpler.estimation.is_noise());
    return clears_bars(fuller, simpler, {});
  };
  EXPECT_TRUE(clears_beside(0.15));
  EXPECT_FALSE(clears_beside(0.005));
}

}  // namespace
}  // namespace flexarm::diagnose
