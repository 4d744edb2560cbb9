#include "diagnose/ranked/ranked_selection.hpp"

#include "effects/registry/vocabulary.hpp"
#include "measured/spectra/robust.hpp"
#include "tests/diagnose/simulated_experiments.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace flexarm::diagnose {
namespace {

const std::vector<std::string> kTested = {"coulomb_friction", "hub_spring", "payload_mass",
                                          "sensor_offset", "time_delay"};

Selection selected(const Experiment& experiment, const SelectionOptions& options = {}) {
  return ranked_selection(Problem(experiment), named(experiment, kTested), options, {});
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

TEST(RankedSelection, TakesTheArmAsFiledWhereThatLeavesNoise) {
  const Selection made = selected(simulated_experiment({}));
  EXPECT_TRUE(made.chosen.leaves_noise());
  EXPECT_TRUE(made.chosen.fit.candidate.effects.empty());
  EXPECT_TRUE(made.singles.empty()) << "nothing was to be searched for";
}

TEST(RankedSelection, NamesNoMoreCausesThanAreAskedFor) {
  const Experiment experiment =
      simulated_experiment({effects::named("coulomb_friction", {{"torque", 0.02}}),
                            effects::named("payload_mass", {{"mass", 0.005}})});
  EXPECT_EQ(selected(experiment).chosen.fit.candidate.effects.size(), 2u);
  const Selection one = selected(experiment, {.most_causes = 1});
  ASSERT_EQ(one.chosen.fit.candidate.effects.size(), 1u);
  EXPECT_EQ(one.chosen.fit.candidate.effects[0].effect, "coulomb_friction");
}

TEST(RankedSelection, DriftOfTheSensorsIsNoCauseAndHidesNone) {
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

TEST(RankedSelection, IsCancelledByTheProgress) {
  const Experiment experiment =
      simulated_experiment({effects::named("coulomb_friction", {{"torque", 0.02}})});
  const Selection made = ranked_selection(Problem(experiment), named(experiment, kTested), {},
                                          [](std::string_view, double) { return false; });
  EXPECT_TRUE(made.cancelled);
}

}  // namespace
}  // namespace flexarm::diagnose
