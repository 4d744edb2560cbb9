// Torque balance at the hub: what is missing of the torque for the motion that was measured.
#include "diagnose/predictors/noise_estimate.hpp"
#include "diagnose/search/admission.hpp"
#include "diagnose/search/fit.hpp"
#include "diagnose/search/predictor_choice.hpp"
#include "effects/registry/vocabulary.hpp"
#include "response/time/random_numbers.hpp"
#include "tests/diagnose/simulated_experiments.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace flexarm::diagnose {
namespace {

/// A rigid axis of an inertia that its file has right, with friction and a bias that it lacks.
constexpr double kInertia_kg_m2 = 2.0;
constexpr double kViscous_N_m_s_per_rad = 4.0;
constexpr double kCoulomb_N_m = 0.5;
constexpr double kBias_N_m = 0.2;
/// Of a torque that acts and nobody recorded; the controller's is about 1.5 N m.
constexpr double kUnrecorded_N_m = 0.1;
constexpr double kUnrecordedTime_s = 0.02;
constexpr double kPeriod_s = 0.002;
constexpr double kDuration_s = 12.0;
constexpr double kEncoder_rad = 2e-5;

/// Of the reference: three moves of cubic polynomials.
double reference_rad(double time_s) {
  const double phase = std::fmod(time_s, 4.0);
  const double there = std::clamp((phase - 0.2) / 0.8, 0.0, 1.0);
  const double back = std::clamp((phase - 2.2) / 1.2, 0.0, 1.0);
  const auto smooth = [](double x) { return x * x * (3.0 - 2.0 * x); };
  return 0.5 * (smooth(there) - smooth(back));
}

/// The axis in a closed loop, by explicit steps of 20 microseconds: a sampled PD controller, the
/// encoder's counts, and dry friction that holds where the rest of the torque is below it.
measured::TimeRecord closed_loop_record(std::uint64_t seed) {
  constexpr int kSteps = 100;
  constexpr double kStep_s = kPeriod_s / kSteps;
  response::RandomNumbers random(seed);
  measured::TimeRecord record;
  record.channels.push_back({{arm::SensorKind::hub_angle}, {}});
  const double kept = std::exp(-kPeriod_s / kUnrecordedTime_s);
  double unrecorded_N_m = 0.0;
  double angle_rad = 0.0;
  double velocity = 0.0;
  double before_rad = 0.0;
  for (int k = 0; k * kPeriod_s < kDuration_s; ++k) {
    const double time_s = k * kPeriod_s;
    const double reading_rad = std::round(angle_rad / kEncoder_rad) * kEncoder_rad;
    const double rate = (reading_rad - before_rad) / kPeriod_s;
    before_rad = reading_rad;
    const double torque_N_m = 300.0 * (reference_rad(time_s) - reading_rad) - 40.0 * rate;
    record.time_s.push_back(time_s);
    record.torque_N_m.push_back(torque_N_m);
    record.channels.front().values.push_back(reading_rad);
    unrecorded_N_m =
        kept * unrecorded_N_m + kUnrecorded_N_m * std::sqrt(1.0 - kept * kept) * random.normal();
    for (int step = 0; step < kSteps; ++step) {
      const double driving_N_m =
          torque_N_m + kBias_N_m + unrecorded_N_m - kViscous_N_m_s_per_rad * velocity;
      if (velocity == 0.0 && std::abs(driving_N_m) <= kCoulomb_N_m) continue;
      const double direction = velocity != 0.0 ? velocity : driving_N_m;
      const double moved =
          velocity +
          kStep_s * (driving_N_m - std::copysign(kCoulomb_N_m, direction)) / kInertia_kg_m2;
      velocity = velocity * moved < 0.0 ? 0.0 : moved;
      angle_rad += kStep_s * velocity;
    }
  }
  return record;
}

Experiment closed_loop_experiment() {
  Experiment made;
  made.arm.hub.inertia_kg_m2 = kInertia_kg_m2;
  for (const auto& [id, purpose, seed] :
       {std::tuple{"first", measured::Purpose::estimation, std::uint64_t{3}},
        std::tuple{"second", measured::Purpose::validation, std::uint64_t{4}}}) {
    measured::Run run;
    run.id = id;
    run.kind = measured::RunKind::time;
    run.purpose = purpose;
    made.runs.push_back({run, closed_loop_record(seed)});
  }
  return made;
}

const std::vector<std::string> kEffectsOfAnAxis = {
    "actuator_lag", "coulomb_friction",     "hub_inertia", "hub_spring",
    "time_delay",   "hub_viscous_friction", "torque_bias", "torque_gain"};

/// What a selection named, with the first parameter of each.
std::map<std::string, double> named_by(const Selection& selection) {
  std::map<std::string, double> values;
  const Candidate& chosen = selection.chosen.fit.candidate;
  for (std::size_t i = 0; i < chosen.effects.size(); ++i) {
    values[chosen.effects[i].effect] = chosen.values_of(i).front();
  }
  return values;
}

TEST(TorqueBalance, EstimatesTheFrictionThatTheArmLacks) {
  constexpr double kFriction_N_m = 0.02;
  const Experiment experiment =
      simulated_experiment({effects::named("coulomb_friction", {{"torque", kFriction_N_m}})});
  const Problem problem(experiment);
  const NoiseEstimator estimator(experiment, problem.observations(), problem.predictor());
  const auto& runs = problem.estimation_runs();
  const NoiseModel noise = estimator.model(experiment.arm, runs).model;
  // The friction has that size wherever the hub turns. The filter's estimate is a projection: its
  // mean square is below that of the truth by the variance of its error.
  const double estimate_N_m =
      estimated_disturbance_N_m(problem.predictor(), experiment.arm, runs, noise);
  EXPECT_LT(estimate_N_m, kFriction_N_m);
  EXPECT_GT(estimate_N_m, 0.75 * kFriction_N_m);
}

TEST(TorqueBalance, NamesFrictionAndBiasOfAClosedLoop) {
  const Experiment experiment = closed_loop_experiment();
  const auto made =
      select_by_evidence(experiment, named(experiment, kEffectsOfAnAxis), {}, {});
  EXPECT_EQ(made.predictor, PredictorKind::torque_balance);
  const auto found = named_by(made.selection);
  ASSERT_THAT(found, testing::UnorderedElementsAre(testing::Key("coulomb_friction"),
                                                   testing::Key("hub_viscous_friction"),
                                                   testing::Key("torque_bias")));
  // As published figures of such an axis are met (docs/diagnosis.md).
  constexpr double kWithin = 0.05;
  EXPECT_NEAR(found.at("coulomb_friction"), kCoulomb_N_m, kWithin * kCoulomb_N_m);
  EXPECT_NEAR(found.at("hub_viscous_friction"), kViscous_N_m_s_per_rad,
              kWithin * kViscous_N_m_s_per_rad);
  EXPECT_NEAR(found.at("torque_bias"), kBias_N_m, kWithin * kBias_N_m);
}

TEST(TorqueBalance, ASimulationThatRunsAwayNamesNothing) {
  const Experiment experiment = closed_loop_experiment();
  const Problem simulated(experiment);
  const Explanation left = explain(simulated, fit(simulated, simulated.as_filed()));
  EXPECT_TRUE(runs_away(left, {}));
  const Problem balanced(experiment, {.noise = NoiseModel{1.0, 0.1, {}, 1.0}});
  EXPECT_FALSE(runs_away(explain(balanced, fit(balanced, balanced.as_filed())), {}));
}

}  // namespace
}  // namespace flexarm::diagnose
