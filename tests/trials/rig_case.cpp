#include "tests/trials/rig_case.hpp"

#include "measured/files/arm_file.hpp"
#include "measured/files/time_record.hpp"
#include "tests/trials/dirt.hpp"
#include "tests/trials/excitations.hpp"
#include "tests/trials/noisy_record.hpp"
#include "tests/trials/time_simulation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace flexarm::trials {

namespace {

namespace fs = std::filesystem;

constexpr std::array kAlways = {"hub_viscous_friction", "coulomb_friction", "hub_inertia",
                                "flexural_rigidity"};
constexpr std::array kSometimes = {"structural_damping", "torque_gain",     "torque_bias",
                                   "actuator_lag",       "root_compliance", "sensor_delay",
                                   "sensor_gain"};
constexpr std::size_t kMostOthers = 4;

/// Factors of a laboratory.
struct FactorRange {
  std::string_view cause;
  double least;
  double most;
};
constexpr FactorRange kFactors[] = {{"hub_inertia", 0.7, 1.4},
                                    {"flexural_rigidity", 0.85, 1.15},
                                    {"torque_gain", 0.7, 1.4},
                                    {"sensor_gain", 0.7, 1.4}};

/// The largest size of a cause in a laboratory, as Cause::largest.
struct LargestSize {
  std::string_view cause;
  double size;
};
constexpr LargestSize kLargest[] = {
    {"coulomb_friction", 0.5}, {"structural_damping", 0.015},  // damping ratios of about 0.1
    {"torque_bias", 0.3},      {"actuator_lag", 0.02},
    {"root_compliance", 0.3},  {"sensor_delay", 0.06}};

/// The cause with the largest size that it has in a laboratory.
Cause in_laboratory(Cause cause, double sign) {
  for (const auto& [name, least, most] : kFactors) {
    if (cause.name == name) cause.largest = sign > 0.0 ? std::log(most) : -std::log(least);
  }
  for (const auto& [name, size] : kLargest) {
    if (cause.name == name) cause.largest = size;
  }
  return cause;
}

/// A number between two positive ones, each ratio as likely.
double between_ratios(double lowest, double highest, Random& random) {
  return std::exp(random.uniform(std::log(lowest), std::log(highest)));
}

std::vector<arm::Sensor> draw_sensors(Random& random) {
  const std::array hub = {arm::SensorKind::hub_angle, arm::SensorKind::hub_velocity};
  const std::array<arm::Sensor, 3> beam = {
      {{arm::SensorKind::tip_acceleration, 0.0}, {arm::SensorKind::tip_deflection, 0.0}, kGauge}};
  const arm::Sensor of_hub{hub.at(random.below(hub.size())), 0.0};
  return {of_hub, beam.at(random.below(beam.size()))};
}

/// The sensor that a cause acts on, if it acts on one. A hub angle moves too slowly for a delay to
/// show.
std::string draw_sensor_of(const std::string& cause, const std::vector<arm::Sensor>& sensors,
                           Random& random) {
  const std::size_t drawn = random.below(sensors.size());
  const bool is_slow = sensors[drawn].kind == arm::SensorKind::hub_angle;
  const bool shows = !(is_slow && cause == "sensor_delay");
  return arm::to_string(shows ? sensors[drawn] : sensors.back());
}

std::vector<PlannedRun> rig_runs(const TrialArm& of, Random& random) {
  const double low = of.low_torque_N_m;
  return {{"random-high", measured::Purpose::estimation, 0.0, random_torque(6.0 * low, random)},
          {"bang-bang", measured::Purpose::estimation, 0.0, bang_bang_torque(2.0 * low)},
          {"multisine", measured::Purpose::validation, 0.0, multisine_torque(6.0 * low, random)}};
}

/// The encoder of runs whose hub angles range so far; 0 where none is read.
double draw_counts_per_turn(const std::vector<SimulatedRun>& runs,
                            const std::vector<arm::Sensor>& sensors, Random& random) {
  if (sensors.front().kind != arm::SensorKind::hub_angle) return 0.0;
  double lowest = kEncoderLeast;
  for (const SimulatedRun& run : runs) {
    const auto [least, most] = std::ranges::minmax(run.channels.front());
    lowest = std::max(lowest, kEncoderSignal_counts * 2.0 * std::numbers::pi / (most - least));
  }
  if (lowest > kEncoderMost) {
    throw std::runtime_error("the hub turns by less than 50 counts of the finest encoder");
  }
  return std::round(between_ratios(std::ceil(lowest), kEncoderMost, random));
}

/// Hub angles in whole counts.
void put_in_counts(measured::TimeRecord& record, double counts_per_turn) {
  const double count_rad = 2.0 * std::numbers::pi / counts_per_turn;
  for (measured::Channel& channel : record.channels) {
    if (is_analogue(channel)) continue;
    for (double& value : channel.values) value = count_rad * std::round(value / count_rad);
  }
}

/// NRMSE of the true readings against what is recorded of them, the mean of the channels.
double floor_of(const measured::TimeRecord& record, const SimulatedRun& truth) {
  double sum = 0.0;
  for (std::size_t i = 0; i < record.channels.size(); ++i) {
    const std::vector<double>& values = record.channels[i].values;
    double squares = 0.0;
    for (std::size_t k = 0; k < values.size(); ++k) {
      squares += std::pow(values[k] - truth.channels[i][k], 2);
    }
    sum += std::sqrt(squares / static_cast<double>(values.size())) / deviation(values);
  }
  return sum / static_cast<double>(record.channels.size());
}

}  // namespace

