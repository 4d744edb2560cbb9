// Simulations of a fit: processor time of one evaluation, six runs of 4000 samples read by four
// sensors, for each kind of force.
#include "benchmarks/simulation_case.hpp"
#include "benchmarks/timing.hpp"
#include "effects/registry/vocabulary.hpp"
#include "response/time/arm_simulator.hpp"
#include "response/time/beam_forces.hpp"

#include <benchmark/benchmark.h>

#include <cmath>
#include <initializer_list>
#include <map>
#include <random>
#include <string>
#include <vector>

namespace flexarm::benchmarks {
namespace {

using response::ArmParts;
using response::ArmSimulator;

constexpr std::size_t kRuns = 6;
constexpr std::size_t kSamples = 4000;
constexpr double kSample_s = 2e-3;
constexpr int kFlexibleModes = 10;

/// Six runs of random steps of torque: each longer and smaller than the one before.
std::vector<std::vector<double>> torques_N_m() {
  std::vector<std::vector<double>> made;
  for (std::size_t run = 1; run <= kRuns; ++run) {
    std::mt19937 random(static_cast<unsigned>(run));
    const double largest = 0.3 / static_cast<double>(run);
    std::uniform_real_distribution<double> torque(-largest, largest);
    auto& samples = made.emplace_back();
    while (samples.size() < kSamples) samples.insert(samples.end(), 20 * run, torque(random));
    samples.resize(kSamples);
  }
  return made;
}

struct FitCase {
  std::string effect = {};
  std::map<std::string, double> numbers = {};
  bool hub_is_driven = false;
  bool starts_at_rest = true;
};

/// The arm with its effect.
struct TimedArm {
  SimulationCase bare = simulation_case(
      kFlexibleModes, response::beam_stations(arm::paper_arm().beam.length_m).stations_m);
  ArmParts parts = response::take_apart(bare.arm);

  explicit TimedArm(const FitCase& which) {
    if (!which.effect.empty()) {
      response::add_effect(parts, effects::effect(which.effect, which.numbers));
    }
    // The command is then the hub's acceleration.
    parts.hub_is_driven = which.hub_is_driven;
  }
  ArmSimulator simulator() const {
    return {bare.model, parts, bare.sensors,
            response::options_of_fit(kSample_s, response::TorqueHold::zero)};
  }
};

void fit_evaluation(benchmark::State& state, const FitCase& which) {
  const TimedArm arm(which);
  const auto commands = torques_N_m();
  for (auto _ : state) {
    const ArmSimulator simulator = arm.simulator();
    Eigen::VectorXd initial;
    if (!which.starts_at_rest) initial = simulator.rigid_states() * Eigen::Vector2d(0.1, 0.5);
    for (const auto& command : commands) {
      benchmark::DoNotOptimize(simulator.readings(command, initial));
    }
  }
}

/// The same by the Kalman filter of the linear arm with a disturbance of the hub torque, for noise
/// of 0.5 %. A run with a missing reading is filtered from sample to sample, others in blocks.
void filter_evaluation(benchmark::State& state, bool misses_reading) {
  TimedArm arm(FitCase{});
  arm.parts.disturbance = response::HubDisturbance{0.1};
  std::vector<std::vector<double>> commands = torques_N_m();
  std::vector<Eigen::MatrixXd> measured;
  std::vector<Eigen::VectorXd> deviations;
  for (const auto& command : commands) {
    Eigen::MatrixXd& readings = measured.emplace_back(arm.simulator().readings(command));
    const double root_of_samples = std::sqrt(static_cast<double>(readings.rows()));
    deviations.push_back(0.005 / root_of_samples * readings.colwise().norm().transpose());
    if (misses_reading) readings(readings.rows() - 1, 0) = std::nan("");
  }
  for (auto _ : state) {
    const ArmSimulator simulator = arm.simulator();
    for (std::size_t r = 0; r < commands.size(); ++r) {
      const response::FilterGains gains{
          {}, response::filter_gain(simulator.sampled({0.01}, deviations[r]))};
      benchmark::DoNotOptimize(simulator.filtered(commands[r], measured[r], gains));
    }
  }
}

/// What is made once for all runs of an evaluation.
void fit_simulator(benchmark::State& state, const FitCase& which) {
  const TimedArm arm(which);
  for (auto _ : state) benchmark::DoNotOptimize(arm.simulator().states());
}

const FitCase kLinear = {};
const FitCase kCoulomb = {"coulomb_friction", {{"torque", 0.012}}};
const FitCase kStribeck = {"stribeck_friction",
                           {{"torque", 0.012}, {"static_torque", 0.016}, {"velocity", 0.2}}};
const FitCase kHysteresis = {"hub_hysteresis", {{"torque", 0.012}, {"stiffness", 0.4}}};
const FitCase kStiffHysteresis = {"hub_hysteresis", {{"torque", 0.012}, {"stiffness", 100.0}}};
const FitCase kRipple = {"torque_ripple", {{"amplitude", 0.01}, {"cycles", 9.0}, {"phase", 0.4}}};
const FitCase kHardening = {"hub_hardening_spring", {{"coefficient", 0.5}}};
const FitCase kDrag = {"quadratic_drag", {{"coefficient", 0.02}}};

FitCase moving(FitCase which) {
  which.starts_at_rest = false;
  return which;
}

FitCase driven(FitCase which) {
  which.hub_is_driven = true;
  return which;
}

void repeated(benchmark::internal::Benchmark* benchmark) {
  benchmark->Repetitions(kRepetitions)->MinTime(kMinimumTime_s)->Unit(benchmark::kMillisecond);
}

BENCHMARK_CAPTURE(fit_evaluation, linear, kLinear)->Apply(repeated);
BENCHMARK_CAPTURE(fit_evaluation, coulomb, kCoulomb)->Apply(repeated);
BENCHMARK_CAPTURE(fit_evaluation, coulomb_moving_first, moving(kCoulomb))->Apply(repeated);
BENCHMARK_CAPTURE(fit_evaluation, stribeck, kStribeck)->Apply(repeated);
BENCHMARK_CAPTURE(fit_evaluation, hysteresis, kHysteresis)->Apply(repeated);
BENCHMARK_CAPTURE(fit_evaluation, stiff_hysteresis, kStiffHysteresis)->Apply(repeated);
BENCHMARK_CAPTURE(fit_evaluation, ripple, kRipple)->Apply(repeated);
BENCHMARK_CAPTURE(fit_evaluation, hardening_spring, kHardening)->Apply(repeated);
BENCHMARK_CAPTURE(fit_evaluation, drag, kDrag)->Apply(repeated);
BENCHMARK_CAPTURE(fit_evaluation, drag_of_driven_hub, driven(kDrag))->Apply(repeated);
BENCHMARK_CAPTURE(filter_evaluation, in_blocks, false)->Apply(repeated);
BENCHMARK_CAPTURE(filter_evaluation, step_by_step, true)->Apply(repeated);
BENCHMARK_CAPTURE(fit_simulator, coulomb, kCoulomb)->Apply(repeated);
BENCHMARK_CAPTURE(fit_simulator, stribeck, kStribeck)->Apply(repeated);
BENCHMARK_CAPTURE(fit_simulator, drag, kDrag)->Apply(repeated);

}  // namespace
}  // namespace flexarm::benchmarks
