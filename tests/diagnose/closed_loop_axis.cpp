#include "tests/diagnose/closed_loop_axis.hpp"

#include "response/time/random_numbers.hpp"
#include "tests/diagnose/simulated_experiments.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <tuple>
#include <utility>

namespace flexarm::diagnose {

namespace {

constexpr double kUnrecordedTime_s = 0.02;
constexpr double kGain_N_m_per_rad = 300.0;
constexpr double kRateGain_N_m_s_per_rad = 40.0;

/// Three moves of cubic polynomials in 12 s.
double reference_rad(double time_s) {
  const double phase = std::fmod(time_s, 4.0);
  const double there = std::clamp((phase - 0.2) / 0.8, 0.0, 1.0);
  const double back = std::clamp((phase - 2.2) / 1.2, 0.0, 1.0);
  const auto smooth = [](double x) { return x * x * (3.0 - 2.0 * x); };
  return 0.5 * (smooth(there) - smooth(back));
}

}  // namespace

Axis axis_with(std::function<double(double, double)> law_N_m) {
  return {.viscous_N_m_s_per_rad = 0.0,
          .coulomb_N_m = 0.0,
          .bias_N_m = 0.0,
          .unrecorded_N_m = 0.01,
          .unknown_N_m = std::move(law_N_m)};
}

measured::TimeRecord axis_record(const Axis& axis, std::uint64_t seed) {
  constexpr int kSteps = 100;
  constexpr double kStep_s = kAxisPeriod_s / kSteps;
  response::RandomNumbers random(seed);
  measured::TimeRecord record;
  record.channels.push_back({{arm::SensorKind::hub_angle}, {}});
  record.reference.unit = "rad";
  const double kept = std::exp(-kAxisPeriod_s / kUnrecordedTime_s);
  double unrecorded_N_m = 0.0;
  double angle_rad = 0.0;
  double velocity = 0.0;
  double before_rad = 0.0;
  for (int k = 0; k * kAxisPeriod_s < axis.duration_s; ++k) {
    const double time_s = k * kAxisPeriod_s;
    const double reading_rad = std::round(angle_rad / kAxisEncoder_rad) * kAxisEncoder_rad;
    const double rate = (reading_rad - before_rad) / kAxisPeriod_s;
    before_rad = reading_rad;
    const double torque_N_m =
        kGain_N_m_per_rad * (reference_rad(time_s) - reading_rad) - kRateGain_N_m_s_per_rad * rate;
    record.time_s.push_back(time_s);
    record.torque_N_m.push_back(torque_N_m);
    record.reference.values.push_back(reference_rad(time_s));
    record.channels.front().values.push_back(reading_rad);
    unrecorded_N_m = kept * unrecorded_N_m +
                     axis.unrecorded_N_m * std::sqrt(1.0 - kept * kept) * random.normal();
    for (int step = 0; step < kSteps; ++step) {
      const double unknown_N_m = axis.unknown_N_m ? axis.unknown_N_m(angle_rad, velocity) : 0.0;
      const double driving_N_m = torque_N_m + axis.bias_N_m + unrecorded_N_m + unknown_N_m -
                                 axis.viscous_N_m_s_per_rad * velocity;
      if (velocity == 0.0 && std::abs(driving_N_m) <= axis.coulomb_N_m) continue;
      const double direction = velocity != 0.0 ? velocity : driving_N_m;
      const double moved =
          velocity +
          kStep_s * (driving_N_m - std::copysign(axis.coulomb_N_m, direction)) / axis.inertia_kg_m2;
      velocity = velocity * moved < 0.0 ? 0.0 : moved;
      angle_rad += kStep_s * velocity;
    }
  }
  return record;
}

arm::Controller axis_controller() {
  return {.sensors = {{arm::SensorKind::hub_angle}},
          .law = arm::PidController{.kp = kGain_N_m_per_rad,
                                    .kd = kRateGain_N_m_s_per_rad,
                                    .derivative = arm::PidController::Derivative::measurement}};
}

Experiment axis_experiment(const Axis& axis) {
  Experiment made;
  made.arm.hub.inertia_kg_m2 = axis.inertia_kg_m2;
  for (const auto& [id, purpose, seed] :
       {std::tuple{"first", measured::Purpose::estimation, std::uint64_t{3}},
        std::tuple{"second", measured::Purpose::validation, std::uint64_t{4}}}) {
    measured::Run run;
    run.id = id;
    run.kind = measured::RunKind::time;
    run.purpose = purpose;
    made.runs.push_back({run, axis_record(axis, seed)});
  }
  return made;
}

Experiment axis_experiment_with_controller(const Axis& axis) {
  Experiment made = axis_experiment(axis);
  for (auto& [run, data] : made.runs) {
    run.controller = axis_controller();
    run.reference = measured::ColumnMapping{};
  }
  return made;
}

std::vector<Hypothesis> hypotheses_of_an_axis(const Experiment& experiment) {
  return named(experiment, {"actuator_lag", "coulomb_friction", "hub_inertia", "hub_spring",
                            "time_delay", "hub_viscous_friction", "torque_bias", "torque_gain"});
}

void expect_friction_and_bias(const Selection& selection, double within) {
  std::map<std::string, double> found;  // the first parameter of each
  const Candidate& chosen = selection.chosen.fit.candidate;
  for (std::size_t i = 0; i < chosen.effects.size(); ++i) {
    found[chosen.effects[i].effect] = chosen.values_of(i).front();
  }
  ASSERT_THAT(found, testing::UnorderedElementsAre(testing::Key("coulomb_friction"),
                                                   testing::Key("hub_viscous_friction"),
                                                   testing::Key("torque_bias")));
  const Axis axis;
  EXPECT_NEAR(found.at("coulomb_friction"), axis.coulomb_N_m, within * axis.coulomb_N_m);
  EXPECT_NEAR(found.at("hub_viscous_friction"), axis.viscous_N_m_s_per_rad,
              within * axis.viscous_N_m_s_per_rad);
  EXPECT_NEAR(found.at("torque_bias"), axis.bias_N_m, within * axis.bias_N_m);
}

}  // namespace flexarm::diagnose
