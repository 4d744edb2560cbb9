#include "diagnose/search/hypothesis.hpp"

#include "arm/effects.hpp"
#include "diagnose/search/candidate.hpp"
#include "diagnose/search/hypothesis.hpp"
#include "effects/registry/vocabulary.hpp"
#include "tests/diagnose/simulated_experiments.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <variant>

namespace flexarm::diagnose {
namespace {

Experiment short_experiment() {
  return simulated_experiment({}, {.duration_s = 0.2});
}

TEST(Hypotheses, AreTheWholeVocabulary) {
  // Long enough for the hub to turn by half a period of a torque ripple.
  const Experiment experiment = simulated_experiment({}, {.duration_s = 2.0});
  std::set<std::string> names;
  for (const Hypothesis& hypothesis : hypotheses(experiment)) {
    names.insert(hypothesis.effect);
  }
  for (const auto& definition : effects::vocabulary()) {
    EXPECT_TRUE(names.contains(definition->name)) << definition->name;
  }
  EXPECT_EQ(names.size(), effects::vocabulary().size());
}

TEST(Hypotheses, AreOneASensorOfAnEffectOnASensor) {
  const auto all = hypotheses(short_experiment());
  for (const char* effect : {"sensor_lag", "sensor_gain", "sensor_offset", "sensor_delay"}) {
    EXPECT_EQ(std::ranges::count(all, effect, &Hypothesis::effect), 4) << effect;
  }
}

TEST(Hypotheses, MoveAStrainGaugeAlone) {
  for (const Hypothesis& hypothesis : hypotheses(short_experiment())) {
    if (hypothesis.effect != "gauge_position") continue;
    EXPECT_EQ(arm::parse_sensor(hypothesis.sensor).kind, arm::SensorKind::strain);
  }
}

TEST(Hypotheses, OfAnOffsetReachAsFarAsTheReadingsAndHaveTheirUnit) {
  Experiment experiment = short_experiment();
  experiment.runs.resize(1);
  auto& record = std::get<measured::TimeRecord>(experiment.runs[0].data);
  for (auto& channel : record.channels) std::ranges::fill(channel.values, 0.0);
  std::ranges::fill(record.channels[0].values, -0.25);
  const auto all = hypotheses(experiment);
  EXPECT_EQ(std::ranges::count(all, "sensor_offset", &Hypothesis::effect), 1);
  const auto offset = *std::ranges::find(all, "sensor_offset", &Hypothesis::effect);
  EXPECT_EQ(offset.parameters[0].lowest, -0.5);
  EXPECT_EQ(offset.parameters[0].highest, 0.5);
  EXPECT_EQ(offset.unit_of(offset.parameters[0]), arm::unit(record.channels[0].sensor));
}

TEST(Hypotheses, OfAModalTableMoveTheGaugesWhoseZerosItHas) {
  Experiment experiment = short_experiment();
  experiment.runs.resize(1);
  experiment.runs[0].run.kind = measured::RunKind::modal;
  measured::ModalEntry zero;
  zero.sensor = arm::parse_sensor("strain@0.05");
  zero.feature = measured::Feature::zero;
  zero.frequency_Hz = 20.0;
  measured::ModalEntry hub_zero = zero;
  hub_zero.sensor = arm::parse_sensor("hub_angle");
  experiment.runs[0].data = measured::ModalTable{hub_zero, zero};
  const auto all = hypotheses(experiment);
  ASSERT_EQ(std::ranges::count(all, "gauge_position", &Hypothesis::effect), 1);
  EXPECT_EQ(std::ranges::find(all, "gauge_position", &Hypothesis::effect)->sensor, "strain@0.05");
}

TEST(Hypotheses, ExtendTheArmToAValidOneOverTheirWholeRange) {
  const Experiment experiment = short_experiment();
  for (const Hypothesis& hypothesis : hypotheses(experiment)) {
    for (const double place : {0.0, 0.3, 1.0}) {
      std::vector<double> values;
      for (const auto& parameter : hypothesis.parameters) values.push_back(parameter.value(place));
      const arm::Arm arm = extended(experiment.arm, hypothesis, values);
      EXPECT_NO_THROW(arm::require_valid(arm)) << hypothesis.label() << " at " << place;
    }
  }
}

TEST(Hypotheses, AreScaledByTheMeasuredVelocityOfTheHub) {
  Experiment experiment = short_experiment();
  const auto velocity_of = [&](const arm::SensorKind kind) {
    for (auto& run : experiment.runs) {
      auto& record = std::get<measured::TimeRecord>(run.data);
      std::erase_if(record.channels, [](const measured::Channel& channel) {
        return arm::is_collocated(channel.sensor);
      });
      measured::Channel hub{{kind, 0.0}, {}};
      for (const double time_s : record.time_s) {
        hub.values.push_back(kind == arm::SensorKind::hub_angle ? 3.0 * time_s : 3.0);
      }
      hub.values[5] = 1e9;  // an outlier
      hub.left_out = {5};
      record.channels.push_back(hub);
    }
    return scales_of(experiment).speed_rms_rad_per_s;
  };
  // Rounding of differences of times.
  EXPECT_NEAR(velocity_of(arm::SensorKind::hub_angle), 3.0, 1e-9);
  EXPECT_NEAR(velocity_of(arm::SensorKind::hub_velocity), 3.0, 1e-9);
}

TEST(Hypotheses, OfDissipationAreCertainWhereTheFileStatesNone) {
  Experiment experiment = short_experiment();
  const auto is_certain = [&] {
    for (const Hypothesis& one : hypotheses(experiment)) {
      if (one.effect == "air_damping") return one.is_family_certain;
    }
    return false;
  };
  experiment.arm.damping.kelvin_voigt_s = 1e-4;
  EXPECT_FALSE(is_certain());
  experiment.arm.damping.kelvin_voigt_s = 0.0;
  EXPECT_TRUE(is_certain());
  experiment.arm.effects = {effects::named("structural_damping", {{"time", 1e-4}})};
  EXPECT_FALSE(is_certain());
}

TEST(Hypotheses, LeaveOutWhatTheArmHasAlready) {
  Experiment experiment = short_experiment();
  effects::put(experiment.arm, "hub_spring", {{"stiffness", 1.0}});
  const auto all = hypotheses(experiment);
  EXPECT_EQ(std::ranges::find(all, "hub_spring", &Hypothesis::effect), all.end());
}

TEST(Hypotheses, OfPolesAndZerosAreLinearEffectsOfTheArmAlone) {
  Experiment experiment = short_experiment();
  experiment.runs.resize(1);
  experiment.runs[0].run.kind = measured::RunKind::modal;
  experiment.runs[0].data = measured::ModalTable{};
  for (const Hypothesis& hypothesis : hypotheses(experiment)) {
    EXPECT_TRUE(hypothesis.entry->definition->is_of_linear_arm()) << hypothesis.effect;
  }
}

TEST(SearchedParameter, CoordinatesAndValuesAreInverse) {
  using effects::Spacing;
  constexpr double kRounding = 1e-12;
  for (const Spacing spacing :
       {Spacing::linear, Spacing::logarithmic, Spacing::from_zero, Spacing::from_infinity}) {
    const SearchedParameter parameter{"x", 0.02, 5.0, spacing};
    for (const double place : {0.01, 0.4, 0.97}) {
      EXPECT_NEAR(parameter.coordinate(parameter.value(place)), place, kRounding);
    }
  }
}

TEST(SearchedParameter, EndsWhereItSaysAndBeginsAtNothing) {
  EXPECT_DOUBLE_EQ((SearchedParameter{"x", 0.02, 5.0, effects::Spacing::from_zero}.value(1.0)),
                   5.0);
  EXPECT_EQ((SearchedParameter{"x", 0.02, 5.0, effects::Spacing::from_zero}.value(0.0)), 0.0);
  EXPECT_NEAR((SearchedParameter{"x", 0.02, 5.0, effects::Spacing::from_infinity}.value(1.0)), 0.02,
              1e-15);
  EXPECT_GT((SearchedParameter{"x", 0.02, 5.0, effects::Spacing::from_infinity}.value(0.0)), 1e4);
}

TEST(Hypotheses, EndWhereTheyAskForMoreAndNotWhereTheyDoNothing) {
  const auto all = hypotheses(short_experiment());
  for (const char* name : {"hub_inertia", "structural_damping", "root_compliance", "torque_bias"}) {
    const Hypothesis& one = *std::ranges::find(all, name, &Hypothesis::effect);
    const SearchedParameter& size = one.parameters.front();
    const double nothing = *size.neutral_coordinate();
    EXPECT_FALSE(one.is_at_end_of_range(std::vector{size.value(nothing)})) << name;
    EXPECT_FALSE(one.is_at_end_of_range(std::vector{size.value(0.5 * (1.0 + nothing))})) << name;
    EXPECT_TRUE(one.is_at_end_of_range(std::vector{size.value(1.0)})) << name;
    EXPECT_EQ(one.is_at_end_of_range(std::vector{size.value(0.0)}), nothing > 0.0) << name;
  }
}

TEST(Candidate, WithoutAnEffectKeepsTheValuesOfTheOthers) {
  const auto all = hypotheses(short_experiment());
  const auto named = [&](const char* name) {
    return *std::ranges::find(all, name, &Hypothesis::effect);
  };
  const Candidate three = Candidate{}
                              .with(named("payload_mass"), {0.1})
                              .with(named("local_stiffness_loss"), {0.3, 20.0})
                              .with(named("time_delay"), {0.004});
  const Candidate two = three.without(1);
  EXPECT_EQ(two.values, (std::vector{0.1, 0.004}));
  EXPECT_EQ(two.label(), "payload_mass + time_delay");
  EXPECT_FALSE(two.has(named("local_stiffness_loss")));
}

}  // namespace
}  // namespace flexarm::diagnose
