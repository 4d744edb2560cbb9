// Assumed modes: cost beside error for each basis, with and without a payload.
#include "assumed_modes/assumed_modes_arm.hpp"
#include "benchmarks/timing.hpp"

#include <benchmark/benchmark.h>

namespace flexarm::benchmarks {
namespace {

using assumed_modes::AssumedModesArm;
using assumed_modes::Basis;

/// The paper's arm with a payload of 0.3 of the beam's mass.
arm::Arm loaded_arm() {
  arm::Arm arm = arm::paper_arm();
  arm.payload.mass_kg = 0.3 * arm.beam.linear_density_kg_per_m() * arm.beam.length_m;
  return arm;
}

AssumedModesArm model_of(const benchmark::State& state, Basis basis, const arm::Arm& arm) {
  return AssumedModesArm(arm, {.basis = basis, .functions = static_cast<int>(state.range(0))});
}

void poles_and_hub_zeros(benchmark::State& state, Basis basis, const arm::Arm& arm) {
  score_poles_and_hub_zeros(state, [&] { return model_of(state, basis, arm); });
}

/// Construction and ten poles with the default options.
void ten_poles(benchmark::State& state) {
  const auto make = [] { return AssumedModesArm(arm::paper_arm()); };
  for (auto _ : state) benchmark::DoNotOptimize(make().poles(kPoles));
  state.counters["error"] = error_of_poles(make());
}

void tip_zeros(benchmark::State& state, Basis basis, const arm::Arm& arm) {
  score_tip_zeros(
      state, [&] { return model_of(state, basis, arm); }, kTipZeros);
}

/// How the error grows from zero to zero with the default options.
void more_tip_zeros(benchmark::State& state) {
  score_tip_zeros(
      state, [] { return AssumedModesArm(arm::paper_arm()); }, static_cast<int>(state.range(0)));
}

void response(benchmark::State& state, const char* sensor) {
  const AssumedModesArm model(damped_arm());
  time_responses(state, model, sensor);
  state.counters["error"] = error_of_responses(model, arm::parse_sensor(sensor));
}

void repeated(benchmark::internal::Benchmark* benchmark) {
  benchmark->Repetitions(kRepetitions)->MinTime(kMinimumTime_s)->Unit(benchmark::kMillisecond);
}

void many_sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgName("functions")->Arg(16)->Arg(20)->Arg(24)->Arg(28)->Arg(36)->Arg(48)->Arg(60);
  repeated(benchmark);
}

void few_sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgName("functions")->Arg(16)->Arg(36)->Arg(60);
  repeated(benchmark);
}

BENCHMARK_CAPTURE(poles_and_hub_zeros, legendre, Basis::legendre, arm::paper_arm())
    ->Apply(many_sizes);
BENCHMARK_CAPTURE(poles_and_hub_zeros, legendre_loaded, Basis::legendre, loaded_arm())
    ->Apply(few_sizes);
BENCHMARK_CAPTURE(poles_and_hub_zeros, clamped_with_payload_loaded, Basis::clamped_with_payload,
                  loaded_arm())
    ->Apply(few_sizes);
BENCHMARK_CAPTURE(poles_and_hub_zeros, clamped_free_loaded, Basis::clamped_free, loaded_arm())
    ->Apply(few_sizes);
BENCHMARK_CAPTURE(poles_and_hub_zeros, pinned_free_loaded, Basis::pinned_free, loaded_arm())
    ->Apply(few_sizes);

BENCHMARK(ten_poles)->Apply(repeated);
BENCHMARK_CAPTURE(tip_zeros, legendre, Basis::legendre, arm::paper_arm())->Apply(many_sizes);
BENCHMARK_CAPTURE(tip_zeros, legendre_loaded, Basis::legendre, loaded_arm())->Apply(few_sizes);
BENCHMARK_CAPTURE(tip_zeros, clamped_with_payload_loaded, Basis::clamped_with_payload, loaded_arm())
    ->Apply(few_sizes);
BENCHMARK_CAPTURE(tip_zeros, clamped_free_loaded, Basis::clamped_free, loaded_arm())
    ->Apply(few_sizes);
BENCHMARK_CAPTURE(tip_zeros, pinned_free_loaded, Basis::pinned_free, loaded_arm())
    ->Apply(few_sizes);

BENCHMARK(more_tip_zeros)->ArgName("zeros")->DenseRange(2, 10, 2)->Apply(repeated);

BENCHMARK_CAPTURE(response, hub_angle, "hub_angle")->Apply(repeated);
BENCHMARK_CAPTURE(response, tip_displacement, "tip_displacement")->Apply(repeated);
BENCHMARK_CAPTURE(response, strain_at_quarter, "strain@0.24")->Apply(repeated);

}  // namespace
}  // namespace flexarm::benchmarks