std::vector<std::string> draw_rig_causes(Random& random) {
  std::vector<std::string> names(kAlways.begin(), kAlways.end());
  std::vector<std::string> others(kSometimes.begin(), kSometimes.end());
  for (std::size_t left = 1 + random.below(kMostOthers); left > 0; --left) {
    const auto at = others.begin() + static_cast<std::ptrdiff_t>(random.below(others.size()));
    names.push_back(*at);
    others.erase(at);
  }
  return names;
}

RigDraw draw_rig(const TrialKey& key) {
  Random random(key.seed, key.name());
  const std::size_t drawn = random.below(trial_arms().size());
  const TrialArm& of = key.arm.empty() ? trial_arms()[drawn] : find_trial_arm(key.arm);
  RigDraw made{of, draw_sensors(random), rig_runs(of, random), World{of.arm}, {}, {}};
  const double most = key.size.value_or(kRigErrorMost);
  for (const std::string& name : key.hidden) {
    Chance chance = draw_chance(random);
    chance.sensor = draw_sensor_of(name, made.sensors, random);
    const Cause cause = in_laboratory(find_cause(name), chance.sign);
    const double error = between_ratios(kRigErrorLeast, most, random);
    const FoundSize found =
        find_size(of, measured::RunKind::time, made.runs, cause, chance, error, made.sensors);
    made.world = with_hidden(made.world, of, cause, found.size, chance);
    made.sizes.push_back(found.size);
    made.errors.push_back(found.error);
  }
  return made;
}

Truth write_rig_case(const TrialKey& key, const fs::path& folder) {
  const RigDraw made = draw_rig(key);
  Random random(key.seed, key.name() + " record");
  std::vector<SimulatedRun> simulated;
  for (const PlannedRun& run : made.runs) {
    simulated.push_back(
        simulate_run(made.world, made.sensors, run.torque_N_m, {.sample_time_s = kSampleTime_s}));
  }

  RigTruth rig;
  rig.counts_per_turn = draw_counts_per_turn(simulated, made.sensors, random);
  const std::vector<double> costs =
      errors_without_each(made.of, made.runs, made.world, made.sensors);
  for (std::size_t i = 0; i < costs.size(); ++i) rig.costs[key.hidden[i]] = costs[i];

  fs::create_directories(folder);
  measured::write_arm_file(made.of.arm, folder / "arm.toml");
  measured::Measurement measurement{.name = "trial", .arm = "arm.toml", .runs = {}};
  for (std::size_t r = 0; r < made.runs.size(); ++r) {
    const PlannedRun& run = made.runs[r];
    measured::TimeRecord record = noisy_record(simulated[r], made.sensors, key.noise, random);
    if (rig.counts_per_turn > 0.0) put_in_counts(record, rig.counts_per_turn);
    if (run.purpose == measured::Purpose::validation) {
      rig.validation_floor = floor_of(record, simulated[r]);
    }
    measurement.runs.push_back({.id = run.id,
                                .kind = key.kind,
                                .file = run.id + ".csv",
                                .purpose = run.purpose,
                                .payload = arm::Payload{run.payload_kg, 0.0}});
    measured::write_time_record(record, folder / measurement.runs.back().file);
  }
  measured::write_measurement(measurement, folder / "measurement.toml");
  return {key, made.of.arm.name, made.world, made.sizes, made.errors, rig};
}

}  // namespace flexarm::trials
