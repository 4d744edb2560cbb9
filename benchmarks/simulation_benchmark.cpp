// Time responses: samples a second on one core beside the difference to inner steps ten times
// smaller, for each kind of force.
#include "benchmarks/comparison/friction_case.hpp"
#include "benchmarks/simulation_case.hpp"
#include "benchmarks/timing.hpp"
#include "effects/registry/vocabulary.hpp"
#include "response/time/arm_simulator.hpp"
#include "response/time/beam_forces.hpp"
#include "response/time/simulation.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace flexarm::benchmarks {
namespace {

using response::ArmParts;
using response::Simulation;

using Channels = std::vector<std::vector<double>>;

/// Largest difference of two runs over all sensors, each relative to its peak.
double largest_difference(const Channels& a, const Channels& b) {
  double worst = 0.0;
  for (std::size_t j = 0; j < a.size(); ++j) {
    worst = std::max(worst, relative_difference(a[j], b[j]));
  }
  return worst;
}

ArmParts linear() {
  return response::take_apart(arm::paper_arm());
}

ArmParts coulomb() {
  ArmParts parts = linear();
  response::add_effect(parts,
                       effects::effect("coulomb_friction", {{"torque", kCoulombTorque_N_m}}));
  return parts;
}

ArmParts stribeck() {
  ArmParts parts = linear();
  response::add_effect(
      parts, effects::effect("stribeck_friction",
                             {{"torque", 0.012}, {"static_torque", 0.016}, {"velocity", 0.2}}));
  return parts;
}

ArmParts drag() {
  ArmParts parts = coulomb();
  response::add_effect(parts, effects::effect("quadratic_drag", {{"coefficient", 0.02}}));
  return parts;
}

Simulation run_of(const SimulationCase& timed, const ArmParts& parts, int substeps, bool energy) {
  return response::simulate(
      timed.model, parts, timed.sensors, timed.torque_N_m,
      {.sample_time_s = timed.sample_time_s, .substeps = substeps, .energy = energy});
}

/// `name` is that of the benchmark: the difference takes ten times the simulation and is formed
/// once, not for each repetition.
void simulation(benchmark::State& state, const std::string& name, ArmParts parts, bool energy) {
  const auto modes = static_cast<int>(state.range(0));
  const auto timed =
      simulation_case(modes, response::beam_stations(arm::paper_arm().beam.length_m).stations_m);
  parts.linear = timed.arm;
  const auto run = [&](int substeps) { return run_of(timed, parts, substeps, energy); };
  for (auto _ : state) benchmark::DoNotOptimize(run(0));
  const auto made = run(0);
  const auto& summary = made.summary;
  state.counters["samples_per_s"] = {static_cast<double>(timed.torque_N_m.size()),
                                     benchmark::Counter::kIsIterationInvariantRate};
  state.counters["events"] =
      static_cast<double>(summary.stops + summary.breakaways + summary.reversals);
  state.counters["substeps"] = summary.substeps;
  static std::map<std::pair<std::string, int>, double> known;
  const auto key = std::pair(name, modes);
  if (!known.contains(key)) {
    known[key] =
        largest_difference(made.channels, run(kReferenceSubsteps * summary.substeps).channels);
  }
  state.counters["difference"] = known[key];
}

/// Other tools take too long for all samples: the first second, with Coulomb friction.
void second_with_friction(benchmark::State& state) {
  const auto friction = friction_case(static_cast<int>(state.range(0)));
  const auto run = [&](int substeps) {
    return run_of(friction.timed, friction.parts, substeps, false);
  };
  for (auto _ : state) benchmark::DoNotOptimize(run(0));
  const auto made = run(0);
  state.counters["stick_time_s"] = made.summary.stick_time_s;
  state.counters["difference"] =
      largest_difference(made.channels, run(kReferenceSubsteps * made.summary.substeps).channels);
}

/// The same work as a fit does it, which needs readings alone and takes samples in blocks; the
/// simulator is part of the time. Difference to a simulation with smaller steps.
void readings_of_fit(benchmark::State& state, ArmParts parts, std::size_t samples) {
  const auto timed = simulation_case(static_cast<int>(state.range(0)), {}, samples);
  parts.linear = timed.arm;
  const auto run = [&]() -> Eigen::MatrixXd {
    const response::ArmSimulator simulator(
        timed.model, parts, timed.sensors,
        response::options_of_fit(timed.sample_time_s, response::TorqueHold::zero));
    return simulator.readings(timed.torque_N_m);
  };
  for (auto _ : state) benchmark::DoNotOptimize(run());
  const Eigen::MatrixXd made = run();
  Channels channels;
  for (const auto column : made.colwise()) channels.emplace_back(column.begin(), column.end());
  state.counters["difference"] =
      largest_difference(channels, run_of(timed, parts, kReferenceSubsteps, false).channels);
}

/// How the time grows with the number of modes and of samples.
void growth(benchmark::State& state, ArmParts parts, int modes, int samples) {
  const auto timed = simulation_case(modes, {}, static_cast<std::size_t>(samples));
  parts.linear = timed.arm;
  for (auto _ : state) benchmark::DoNotOptimize(run_of(timed, parts, 0, false));
  state.SetComplexityN(state.range(0));
}

constexpr int kUsualModes = 10;
constexpr int kUsualSamples = 100'000;

void growth_with_modes(benchmark::State& state, ArmParts parts) {
  growth(state, std::move(parts), static_cast<int>(state.range(0)), kUsualSamples);
}

void growth_with_samples(benchmark::State& state, ArmParts parts) {
  growth(state, std::move(parts), kUsualModes, static_cast<int>(state.range(0)));
}

void repeated(benchmark::internal::Benchmark* benchmark) {
  benchmark->Repetitions(kRepetitions)->MinTime(kMinimumTime_s)->Unit(benchmark::kMillisecond);
}

void by_modes(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgName("modes")->Arg(5)->Arg(10)->Arg(20)->Arg(40)->Arg(80);
  repeated(benchmark);
}

void by_samples(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgName("samples")->Arg(10'000)->Arg(100'000)->Arg(1'000'000);
  repeated(benchmark);
}

void two_sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgName("modes")->Arg(10)->Arg(20);
  repeated(benchmark);
}

