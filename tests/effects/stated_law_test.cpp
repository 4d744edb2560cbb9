// Laws of hub torque that an arm file states, where effects of the library are honoured too.
#include "arm/given_effects.hpp"
#include "diagnose/planning/detection.hpp"
#include "diagnose/search/hypothesis.hpp"
#include "effects/registry/stated_entry.hpp"
#include "effects/registry/vocabulary.hpp"
#include "laws/effect_arms.hpp"
#include "response/formulation_maker.hpp"
#include "response/time/arm_simulator.hpp"
#include "response/time/time_model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <complex>
#include <map>
#include <string>
#include <vector>

namespace flexarm::effects {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr int kPoles = 4;

arm::HubTorqueFormula formula(const std::string& text, const std::vector<std::string>& numbers) {
  arm::HubTorqueFormula made{text, {}};
  for (const auto& number : numbers) made.numbers.push_back({number});
  return made;
}

arm::Arm with_law(const std::string& text, const std::map<std::string, double>& values) {
  std::vector<std::string> numbers;
  for (const auto& [name, value] : values) numbers.push_back(name);
  arm::Arm made = laws::damped_arm();
  made.effects["my_law"] = {
      .definition = arm::define_effect("my_law", formula(text, numbers), values),
      .parameters = values};
  return made;
}

arm::Arm with_effects_of_library(double stiffness, double damping) {
  arm::Arm made = laws::damped_arm();
  if (stiffness > 0.0) put(made, "hub_spring", {{"stiffness", stiffness}});
  if (damping > 0.0) put(made, "hub_viscous_friction", {{"coefficient", damping}});
  return made;
}

std::vector<std::complex<double>> poles_of(std::string_view formulation, const arm::Arm& arm) {
  const auto made = response::make_formulation(formulation, arm, kPoles);
  const auto poles = response::damped_poles(made, kPoles);
  std::vector<std::complex<double>> all = {poles.lowest.first_rad_per_s,
                                           poles.lowest.second_rad_per_s};
  for (const auto& pair : poles.flexible) all.push_back(pair.first_rad_per_s);
  return all;
}

void expect_same_poles(const arm::Arm& one, const arm::Arm& other) {
  constexpr double kSame = 1e-7;  // of slopes by differences
  for (const auto name : response::kFormulationNames) {
    const auto ours = poles_of(name, one);
    const auto theirs = poles_of(name, other);
    ASSERT_EQ(ours.size(), theirs.size());
    for (std::size_t i = 0; i < ours.size(); ++i) {
      EXPECT_LE(std::abs(ours[i] - theirs[i]), kSame * std::abs(theirs[i])) << name << " " << i;
    }
  }
}

std::vector<double> pulses() {
  std::vector<double> torque;
  for (int k = 0; k < 400; ++k) torque.push_back(k % 120 < 60 ? 0.15 : -0.12);
  return torque;
}

Eigen::MatrixXd simulated(const arm::Arm& arm) {
  const std::vector<arm::Sensor> sensors = {arm::parse_sensor("hub_angle"),
                                            arm::parse_sensor("tip_acceleration")};
  const auto parts = response::take_apart(arm);
  const auto model = response::time_model(
      response::make_formulation("exact_tf", parts.linear, kPoles), parts, kPoles, sensors);
  return response::ArmSimulator(model, parts, sensors, {.sample_time_s = 2e-3, .energy = false})
      .readings(pulses());
}

void expect_same_motion(const arm::Arm& one, const arm::Arm& other) {
  constexpr double kOrderFour = 1e-7;  // of inner steps in which forces vary
  const Eigen::MatrixXd theirs = simulated(other);
  EXPECT_LT((simulated(one) - theirs).norm(), kOrderFour * theirs.norm());
}

TEST(StatedLaw, ThatIsLinearIsASpringAndADashpot) {
  const arm::Arm stated = with_law("-k*theta - c*omega", {{"c", 0.004}, {"k", 0.5}});
  const arm::Arm library = with_effects_of_library(0.5, 0.004);
  expect_same_poles(stated, library);
  expect_same_motion(stated, library);
  EXPECT_THAT(response::nonlinear_effects(stated), IsEmpty());
  EXPECT_THAT(response::linearised_effects(stated), IsEmpty());
}

TEST(StatedLaw, WithoutDampingKeepsItsSpring) {
  const arm::Arm stated = with_law("-k*theta - c*omega", {{"c", 0.004}, {"k", 0.5}});
  const arm::LinearArm undamped = arm::linear_arm(response::without_damping(stated));
  EXPECT_FALSE(undamped.is_damped());
  EXPECT_NEAR(undamped.hub_spring_N_m_per_rad, 0.5, 1e-12);
}

TEST(StatedLaw, WithSlopesAtRestHasThePolesOfThese) {
  const arm::Arm pendulum = with_law("-m*sin(theta) - 0.1*omega*abs(omega)", {{"m", 0.5}});
  expect_same_poles(pendulum, with_effects_of_library(0.5, 0.0));
  EXPECT_THAT(response::nonlinear_effects(pendulum), ElementsAre("my_law"));
  EXPECT_THAT(response::linearised_effects(pendulum), ElementsAre("my_law"));
}

TEST(StatedLaw, WithoutSlopesAtRestLeavesThePolesAsTheyAre) {
  for (const std::string text : {"-k*theta^3", "k*theta", "-k*max(theta, 0)", "k*omega"}) {
    const arm::Arm stated = with_law(text, {{"k", 0.3}});
    expect_same_poles(stated, laws::damped_arm());
    EXPECT_THAT(response::nonlinear_effects(stated), ElementsAre("my_law")) << text;
    EXPECT_THAT(response::linearised_effects(stated), IsEmpty()) << text;
  }
}

TEST(StatedLaw, MovesAsTheSameLawOfTheLibrary) {
  expect_same_motion(with_law("-F*sign(omega)", {{"F", 0.012}}), [] {
    arm::Arm made = laws::damped_arm();
    put(made, "coulomb_friction", {{"torque", 0.012}});
    return made;
  }());
  expect_same_motion(with_law("a*sin(9*theta + 0.4)", {{"a", 0.02}}), [] {
    arm::Arm made = laws::damped_arm();
    put(made, "torque_ripple", {{"amplitude", 0.02}, {"cycles", 9.0}, {"phase", 0.4}});
    return made;
  }());
  expect_same_motion(with_law("b", {{"b", 0.01}}), [] {
    arm::Arm made = laws::damped_arm();
    put(made, "torque_bias", {{"torque", 0.01}});
    return made;
  }());
}

/// A stated law with `ranges`, its other numbers known.
arm::HubTorqueHypothesis supposed(const std::string& text,
                                  const std::map<std::string, arm::Interval>& ranges,
                                  const std::map<std::string, double>& known = {}) {
  std::map<std::string, double> all = known;
  for (const auto& [name, range] : ranges) all[name] = 0.0;
  std::vector<std::string> numbers;
  for (const auto& [name, value] : all) numbers.push_back(name);
  return {formula(text, numbers), ranges, known};
}

TEST(StatedEntry, IsSearchedWithinTheRangesOfTheFile) {
  const Entry entry =
      stated_entry("my_law", supposed("-k*abs(theta)^n*sign(theta) + b - c*omega^3",
                                      {{"k", {0.01, 10.0}}, {"n", {1.5, 5.0}}, {"b", {-0.1, 0.2}}},
                                      {{"c", 0.1}}));
  const auto searched = entry.search({});
  ASSERT_EQ(searched.size(), 3U);
  EXPECT_EQ(searched[0].name, "b");
  EXPECT_EQ(searched[0].spacing, Spacing::linear);
  EXPECT_EQ(searched[0].value(0.0), -0.1);
  EXPECT_NEAR(searched[0].value(1.0), 0.2, 1e-15);
  EXPECT_EQ(searched[1].spacing, Spacing::logarithmic);
  EXPECT_NEAR(searched[1].value(1.0), 10.0, 1e-12);
  EXPECT_EQ(searched[2].spacing, Spacing::logarithmic);
  for (const auto& parameter : searched)
    EXPECT_FALSE(parameter.neutral_coordinate()) << parameter.name;
  EXPECT_EQ(entry.shows, Shows::in_time);
  EXPECT_EQ(entry.refuted_by,
            "a residual hub torque that is not a function of the hub velocity and the hub angle");
}

TEST(StatedEntry, ANumberWithWhichTheLawVanishesIsNeutralAtZero) {
  const auto place_of = [](const arm::Interval& range) {
    const auto parameter =
        stated_entry("my_law", supposed("-k*theta^3", {{"k", range}})).search({}).front();
    const auto place = parameter.neutral_coordinate();
    return place ? parameter.value(*place) : -1.0;
  };
  EXPECT_EQ(place_of({0.01, 10.0}), 0.0);
  EXPECT_EQ(place_of({0.0, 10.0}), 0.0);
  EXPECT_EQ(place_of({-5.0, 10.0}), 0.0);
}

TEST(StatedEntry, ASlopeAtRestShowsInEveryKindOfData) {
  EXPECT_EQ(stated_entry("a", supposed("-k*sin(theta)", {{"k", {0.1, 1.0}}})).shows, Shows::in_all);
  EXPECT_EQ(stated_entry("a", supposed("-k*theta^3", {{"k", {0.1, 1.0}}})).shows, Shows::in_time);
}

/// What `laws::damped_arm` with the hypothesis does under `pulses`.
diagnose::PlannedExperiment planned(const arm::Arm& arm) {
  diagnose::PlannedRun run;
  run.id = "pulses";
  run.torque = pulses();
  run.sample_time_s = 2e-3;
  run.duration_s = run.sample_time_s * static_cast<double>(pulses().size());
  run.sensors = {{arm::parse_sensor("hub_angle"), 1e-3}};
  return {arm, {run}};
}

TEST(StatedHypothesis, IsACandidateBesideTheLibrary) {
  arm::Arm arm = laws::damped_arm();
  arm.hypotheses["my_law"] =
      supposed("-k*abs(theta)^n*sign(theta)", {{"k", {0.01, 100.0}}}, {{"n", 3.0}});
  const auto experiment = planned(arm);
  const auto all = diagnose::hypotheses(experiment.experiment());
  const auto found = std::ranges::find(all, "my_law", &diagnose::Hypothesis::effect);
  ASSERT_NE(found, all.end());
  EXPECT_EQ(all.size(), diagnose::hypotheses(planned(laws::damped_arm()).experiment()).size() + 1);
  const arm::Arm extended = diagnose::extended(arm, *found, std::vector{0.5});
  EXPECT_TRUE(extended.hypotheses.empty());
  EXPECT_EQ(extended.effects.at("my_law").value("k"), 0.5);
  EXPECT_EQ(extended.effects.at("my_law").value("n"), 3.0);
  const auto detected = diagnose::detect(experiment, *found, 10.0);
  EXPECT_TRUE(detected.shows);
  EXPECT_TRUE(detected.smallest.has_value());
}

}  // namespace
}  // namespace flexarm::effects
