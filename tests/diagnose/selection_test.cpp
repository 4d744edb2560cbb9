#include "diagnose/search/selection.hpp"

#include "diagnose/search/rivals.hpp"
#include "effects/registry/vocabulary.hpp"
#include "measured/spectra/robust.hpp"
#include "tests/diagnose/simulated_experiments.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace flexarm::diagnose {
namespace {

const std::vector<std::string> kTested = {"coulomb_friction", "hub_spring", "payload_mass",
                                          "sensor_offset", "time_delay"};

Selection selected(const Experiment& experiment, const SelectionOptions& options = {}) {
  return select(Problem(experiment), named(experiment, kTested), options);
}

/// Adds a random walk that forgets itself in some 50 samples to each channel: 3 % of its signal.
void add_drift(Experiment& experiment) {
  constexpr double kForgets = 0.98;
  constexpr double kPart = 0.03;
  std::mt19937_64 bits(1);
  const auto uniform = [&bits] {  // of variance 1
    return (static_cast<double>(bits() >> 11U) * 0x1p-53 - 0.5) * std::sqrt(12.0);
  };
  for (auto& [run, data] : experiment.runs) {
    for (auto& channel : std::get<measured::TimeRecord>(data).channels) {
      const double mean = measured::mean(channel.values);
      double squares = 0.0;
      for (const double value : channel.values) squares += std::pow(value - mean, 2);
      const double deviation = std::sqrt(squares / static_cast<double>(channel.values.size()));
      double drift = 0.0;
      for (double& value : channel.values) {
        drift = kForgets * drift + std::sqrt(1.0 - kForgets * kForgets) * uniform();
        value += kPart * deviation * drift;
      }
    }
  }
}

TEST(Selection, TakesTheArmAsFiledWhereThatLeavesNoise) {
  const Selection made = selected(simulated_experiment({}));
  EXPECT_TRUE(made.chosen.leaves_noise());
  EXPECT_TRUE(made.chosen.fit.candidate.effects.empty());
  EXPECT_TRUE(made.singles.empty()) << "nothing was to be searched for";
}

TEST(Selection, NamesNoMoreCausesThanAreAskedFor) {
  const Experiment experiment =
      simulated_experiment({effects::named("coulomb_friction", {{"torque", 0.02}}),
                            effects::named("payload_mass", {{"mass", 0.005}})});
  EXPECT_EQ(selected(experiment).chosen.fit.candidate.effects.size(), 2u);
  const Selection one = selected(experiment, {.most_causes = 1});
  ASSERT_EQ(one.chosen.fit.candidate.effects.size(), 1u);
  EXPECT_EQ(one.chosen.fit.candidate.effects[0].effect, "coulomb_friction");
}

TEST(Selection, DriftOfTheSensorsIsNoCauseAndHidesNone) {
  Experiment experiment = simulated_experiment({});
  add_drift(experiment);
  const Selection nothing = selected(experiment);
  EXPECT_TRUE(nothing.chosen.fit.candidate.effects.empty());
  EXPECT_TRUE(nothing.chosen.leaves_noise());
  EXPECT_TRUE(nothing.problem.has_coloured_noise());

  Experiment with_mass = simulated_experiment({effects::named("payload_mass", {{"mass", 0.02}})});
  add_drift(with_mass);
  const Selection made = selected(with_mass);
  ASSERT_EQ(made.chosen.fit.candidate.effects.size(), 1u);
  EXPECT_EQ(made.chosen.fit.candidate.effects[0].effect, "payload_mass");
  EXPECT_NEAR(made.chosen.fit.candidate.values_of(0).front(), 0.02, 0.02 * 0.03);
  EXPECT_TRUE(made.chosen.leaves_noise());
}

TEST(Selection, ALimitStandsInThePlaceOfWhatContainsIt) {
  const Experiment experiment = simulated_experiment({}, {.duration_s = 0.5});
  const auto effects = named(experiment, {"coulomb_friction", "stribeck_friction", "payload_mass"});
  const auto effect = [&](const std::string& name) {
    return *std::ranges::find(effects, name, &Hypothesis::effect);
  };
  const Candidate mass = Candidate{}.with(effect("payload_mass"), {0.01});
  const Candidate coulomb = mass.with(effect("coulomb_friction"), {0.02});
  const Candidate stribeck = mass.with(effect("stribeck_friction"), {0.02, 0.03, 0.1});
  EXPECT_TRUE(is_limit(coulomb, stribeck));
  EXPECT_FALSE(is_limit(stribeck, coulomb));
  EXPECT_FALSE(is_limit(coulomb, coulomb));
  EXPECT_FALSE(is_limit(Candidate{}.with(effect("coulomb_friction"), {0.02}), stribeck));
}

TEST(Selection, IsCancelledByTheProgress) {
  const Experiment experiment =
      simulated_experiment({effects::named("coulomb_friction", {{"torque", 0.02}})});
  const Selection made = select(Problem(experiment), named(experiment, kTested), {},
                                [](std::string_view, double) { return false; });
  EXPECT_TRUE(made.cancelled);
}

TEST(Selection, ExchangesACauseThatStandsInThePlaceOfAnother) {
  // By itself each of the two is best at a value that hides the other; a soft place does better.
  const Experiment experiment =
      simulated_experiment({effects::named("linear_density", {{"factor", 0.8}}),
                            effects::named("hub_inertia", {{"factor", 1.3}})},
                           {.duration_s = 1.5});
  Problem problem(experiment);
  const Selection made = select(
      problem,
      named(experiment, {"local_stiffness_loss", "linear_density", "hub_inertia",
                         "flexural_rigidity", "root_compliance", "payload_mass", "torque_gain"}),
      {});
  const Candidate& chosen = made.chosen.fit.candidate;
  ASSERT_EQ(chosen.effects.size(), 2U) << chosen.label();
  EXPECT_TRUE(chosen.has(named(experiment, {"linear_density"}).front())) << chosen.label();
  EXPECT_TRUE(chosen.has(named(experiment, {"hub_inertia"}).front())) << chosen.label();
  EXPECT_TRUE(made.chosen.estimation.is_noise());
  for (const Explanation& rival : made.rivals) {
    EXPECT_GT(lead(made.chosen, rival), 10.0) << rival.fit.candidate.label();
  }
}

TEST(Selection, FindsThreeEffectsOfLikeSize) {
  // Each of them leaves an excess sum of squares of 2e6 by itself.
  const Experiment experiment =
      simulated_experiment({effects::named("torque_bias", {{"torque", 1.916e-4}}),
                            effects::named("hub_viscous_friction", {{"coefficient", 1.516e-3}}),
                            effects::named("flexural_rigidity", {{"factor", 0.99544}})},
                           {.duration_s = 1.5});
  const Selection made =
      select(Problem(experiment),
             named(experiment, {"torque_bias", "hub_viscous_friction", "torque_gain",
                                "flexural_rigidity", "payload_mass", "linear_density"}));
  const std::set<std::string> all = {"torque_bias", "hub_viscous_friction", "flexural_rigidity"};
  EXPECT_EQ(made.chosen.fit.candidate.labels(), all);
  EXPECT_TRUE(made.chosen.estimation.is_noise());
}

TEST(Selection, NamesOneEffectWhereTwoOthersStandForIt) {
  // Over a small part of a turn gravity and a bias make the torque of a tilt.
  const Experiment experiment =
      simulated_experiment({effects::named("tilt", {{"amplitude", 0.01}, {"angle", 0.6}}),
                            effects::named("sensor_delay", {{"delay", 0.004}}, "tip_acceleration")},
                           {.duration_s = 1.5});
  const Selection made = select(
      Problem(experiment),
      named(experiment, {"tilt", "gravity", "torque_bias", "sensor_delay", "flexural_rigidity"}));
  const Candidate& chosen = made.chosen.fit.candidate;
  ASSERT_EQ(chosen.effects.size(), 2U) << chosen.label();
  EXPECT_TRUE(chosen.has_effect("tilt")) << chosen.label();
  EXPECT_TRUE(chosen.has_effect("sensor_delay")) << chosen.label();
}

TEST(Selection, DoesNotTakeASmallEffectForTheTimingOfTheTorque) {
  // Which a fraction of a sample in each fortieth of a run goes along with for a good part.
  const Experiment experiment = simulated_experiment(
      {effects::named("hub_inertia", {{"factor", 1.004}})}, {.duration_s = 3.0});
  Problem problem(experiment);
  const Selection made =
      select(problem, named(experiment, {"hub_inertia", "flexural_rigidity", "torque_gain"}), {});
  EXPECT_FALSE(made.timing);
  ASSERT_EQ(made.chosen.fit.candidate.label(), "hub_inertia");
  EXPECT_NEAR(made.chosen.fit.candidate.values[0], 1.004, 1e-4);
}

}  // namespace
}  // namespace flexarm::diagnose
