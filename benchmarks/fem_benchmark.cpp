// Finite elements: cost beside error, small models of high degree and long meshes of cubic
// elements.
#include "benchmarks/peak_memory.hpp"
#include "benchmarks/timing.hpp"
#include "fem/fem_arm.hpp"

#include <benchmark/benchmark.h>

namespace flexarm::benchmarks {
namespace {

fem::FemArm model_of(const benchmark::State& state) {
  return fem::FemArm(arm::paper_arm(), {.mesh = {.elements = static_cast<int>(state.range(1))},
                                        .degree = static_cast<int>(state.range(0))});
}

void poles_and_hub_zeros(benchmark::State& state) {
  score_poles_and_hub_zeros(state, [&] { return model_of(state); });
  state.counters["dof"] = model_of(state).degrees_of_freedom();
}

void tip_zeros(benchmark::State& state) {
  score_tip_zeros(
      state, [&] { return model_of(state); }, kTipZeros);
  state.counters["dof"] = model_of(state).degrees_of_freedom();
}

void tip_zeros_of_default_model(benchmark::State& state) {
  score_tip_zeros(
      state, [] { return fem::FemArm(arm::paper_arm()); }, static_cast<int>(state.range(0)));
}

void repeated(benchmark::internal::Benchmark* benchmark) {
  benchmark->Repetitions(kRepetitions)->MinTime(kMinimumTime_s)->Unit(benchmark::kMillisecond);
}

/// At most 60 degrees of freedom for each degree, then more of the low degrees.
void settings(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"degree", "elements"});
  for (const auto& [degree, elements] :
       {std::pair{3, 29}, {5, 14}, {11, 5}, {15, 4}, {3, 1000}, {5, 100}}) {
    benchmark->Args({degree, elements});
  }
  repeated(benchmark);
}

BENCHMARK(poles_and_hub_zeros)->Apply(settings);
BENCHMARK(tip_zeros)->Apply(settings);
BENCHMARK(tip_zeros_of_default_model)->ArgName("zeros")->DenseRange(2, 10, 2)->Apply(repeated);

void response(benchmark::State& state, const char* sensor) {
  const fem::FemArm model(damped_arm());
  time_responses(state, model, sensor);
  state.counters["error"] = error_of_responses(model, arm::parse_sensor(sensor));
}

BENCHMARK_CAPTURE(response, hub_angle, "hub_angle")->Apply(repeated);
BENCHMARK_CAPTURE(response, tip_displacement, "tip_displacement")->Apply(repeated);
BENCHMARK_CAPTURE(response, strain_at_quarter, "strain@0.24")->Apply(repeated);

/// Construction and ten poles; the figure is an error of 1e-9 at 100,000 elements, and time
/// and memory linear in their number.
void poles_of_cubic_elements(benchmark::State& state) {
  const auto elements = static_cast<int>(state.range(0));
  const auto make = [&] {
    return fem::FemArm(arm::paper_arm(), {.mesh = {.elements = elements}, .degree = 3});
  };
  for (auto _ : state) benchmark::DoNotOptimize(make().poles(kPoles));
  const PeakMemory peak;
  const fem::FemArm model = make();
  state.counters["error"] = error_of_poles(model);
  state.counters["bytes_per_element"] = peak.bytes() / elements;
  state.counters["s_per_element"] = seconds_each(elements);
  state.SetComplexityN(elements);
}

constexpr int kFewRepetitions = 3;
BENCHMARK(poles_of_cubic_elements)
    ->ArgName("elements")
    ->RangeMultiplier(10)
    ->Range(100, 100000)
    ->Repetitions(kFewRepetitions)
    ->MinTime(kMinimumTime_s)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace flexarm::benchmarks
