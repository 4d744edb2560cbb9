#include "tests/diagnose/simulated_experiments.hpp"

#include "diagnose/search/hypothesis.hpp"
#include "response/excitation/excitation.hpp"
#include "response/formulation_maker.hpp"
#include "response/time/random_numbers.hpp"
#include "response/time/sensor_imperfections.hpp"
#include "response/time/simulation.hpp"
#include "response/time/time_model.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace flexarm::diagnose {

namespace {

constexpr int kSimulatedModes = 16;
constexpr double kSampleTime_s = 2e-3;
/// Of random numbers, beside those of the sensors.
constexpr std::uint32_t kActingStream = 1000;

struct RunToSimulate {
  std::string id;
  response::Excitation torque;
  double payload_kg = 0.0;
  measured::Purpose purpose = measured::Purpose::estimation;
};

std::vector<RunToSimulate> planned_runs(std::uint64_t seed) {
  using response::RandomNoise;
  const auto random = [seed](double rms_N_m, std::uint64_t more) {
    return RandomNoise{.rms_N_m = rms_N_m, .from_Hz = 0.3, .to_Hz = 60.0, .seed = seed + more};
  };
  return {{"random-low", random(0.03, 11), 0.0, measured::Purpose::estimation},
          {"random-high", random(0.12, 12), 0.0, measured::Purpose::estimation},
          {"payload", random(0.06, 13), 0.06, measured::Purpose::estimation},
          {"multisine",
           response::Multisine{.rms_N_m = 0.06, .from_Hz = 0.3, .to_Hz = 60.0, .seed = seed + 14},
           0.0, measured::Purpose::validation}};
}

measured::TimeRecord record_of(const RunToSimulate& plan, const arm::Arm& arm,
                               const SimulatedRuns& runs) {
  std::vector<arm::Sensor> sensors;
  for (const char* name : {"hub_angle", "hub_velocity", "tip_acceleration", "strain@0.05"}) {
    sensors.push_back(arm::parse_sensor(name));
  }
  const response::SampleGrid grid{
      static_cast<std::size_t>(std::lround(runs.duration_s / kSampleTime_s)), kSampleTime_s};
  auto torque = response::sample(plan.torque, grid).torque_N_m;
  response::RandomNumbers acting(runs.seed + std::hash<std::string>{}(plan.id), kActingStream);
  response::impair(torque, {.relative_noise = runs.acting_noise}, acting);
  const response::ArmParts parts = response::take_apart(arm);
  const auto model =
      response::time_model(response::make_formulation("fem", parts.linear, kSimulatedModes), parts,
                           kSimulatedModes, sensors);
  auto made = response::simulate(model, parts, sensors, torque,
                                 {.sample_time_s = kSampleTime_s, .energy = false});
  measured::TimeRecord record{made.time_s, torque, {}};
  for (std::size_t j = 0; j < sensors.size(); ++j) {
    response::RandomNumbers numbers(runs.seed + std::hash<std::string>{}(plan.id),
                                    static_cast<std::uint32_t>(j));
    response::impair(made.channels[j], {.relative_noise = runs.relative_noise}, numbers);
    record.channels.push_back({sensors[j], std::move(made.channels[j])});
  }
  return record;
}

}  // namespace

arm::Arm trial_arm() {
  arm::Arm arm = arm::paper_arm();
  arm.beam.shear_modulus_Pa = 2.67e10;
  arm.damping.kelvin_voigt_s = 1.2e-4;
  arm.hub.viscous_friction_N_m_s_per_rad = 2e-3;
  return arm;
}

Experiment simulated_experiment(const arm::Effects& hidden, const SimulatedRuns& runs) {
  Experiment experiment;
  experiment.arm = trial_arm();
  for (const RunToSimulate& plan : planned_runs(runs.seed)) {
    measured::MeasuredRun made;
    made.run.id = plan.id;
    made.run.purpose = plan.purpose;
    made.run.payload = arm::Payload{plan.payload_kg, 0.0};
    arm::Arm arm = arm_in(experiment, made.run);
    arm.effects = hidden;
    made.data = record_of(plan, arm, runs);
    experiment.runs.push_back(std::move(made));
  }
  return experiment;
}

std::vector<Hypothesis> named(const Experiment& experiment, const std::vector<std::string>& names) {
  auto all = hypotheses(experiment);
  std::erase_if(all, [&](const Hypothesis& hypothesis) {
    return std::ranges::find(names, hypothesis.effect) == names.end();
  });
  return all;
}

}  // namespace flexarm::diagnose