BENCHMARK_CAPTURE(simulation, linear, "linear", linear(), false)->Apply(two_sizes);
BENCHMARK_CAPTURE(simulation, coulomb, "coulomb", coulomb(), false)->Apply(two_sizes);
BENCHMARK_CAPTURE(simulation, coulomb_with_energy, "coulomb_with_energy", coulomb(), true)
    ->Apply(two_sizes);
BENCHMARK_CAPTURE(simulation, stribeck, "stribeck", stribeck(), false)->Apply(two_sizes);
BENCHMARK_CAPTURE(simulation, coulomb_and_drag, "coulomb_and_drag", drag(), false)
    ->Apply(two_sizes);
BENCHMARK(second_with_friction)->ArgName("modes")->Arg(kUsualModes)->Apply(repeated);
BENCHMARK_CAPTURE(readings_of_fit, linear, linear(), kUsualSamples)
    ->ArgName("modes")
    ->Arg(kUsualModes)
    ->Apply(repeated);
BENCHMARK_CAPTURE(readings_of_fit, coulomb, coulomb(), kFrictionSamples)
    ->ArgName("modes")
    ->Arg(kUsualModes)
    ->Apply(repeated);
BENCHMARK_CAPTURE(growth_with_modes, linear, linear())->Apply(by_modes);
BENCHMARK_CAPTURE(growth_with_modes, coulomb, coulomb())->Apply(by_modes);
BENCHMARK_CAPTURE(growth_with_samples, linear, linear())->Apply(by_samples);
BENCHMARK_CAPTURE(growth_with_samples, coulomb, coulomb())->Apply(by_samples);

}  // namespace
}  // namespace flexarm::benchmarks
