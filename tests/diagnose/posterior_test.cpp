#include "diagnose/search/posterior.hpp"

#include "diagnose/search/rivals.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace flexarm::diagnose {
namespace {

/// Returns a set of these effects with this score; `leaves_noise` or not.
Explanation set_of(const std::vector<std::string>& effects, double score, bool leaves_noise) {
  Explanation made;
  for (const std::string& effect : effects) {
    made.fit.candidate.effects.push_back({.effect = effect});
    made.fit.candidate.values.push_back(1.0);
  }
  made.score = score;
  if (!leaves_noise) made.estimation_test.level_p_value = 0.0;
  return made;
}

TEST(Posterior, IsTheExponentialOfScoresOverTheirSum) {
  const Explanation nothing = set_of({}, 14.0, false);
  const Explanation one = set_of({"payload_mass"}, 10.0, true);
  const Explanation pair = set_of({"payload_mass", "hub_inertia"}, 12.0, true);
  const Posterior posterior({&nothing, &one, &pair});
  const double sum = 1.0 + std::exp(-1.0) + std::exp(-2.0);
  EXPECT_NEAR(posterior.of_set(one.fit.candidate), 1.0 / sum, 1e-15);
  EXPECT_NEAR(posterior.of_set({}), std::exp(-2.0) / sum, 1e-15);
  EXPECT_NEAR(posterior.of({.effect = "hub_inertia"}), std::exp(-1.0) / sum, 1e-15);
  EXPECT_NEAR(posterior.of({.effect = "payload_mass"}), (1.0 + std::exp(-1.0)) / sum, 1e-15);
  EXPECT_NEAR(posterior.of_something_else(), std::exp(-2.0) / sum, 1e-15);
  EXPECT_EQ(posterior.of({.effect = "hub_spring"}), 0.0) << "was not fitted";
}

TEST(Posterior, OfScoresThatAreLargeAndNegativeIsFinite) {
  const Explanation nothing = set_of({}, 2e4, false);
  const Explanation right = set_of({"payload_mass"}, -3e5, true);
  const Posterior posterior({&nothing, &right});
  EXPECT_EQ(posterior.of({.effect = "payload_mass"}), 1.0);
  EXPECT_EQ(posterior.of_something_else(), 0.0);
}

TEST(Posterior, IsSharedByNamesOfOneModel) {
  const Explanation nothing = set_of({}, 1e3, false);
  Explanation friction = set_of({"hub_viscous_friction"}, 0.0, true);
  friction.fit.candidate.effects[0].other_names = {"back_emf"};
  const Posterior posterior({&nothing, &friction});
  EXPECT_NEAR(posterior.of(friction.fit.candidate.effects[0]), 0.5, 1e-12);
  EXPECT_NEAR(posterior.of_any(friction.fit.candidate.effects[0], {}), 1.0, 1e-12);
}

TEST(Posterior, OfEqualSetsIsEqualAndOfTheirClassSure) {
  const Explanation nothing = set_of({}, 1e3, false);
  const Explanation lag = set_of({"actuator_lag"}, 0.0, true);
  const Explanation delay = set_of({"time_delay"}, 0.0, true);
  const Posterior posterior({&nothing, &lag, &delay});
  const Hypothesis other{.effect = "time_delay"};
  EXPECT_NEAR(posterior.of({.effect = "actuator_lag"}), 0.5, 1e-12);
  EXPECT_NEAR(posterior.of_any({.effect = "actuator_lag"}, {&other}), 1.0, 1e-12);
}

TEST(ClassProbability, CountsRivalsThatFitAsWellAndNoneThatIsFarBetter) {
  const Explanation nothing = set_of({}, 1e3, false);
  const Explanation lag = set_of({"actuator_lag"}, 0.0, true);
  const Hypothesis rival{.effect = "time_delay"};
  const auto of_class = [&](double score) {
    const Explanation worse = set_of({"time_delay"}, score, true);
    const Posterior posterior({&nothing, &lag, &worse});
    const double odds = posterior.of_set(worse.fit.candidate) / posterior.of_set(lag.fit.candidate);
    const Hypothesis better{.effect = "actuator_lag"};
    return class_probability(rival, {{&better, odds, 0.0}}, posterior, Policy{}.odds);
  };
  EXPECT_GT(of_class(0.0), 0.999);
  EXPECT_LT(of_class(100.0), 0.001);
}

}  // namespace
}  // namespace flexarm::diagnose
