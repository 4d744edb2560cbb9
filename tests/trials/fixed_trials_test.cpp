// A few trials that every build has to pass, through the library. Those that are DISABLED_ take 12
// s or more each, or are not found and say so; `scripts/trials fixed` runs them as well.
// scripts/trials makes many more.
#include "diagnose/diagnosis.hpp"
#include "diagnose/search/hypothesis.hpp"
#include "diagnose/search/selection.hpp"
#include "diagnose/search/torque_noise.hpp"
#include "tests/trials/trial_case.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace flexarm::trials {
namespace {

namespace fs = std::filesystem;
using measured::RunKind;
using testing::AnyOf;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAre;
using testing::UnorderedElementsAreArray;

struct FixedAnswer {
  diagnose::Verdict verdict;
  diagnose::PredictorKind predictor;
  std::vector<std::string> effects;
  std::vector<std::string> established;  ///< of these (diagnose::Grade)
};

diagnose::Experiment recorded(const TrialKey& key) {
  const fs::path folder = fs::path(testing::TempDir()) / ("trial-" + key.folder_name());
  fs::remove_all(folder);
  write_case(key, folder);
  diagnose::Experiment experiment = diagnose::read_experiment(folder / "measurement.toml");
  fs::remove_all(folder);
  return experiment;
}

std::vector<diagnose::Hypothesis> hypotheses_of(const diagnose::Experiment& experiment,
                                                const std::set<std::string>& tried) {
  auto hypotheses = diagnose::hypotheses(experiment);
  std::erase_if(hypotheses, [&](const auto& one) { return !tried.contains(one.effect); });
  return hypotheses;
}

/// Those of the effects that are there and of some others.
std::vector<diagnose::Hypothesis> hypotheses_of(const diagnose::Experiment& experiment,
                                                const TrialKey& key, std::set<std::string> others) {
  others.insert(key.hidden.begin(), key.hidden.end());
  return hypotheses_of(experiment, others);
}

/// The search by output error among these.
diagnose::Explanation chosen_of(const TrialKey& key, const std::set<std::string>& others) {
  const diagnose::Experiment experiment = recorded(key);
  return select(diagnose::Problem(experiment), hypotheses_of(experiment, key, others), {}).chosen;
}

/// That finds what is hidden and nothing else, and leaves noise.
void expect_hidden_found(const TrialKey& key, const std::set<std::string>& others) {
  const diagnose::Explanation chosen = chosen_of(key, others);
  EXPECT_TRUE(chosen.leaves_noise());
  EXPECT_THAT(chosen.fit.candidate.labels(), UnorderedElementsAreArray(key.hidden));
}

FixedAnswer answer_of(const diagnose::Diagnosis& diagnosis) {
  FixedAnswer answer{diagnosis.verdict, diagnosis.predictor, {}, {}};
  for (const auto& cause : diagnosis.causes) {
    answer.effects.push_back(cause.effect);
    if (cause.grade == diagnose::Grade::established) answer.established.push_back(cause.effect);
  }
  return answer;
}

/// Expects that effects which imitate what acts, and is not among those tried, are not established.
void expect_not_explained(const FixedAnswer& answer) {
  EXPECT_THAT(answer.verdict,
              AnyOf(diagnose::Verdict::unexplained, diagnose::Verdict::partly_explained));
  EXPECT_THAT(answer.established, IsEmpty());
}

/// The effect `unknown` is not among those tried.
FixedAnswer diagnosed(const TrialKey& key, const diagnose::SelectionOptions& options = {},
                      const std::string& unknown = "") {
  const diagnose::Experiment experiment = recorded(key);
  auto hypotheses = diagnose::hypotheses(experiment);
  std::erase_if(hypotheses, [&](const auto& one) { return one.effect == unknown; });
  return answer_of(diagnose::diagnose(experiment, hypotheses, options));
}

/// Among the effects that are there, as far as the library has them, and some others.
FixedAnswer diagnosed_among(const TrialKey& key, const std::set<std::string>& others) {
  const diagnose::Experiment experiment = recorded(key);
  return answer_of(diagnose::diagnose(experiment, hypotheses_of(experiment, key, others), {}));
}

TEST(FixedTrial, NothingHiddenInTime) {
  const FixedAnswer answer = diagnosed({.kind = RunKind::time});
  EXPECT_EQ(answer.verdict, diagnose::Verdict::adequate);
  EXPECT_THAT(answer.effects, IsEmpty());
}

TEST(FixedTrial, ALinearEffectInTime) {
  const FixedAnswer answer = diagnosed({.kind = RunKind::time, .hidden = {"root_compliance"}});
  EXPECT_EQ(answer.verdict, diagnose::Verdict::explained);
  EXPECT_THAT(answer.effects, ElementsAre("root_compliance"));
}

TEST(FixedTrial, FrictionInTime) {
  const FixedAnswer answer = diagnosed({.kind = RunKind::time, .hidden = {"coulomb_friction"}});
  EXPECT_EQ(answer.verdict, diagnose::Verdict::explained);
  EXPECT_THAT(answer.effects, ElementsAre("coulomb_friction"));
}

TEST(FixedTrial, DISABLED_ATenthOfAPeriodOfRippleInOneRun) {
  // The hub turns by 0.37 rad, 0.7 rad of a ripple of two cycles per revolution. A tilt leaves
  // 0.508 % of the signal, the ripple 0.504 %; the search names the tilt.
  const FixedAnswer answer = diagnosed(
      {.kind = RunKind::time, .hidden = {"torque_ripple"}, .seed = 2, .dirt = "single_run"});
  EXPECT_EQ(answer.verdict, diagnose::Verdict::explained);
  EXPECT_THAT(answer.effects, ElementsAre("torque_ripple"));
}

TEST(FixedTrial, OneCycleOfRippleIsATilt) {
  // A tilt is a ripple of one cycle: that fits as well and has a parameter more.
  const TrialKey key{.kind = RunKind::time, .hidden = {"tilt"}, .seed = 1, .dirt = "single_run"};
  const diagnose::Experiment experiment = recorded(key);
  const auto hypotheses =
      hypotheses_of(experiment, {"tilt", "torque_ripple", "torque_bias", "hub_spring"});
  const auto answer = diagnose::diagnose(experiment, hypotheses, {});
  EXPECT_EQ(answer.verdict, diagnose::Verdict::explained);
  ASSERT_EQ(answer.causes.size(), 1U);
  EXPECT_EQ(answer.causes.front().effect, "tilt");
  EXPECT_THAT(answer.causes.front().confusable_with, ElementsAre("torque_ripple"));
}

TEST(FixedTrial, ThreeEffectsOfWhichTwoActLikeAnother) {
  // The inertia of the payload acts like the soft root and the lighter beam together: the best pair
  // has it beside the friction, and no third effect beside these two leaves noise.
  expect_hidden_found({.kind = RunKind::time,
                       .hidden = {"root_compliance", "linear_density", "hub_viscous_friction"},
                       .seed = 2,
                       .arm = "aluminium link"},
                      {"payload_inertia", "payload_offset", "hub_inertia"});
}

TEST(FixedTrial, AFourthEffectThatShowsLate) {
  // Gravity hardly shows in the first part of the runs, and is most of what is left of all of them:
  // there the best three effects leave more than two of which one is gravity.
  const auto chosen = chosen_of({.kind = RunKind::time,
                                 .hidden = {"sensor_lag", "gravity", "payload_inertia"},
                                 .seed = 11,
                                 .dirt = "wrong_sensor_gain"},
                                {"sensor_gain"});
  EXPECT_TRUE(chosen.leaves_noise());
  EXPECT_THAT(chosen.fit.candidate.labels(),
              UnorderedElementsAre("sensor_lag on strain@0.05", "gravity", "payload_inertia",
                                   "sensor_gain on tip_acceleration"));
}

TEST(FixedTrial, DISABLED_TwoEffectsThatHideEachOther) {
  // A stiffer beam with a crack: beside the crack where it is alone, the rigidity that a score test
  // expects leads away from both.
  const auto chosen =
      chosen_of({.kind = RunKind::time,
                 .hidden = {"flexural_rigidity", "local_stiffness_loss", "coulomb_friction"},
                 .seed = 11,
                 .dirt = "gauge_zero"},
                {"sensor_offset"});
  EXPECT_TRUE(chosen.leaves_noise());
  EXPECT_THAT(chosen.fit.candidate.labels(),
              UnorderedElementsAre("flexural_rigidity", "local_stiffness_loss", "coulomb_friction",
                                   "sensor_offset on strain@0.05"));
}

TEST(FixedTrial, DISABLED_AMassInTheRightOneOfSeveralPlaces) {
  // At 0.21 m it does nearly what it does at 0.80 m, where it is: 3.2 % of the signal are left. The
  // search does not get away from there.
  expect_hidden_found({.kind = RunKind::time,
                       .hidden = {"beam_length", "tuned_mass", "structural_damping"},
                       .seed = 11,
                       .dirt = "hub_sensors_only"},
                      {"beam_thickness"});
}

TEST(FixedTrial, AMassOnASpringUnderNoisyTorque) {
  // A scan of its four parameters ends near 0.10 m, where 0.55 % of the signal are left.
  const diagnose::Experiment experiment = recorded(
      {.kind = RunKind::time, .hidden = {"tuned_mass"}, .seed = 12, .dirt = "noisy_torque"});
  const auto problem = diagnose::with_torque_noise(diagnose::Problem(experiment));
  ASSERT_TRUE(problem);
  const auto chosen =
      diagnose::select(*problem, hypotheses_of(experiment, {"tuned_mass"}), {}).chosen;
  EXPECT_TRUE(chosen.leaves_noise());
  ASSERT_THAT(chosen.fit.candidate.labels(), ElementsAre("tuned_mass"));
  constexpr double kPosition_m = 0.55924;
  EXPECT_NEAR(chosen.fit.candidate.values[3], kPosition_m, 0.005);
}

TEST(FixedTrial, DISABLED_AnEffectThatTheOthersDoNotNeed) {
  // The search comes from a longer, a thinner and a softer beam to the crack and the soft drive.
  // Beside these no other number of the beam changes anything, so that no such set is identified.
  expect_hidden_found(
      {.kind = RunKind::time,
       .hidden = {"drive_compliance", "local_stiffness_loss", "hub_viscous_friction"},
       .seed = 12,
       .dirt = "outliers"},
      {"root_compliance", "beam_length", "beam_thickness", "flexural_rigidity", "attached_mass",
       "root_damping", "tuned_mass", "linear_density", "payload_inertia"});
}

TEST(FixedTrial, DISABLED_ThreeEffectsOfWhichNoTwoAreIdentified) {
  // Of all pairs the disturbance and a mass on a spring come nearest on the first part of the data,
  // where the mass, with any damping, stands for damping and inertia.
  expect_hidden_found({.kind = RunKind::time,
                       .hidden = {"structural_damping", "payload_inertia", "disturbance_torque"},
                       .seed = 12,
                       .dirt = "hub_sensors_only"},
                      {"tuned_mass", "attached_mass", "payload_offset", "drive_compliance"});
}

TEST(FixedTrial, DISABLED_ThreeEffectsBesideNumbersThatAreWrong) {
  // Rigidity and mass of the beam and inertia of the hub are wrong by some per cent, and the file
  // does not say so.
  const TrialKey key{.kind = RunKind::time,
                     .hidden = {"tilt", "attached_mass", "torque_saturation"},
                     .number = 2,
                     .seed = 13,
                     .dirt = "undeclared_numbers"};
  const FixedAnswer answer = diagnosed_among(key, {"torque_bias"});
  EXPECT_EQ(answer.verdict, diagnose::Verdict::explained);
  EXPECT_THAT(answer.effects, UnorderedElementsAreArray(key.hidden));
}

TEST(FixedTrial, ASoftDriveUnderDrift) {
  // The drift of a sensor is a third of what a soft root leaves, so that a soft drive in its place
  // does not clear the bars in white noise.
  expect_hidden_found(
      {.kind = RunKind::time, .hidden = {"drive_compliance"}, .seed = 12, .dirt = "drift"},
      {"root_compliance", "root_damping", "payload_inertia", "linear_density", "hub_inertia",
       "sensor_offset"});
}

TEST(FixedTrial, DISABLED_ThreeEffectsUnderDrift) {
  // The sensors drift by up to a fifth of their signals, beside which no set of effects clears the
  // bars; a constant torque does nearly what the tilt does.
  expect_hidden_found({.kind = RunKind::time,
                       .hidden = {"payload_offset", "tilt", "linear_density"},
                       .seed = 11,
                       .dirt = "drift"},
                      {"torque_bias", "sensor_offset"});
}

TEST(FixedTrial, ASecondCauseInClosedLoopIsNoNoiseOfTheTorque) {
  // The controller turns the noise of its sensors into torque, which is recorded as it was. Taken
  // for an error of the record it makes residuals noise beside the rigidity alone. That is 0.6 %
  // off, beside a thickness that is 1 % off.
  const TrialKey key{.kind = RunKind::time,
                     .hidden = {"flexural_rigidity", "beam_thickness", "payload_mass"},
                     .dirt = "closed_loop"};
  const FixedAnswer answer = diagnosed_among(key, {"hub_inertia", "linear_density"});
  EXPECT_EQ(answer.verdict, diagnose::Verdict::explained);
  EXPECT_EQ(answer.predictor, diagnose::PredictorKind::output_error);
  EXPECT_THAT(answer.effects, UnorderedElementsAreArray(key.hidden));
}

TEST(FixedTrial, AMovingBaseIsNoGainOfASensor) {
  // Its motion is as large as the hub's near a resonance, where most lines of the responses are:
  // they show a gain of 2.3, with which a simulation errs 32 % of the signal, after 14 %.
  const TrialKey key{.kind = RunKind::time, .hidden = {"moving_base"}, .seed = 13};
  const FixedAnswer answer = diagnosed_among(key, {"sensor_gain"});
  expect_not_explained(answer);
}

TEST(FixedTrial, AMovingBaseIsNoNoiseOfTheHubsSensors) {
  // It adds 11 % to the hub velocity, and nothing to strain and acceleration of the tip.
  const TrialKey key{.kind = RunKind::time, .hidden = {"moving_base"}, .seed = 14};
  const FixedAnswer answer = diagnosed_among(key, {"sensor_gain"});
  EXPECT_EQ(answer.verdict, diagnose::Verdict::unexplained);
}

TEST(FixedTrial, ATaperedBeamIsNoInertiaOfTheHub) {
  // The balance of the hub's torque with the reaction of a beam that is not uniform shows a hub
  // inertia of 0.973 with probability 1. By simulation the density fits alike, but each run asks
  // for another one: 0.967 to 0.978.
  const TrialKey key{.kind = RunKind::time, .hidden = {"tapered_beam"}, .seed = 13};
  const FixedAnswer answer = diagnosed_among(key, {"hub_inertia", "linear_density"});
  expect_not_explained(answer);
}

TEST(FixedTrial, StribeckFrictionIsMoreThanCoulombFriction) {
  // Most samples need two or three shorter steps: friction falls by a third as the hub comes to
  // rest, twenty times a second.
  const FixedAnswer answer =
      diagnosed_among({.kind = RunKind::time, .hidden = {"stribeck_friction"}},
                      {"stribeck_friction", "coulomb_friction", "hub_viscous_friction"});
  EXPECT_EQ(answer.verdict, diagnose::Verdict::explained);
  EXPECT_THAT(answer.effects, ElementsAre("stribeck_friction"));
}

TEST(FixedTrial, ABacklashIsNoSoftRoot) {
  // A root of 842 N m/rad leaves 4.4 of 18 % of the signals, but each run asks for another
  // stiffness: 786 to 906 N m/rad.
  const TrialKey key{.kind = RunKind::time, .hidden = {"backlash"}, .seed = 16};
  const FixedAnswer answer = diagnosed_among(key, {"root_compliance"});
  expect_not_explained(answer);
}

TEST(FixedTrial, AnActuatorsLagInFrequency) {
  const FixedAnswer answer = diagnosed({.kind = RunKind::frf, .hidden = {"actuator_lag"}});
  EXPECT_EQ(answer.verdict, diagnose::Verdict::explained);
  EXPECT_THAT(answer.effects, ElementsAre("actuator_lag"));
}

TEST(FixedTrial, ASoftDriveInFrequency) {
  const FixedAnswer answer = diagnosed({.kind = RunKind::frf, .hidden = {"drive_compliance"}});
  EXPECT_EQ(answer.verdict, diagnose::Verdict::explained);
  EXPECT_THAT(answer.effects, ElementsAre("drive_compliance"));
}

TEST(FixedTrial, ThePayloadsCentreInPolesAndZeros) {
  const FixedAnswer answer = diagnosed({.kind = RunKind::modal, .hidden = {"payload_offset"}});
  EXPECT_EQ(answer.verdict, diagnose::Verdict::explained);
  EXPECT_THAT(answer.effects, ElementsAre("payload_offset"));
}

TEST(FixedTrial, ACauseThatHasNoName) {
  // Without pairs of effects, which take most of the time; scripts/trials tries those too.
  const FixedAnswer answer =
      diagnosed({.kind = RunKind::frf, .hidden = {"tuned_mass"}}, {.most_causes = 1}, "tuned_mass");
  EXPECT_THAT(answer.verdict,
              AnyOf(diagnose::Verdict::unexplained, diagnose::Verdict::partly_explained));
}

}  // namespace
}  // namespace flexarm::trials
