#include "diagnose/search/hypothesis.hpp"
#include "diagnose/search/run_drift.hpp"
#include "diagnose/symptoms/drift_symptoms.hpp"
#include "diagnose/symptoms/root_shifts.hpp"
#include "diagnose/symptoms/run_distortion.hpp"
#include "effects/registry/vocabulary.hpp"
#include "tests/diagnose/symptoms_fixture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace flexarm::diagnose {
namespace {

using testing::Contains;
using testing::HasSubstr;

/// Roots measured to 0.1 %, the simulated ones shifted by a part.
std::vector<RootShift> shifts(double poles, double hub_zeros, double tip_zeros) {
  std::vector<RootShift> made;
  std::mt19937_64 numbers(5);
  std::normal_distribution<double> normal;
  const auto add = [&](const char* sensor, double part) {
    for (int order = 1; order <= 4; ++order) {
      RootShift shift;
      shift.run = "bare";
      if (sensor != nullptr) shift.zero_of = arm::parse_sensor(sensor);
      shift.order = order;
      const double simulated_Hz = 12.0 * order;
      const double measured_Hz = simulated_Hz * (1.0 + part + 1e-3 * normal(numbers));
      shift.frequency_Hz = RootNumber{measured_Hz, 1e-3 * simulated_Hz, simulated_Hz, measured_Hz};
      made.push_back(shift);
    }
  };
  add(nullptr, poles);
  add("hub_angle", hub_zeros);
  add("tip_acceleration", tip_zeros);
  return made;
}

std::vector<std::string> texts(const std::vector<Symptom>& symptoms) {
  std::vector<std::string> made;
  for (const Symptom& one : symptoms) made.push_back(one.text);
  return made;
}

TEST(RootSymptoms, SayOnWhichSideOfTheRootTheCauseIs) {
  EXPECT_THAT(texts(root_symptoms(shifts(-0.03, 0.0, 0.0))),
              Contains(HasSubstr("effects on the hub")));
  EXPECT_THAT(texts(root_symptoms(shifts(-0.03, -0.03, 0.0))),
              Contains(HasSubstr("payload mass, root compliance")));
  EXPECT_THAT(texts(root_symptoms(shifts(-0.03, -0.03, -0.03))),
              Contains(HasSubstr("link properties")));
  EXPECT_THAT(texts(root_symptoms(shifts(0.0, 0.0, 0.0))),
              Contains(HasSubstr("No pole or zero is shifted")));
}

TEST(RootSymptoms, AreInPerCentAndStandardDeviations) {
  const auto told = root_symptoms(shifts(-0.05, 0.0, 0.0));
  ASSERT_EQ(told.size(), 4U);
  EXPECT_TRUE(told[1].is_significant);
  EXPECT_THAT(told[1].text, HasSubstr("1: -5"));
  EXPECT_THAT(told[1].text, HasSubstr("sigma, run bare"));
  EXPECT_FALSE(told[2].is_significant);
  EXPECT_THAT(told[2].text, HasSubstr("frequencies agree with the simulation"));
}

Candidate only(const Experiment& experiment, const std::string& effect, double value) {
  const auto all = hypotheses(experiment);
  return Candidate().with(*std::ranges::find(all, effect, &Hypothesis::effect), {value});
}

TEST(RunDrift, OfAParameterThatIsTheSameInAllRunsIsNone) {
  const Symptomatic data(simulated_experiment({effects::named("hub_inertia", {{"factor", 1.2}})}));
  const auto drift =
      run_drift(data.problem(), only(data.problem().experiment(), "hub_inertia", 1.21), 0);
  ASSERT_TRUE(drift);
  EXPECT_EQ(drift->values.size(), data.problem().experiment().runs.size());
  EXPECT_NEAR(drift->mean, 1.2, 0.01);
  EXPECT_FALSE(drift_symptoms(*drift).front().is_significant);
  for (const RunValue& value : drift->values) EXPECT_GT(value.std_error, 0.0);
}

TEST(RunDrift, OfAParameterThatChangesIsTold) {
  Experiment experiment = simulated_experiment({effects::named("hub_inertia", {{"factor", 1.2}})});
  const Experiment other = simulated_experiment({effects::named("hub_inertia", {{"factor", 1.4}})});
  experiment.runs[1] = other.runs[1];
  const Symptomatic data(std::move(experiment));
  const auto drift =
      run_drift(data.problem(), only(data.problem().experiment(), "hub_inertia", 1.2), 0);
  ASSERT_TRUE(drift);
  const Symptom told = drift_symptoms(*drift).front();
  EXPECT_TRUE(told.is_significant);
  EXPECT_THAT(told.text, HasSubstr("estimates inconsistent between runs"));
  EXPECT_NEAR(drift->values[0].value, 1.2, 0.01);
  EXPECT_NEAR(drift->values[1].value, 1.4, 0.01);
}

TEST(RunDrift, IsOfTheSizeOfTheEffect) {
  Experiment experiment = simulated_experiment({effects::named("hub_inertia", {{"factor", 0.9}})});
  const Experiment other =
      simulated_experiment({effects::named("hub_inertia", {{"factor", 0.91}})});
  experiment.runs[1] = other.runs[1];
  const Symptomatic data(std::move(experiment));
  const auto drift =
      run_drift(data.problem(), only(data.problem().experiment(), "hub_inertia", 0.9), 0);
  ASSERT_TRUE(drift);
  EXPECT_NEAR(drift->size, 0.1, 0.01);
  EXPECT_TRUE(drift_symptoms(*drift).front().is_significant);
}

double largest_torque_N_m(const Experiment& experiment, std::size_t run) {
  const auto& torque = std::get<measured::TimeRecord>(experiment.runs[run].data).torque_N_m;
  return std::abs(*std::ranges::max_element(torque, {}, [](double one) { return std::abs(one); }));
}

TEST(RunDrift, IsOfRunsThatShowTheParameter) {
  const Experiment whole = simulated_experiment({});
  std::vector<double> largest_N_m;
  for (std::size_t r = 0; r < whole.runs.size(); ++r) {
    largest_N_m.push_back(largest_torque_N_m(whole, r));
  }
  const double limit_N_m = 0.35 * *std::ranges::max_element(largest_N_m);
  const auto clipped = static_cast<std::size_t>(
      std::ranges::count_if(largest_N_m, [&](double most) { return most > limit_N_m; }));
  ASSERT_GE(clipped, 2U);
  ASSERT_LT(clipped, whole.runs.size());
  const Symptomatic data(
      simulated_experiment({effects::named("torque_saturation", {{"limit", limit_N_m}})}));
  const auto drift = run_drift(
      data.problem(), only(data.problem().experiment(), "torque_saturation", limit_N_m), 0);
  ASSERT_TRUE(drift);
  EXPECT_EQ(drift->values.size(), clipped);
  for (const RunValue& value : drift->values) EXPECT_LT(value.std_error, 0.1 * limit_N_m);
}

/// Periods of an odd multisine with free lines, read by a sensor that distorts it by a cubic part.
Experiment multisine_experiment(double cubic) {
  constexpr std::size_t kPeriodSamples = 500;
  constexpr std::size_t kPeriods = 6;
  constexpr double kPeriod_s = 2e-3;
  Experiment experiment;
  experiment.arm = trial_arm();
  measured::TimeRecord record;
  std::mt19937_64 numbers(9);
  std::normal_distribution<double> normal;
  std::vector<double> reading;
  for (std::size_t k = 0; k < kPeriods * kPeriodSamples; ++k) {
    const double time_s = kPeriod_s * static_cast<double>(k);
    double torque = 0.0;
    for (const int line : {1, 3, 7, 9, 13, 15, 19, 21, 25, 27}) {
      torque +=
          0.01 * std::cos(2.0 * std::numbers::pi * line * static_cast<double>(k) / kPeriodSamples +
                          line * line);
    }
    record.time_s.push_back(time_s);
    record.torque_N_m.push_back(torque);
    reading.push_back(torque + cubic * std::pow(torque, 3) + 1e-4 * normal(numbers));
  }
  record.channels.push_back({arm::parse_sensor("strain@0.05"), std::move(reading)});
  measured::MeasuredRun run;
  run.run.id = "multisine";
  run.data = std::move(record);
  experiment.runs.push_back(std::move(run));
  return experiment;
}

TEST(DistortionSymptoms, TellOddDistortionFromNone) {
  const auto distorted = run_distortions(multisine_experiment(40.0));
  ASSERT_EQ(distorted.size(), 1U);
  const Symptom told = distortion_symptoms(distorted).front();
  EXPECT_TRUE(told.is_significant);
  EXPECT_THAT(told.text, HasSubstr("odd distortion"));
  EXPECT_THAT(told.text, HasSubstr("no even distortion"));
  const auto clean = run_distortions(multisine_experiment(0.0));
  ASSERT_EQ(clean.size(), 1U);
  EXPECT_FALSE(distortion_symptoms(clean).front().is_significant);
}

TEST(DistortionSymptoms, AreNoneOfARandomTorque) {
  EXPECT_TRUE(run_distortions(simulated_experiment({}, {.duration_s = 1.0})).empty());
}

TEST(Symptom, CarriesItsTests) {
  const Symptom one = symptom(SymptomKind::drift, "", 1e-5, 10);
  EXPECT_DOUBLE_EQ(one.probability, 1e-4);
  EXPECT_TRUE(one.is_significant);
  EXPECT_NEAR(one.deviate, 3.8906, 1e-4);  // of 1e-4 to both sides
  EXPECT_FALSE(symptom(SymptomKind::drift, "", 1e-5, 1000).is_significant);
  EXPECT_LE(symptom(SymptomKind::drift, "", 0.0, 3).deviate, kMostDeviate);
}

TEST(Percent, IsAsOneSaysIt) {
  EXPECT_EQ(percent(5.034), "503 %");
  EXPECT_EQ(percent(1.0), "100 %");
  EXPECT_EQ(percent(0.0043), "0.43 %");
  EXPECT_EQ(percent(4e-7), "< 0.1 %");
}

}  // namespace
}  // namespace flexarm::diagnose
