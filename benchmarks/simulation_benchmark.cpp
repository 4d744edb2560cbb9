// Time responses: samples a second on one core beside the difference to inner steps ten times
// smaller, for each kind of force.
#include "benchmarks/simulation_case.hpp"
#include "benchmarks/timing.hpp"
#include "effects/registry/vocabulary.hpp"
#include "response/time/beam_forces.hpp"
#include "response/time/simulation.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>

namespace flexarm::benchmarks {
namespace {

using response::ArmParts;
using response::Simulation;

/// Largest difference of two runs over all sensors, each relative to its peak.
double largest_difference(const Simulation& a, const Simulation& b) {
  double worst = 0.0;
  for (std::size_t j = 0; j < a.channels.size(); ++j) {
    double peak = 0.0;
    double difference = 0.0;
    for (std::size_t k = 0; k < a.channels[j].size(); ++k) {
      peak = std::max(peak, std::abs(b.channels[j][k]));
      difference = std::max(difference, std::abs(a.channels[j][k] - b.channels[j][k]));
    }
    worst = std::max(worst, difference / peak);
  }
  return worst;
}

ArmParts linear() {
  return response::take_apart(arm::paper_arm());
}

ArmParts coulomb() {
  ArmParts parts = linear();
  response::add_effect(parts, effects::effect("coulomb_friction", {{"torque", 0.012}}));
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

void simulation(benchmark::State& state, ArmParts parts, bool energy) {
  const auto modes = static_cast<int>(state.range(0));
  const auto timed =
      simulation_case(modes, response::beam_stations(arm::paper_arm().beam.length_m).stations_m);
  parts.linear = timed.arm;
  const auto run = [&](int substeps) {
    return response::simulate(
        timed.model, parts, timed.sensors, timed.torque_N_m,
        {.sample_time_s = timed.sample_time_s, .substeps = substeps, .energy = energy});
  };
  for (auto _ : state) benchmark::DoNotOptimize(run(0));
  const auto made = run(0);
  const auto& summary = made.summary;
  state.counters["samples_per_s"] = {static_cast<double>(timed.torque_N_m.size()),
                                     benchmark::Counter::kIsIterationInvariantRate};
  state.counters["events"] =
      static_cast<double>(summary.stops + summary.breakaways + summary.reversals);
  state.counters["substeps"] = summary.substeps;
  state.counters["difference"] = largest_difference(made, run(10 * summary.substeps));
}

void repeated(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgName("modes")->Arg(10)->Arg(20);
  benchmark->Repetitions(kRepetitions)->MinTime(kMinimumTime_s)->Unit(benchmark::kMillisecond);
}

BENCHMARK_CAPTURE(simulation, linear, linear(), false)->Apply(repeated);
BENCHMARK_CAPTURE(simulation, coulomb, coulomb(), false)->Apply(repeated);
BENCHMARK_CAPTURE(simulation, coulomb_with_energy, coulomb(), true)->Apply(repeated);
BENCHMARK_CAPTURE(simulation, stribeck, stribeck(), false)->Apply(repeated);
BENCHMARK_CAPTURE(simulation, coulomb_and_drag, drag(), false)->Apply(repeated);

}  // namespace
}  // namespace flexarm::benchmarks
