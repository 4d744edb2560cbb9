#include "diagnose/planning/detection.hpp"
#include "diagnose/search/hypothesis.hpp"
#include "tests/diagnose/simulated_experiments.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace flexarm::diagnose {
namespace {

constexpr double kLeastGain = 10.0;

/// A run in time, short and with a payload, so that every effect may show.
std::vector<PlannedRun> short_run() {
  PlannedRun run;
  run.id = "pulses";
  run.payload = arm::Payload{0.06, 0.0};
  run.sensors = {{{arm::SensorKind::hub_angle}, 0.01}, {{arm::SensorKind::tip_acceleration}, 0.01}};
  run.torque = response::BangBang{.amplitude_N_m = 0.2, .pulse_s = 0.3};
  run.duration_s = 1.0;
  run.sample_time_s = 2e-3;
  return {run};
}

const Hypothesis& effect_named(const std::vector<Hypothesis>& all, const std::string& name) {
  return *std::ranges::find(all, name, &Hypothesis::effect);
}

TEST(Growth, BeginsWhereTheEffectDoesNothing) {
  const PlannedExperiment planned(trial_arm(), short_run());
  // In standard deviations. Springs end at 1e4 times the stiffest that is looked for, where they
  // still give a little.
  constexpr double kNothing = 0.05;
  int grown = 0;
  for (const Hypothesis& hypothesis : hypotheses(planned.experiment())) {
    for (const Growth& growth : growths_of(hypothesis)) {
      const auto nothing = planned.change_by(growth.at(0.0));
      ASSERT_TRUE(nothing) << hypothesis.label();
      EXPECT_LT(nothing->norm(), kNothing) << hypothesis.label();
      ++grown;
    }
  }
  // All but shear_and_rotary_inertia, which is there or not.
  EXPECT_GE(grown, 26);
}

TEST(Growth, OfStribecksFrictionKeepsTheRatioOfItsLevels) {
  const PlannedExperiment planned(trial_arm(), short_run());
  const auto all = hypotheses(planned.experiment());
  const Growth growth = growths_of(effect_named(all, "stribeck_friction")).front();
  for (const double strength : {0.01, 0.5, 1.0}) {
    const Candidate candidate = growth.at(strength);
    EXPECT_NEAR(candidate.values[1], 2.0 * candidate.values[0], 1e-12);
  }
}

TEST(Detection, IsWhereTheChangeIsWhatDiagnoseAsksFor) {
  const PlannedExperiment planned(trial_arm(), short_run());
  const auto all = hypotheses(planned.experiment());
  for (const char* name : {"payload_mass", "torque_gain", "root_compliance", "coulomb_friction"}) {
    const Detection found = detect(planned, effect_named(all, name), kLeastGain);
    ASSERT_TRUE(found.smallest) << name;
    const double asked = detectable_change(planned.as_described(), 1, kLeastGain);
    // The strength is found to 1 %, and changes grow with up to the square of it.
    EXPECT_NEAR(planned.change_by(*found.smallest)->norm(), asked, 0.03 * asked) << name;
    EXPECT_NEAR(found.compared_change, kCompared * asked, 0.03 * kCompared * asked) << name;
  }
}

TEST(Detection, TakesMoreOfAnEffectWhereTheNoiseIsLarger) {
  auto noisy = short_run();
  for (auto& sensor : noisy.front().sensors) sensor.noise *= 10.0;
  const PlannedExperiment clear(trial_arm(), short_run());
  const PlannedExperiment dim(trial_arm(), noisy);
  const auto mass = effect_named(hypotheses(clear.experiment()), "payload_mass");
  const double ratio = detect(dim, mass, kLeastGain).smallest->values[0] /
                       detect(clear, mass, kLeastGain).smallest->values[0];
  // Small changes grow in proportion to the mass.
  EXPECT_NEAR(ratio, 10.0, 0.5);
}

TEST(Detection, OfWhatTheRunsCannotShowIsNone) {
  // Poles say nothing of stiff shear at the noise of a twentieth.
  PlannedRun table;
  table.id = "table";
  table.kind = measured::RunKind::modal;
  table.poles = 2;
  table.noise = 0.05;
  table.damping_noise = 0.1;
  const PlannedExperiment planned(trial_arm(), {table});
  const auto all = hypotheses(planned.experiment());
  const Detection shear =
      detect(planned, effect_named(all, "shear_and_rotary_inertia"), kLeastGain);
  EXPECT_FALSE(shear.shows);
  EXPECT_FALSE(shear.compared);
  EXPECT_EQ(std::ranges::find(all, "torque_bias", &Hypothesis::effect), all.end());
}

}  // namespace
}  // namespace flexarm::diagnose
