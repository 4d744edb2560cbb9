#pragma once

#include "benchmarks/yardstick.hpp"

#include <benchmark/benchmark.h>

#include <string>

namespace flexarm::benchmarks {

/// Every time printed is the least of this many repetitions.
inline constexpr int kRepetitions = 5;
/// A repetition lasts at least this long.
inline constexpr double kMinimumTime_s = 0.03;

/// Seconds per root, point or element, `count` of them an iteration.
inline benchmark::Counter seconds_each(int count) {
  return {static_cast<double>(count),
          benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert};
}

/// Ten poles and ten hub zeros; `make()` constructs the model and is part of the time.
template <class Make>
void time_poles_and_hub_zeros(benchmark::State& state, const Make& make) {
  for (auto _ : state) {
    const auto model = make();
    benchmark::DoNotOptimize(model.poles(kPoles));
    benchmark::DoNotOptimize(model.zeros(kHubAngle, kHubZeros));
  }
}

/// The same, with the error.
template <class Make>
void score_poles_and_hub_zeros(benchmark::State& state, const Make& make) {
  time_poles_and_hub_zeros(state, make);
  state.counters["error"] = error_of_poles_and_hub_zeros(make());
}

/// The first `count` tip zeros; `make()` constructs the model and is part of the time.
template <class Make>
void time_tip_zeros(benchmark::State& state, const Make& make, int count) {
  for (auto _ : state) {
    const auto model = make();
    benchmark::DoNotOptimize(model.zeros(kTipAcceleration, count));
  }
}

/// The same, with how many of them the model trusts and the error of those.
template <class Make>
void score_tip_zeros(benchmark::State& state, const Make& make, int count) {
  time_tip_zeros(state, make, count);
  const auto model = make();
  state.counters["found"] =
      static_cast<double>(model.zeros(kTipAcceleration, count).s_rad_per_s.size());
  state.counters["error"] = error_of_zeros(model, kTipAcceleration, count);
}

/// The response of `sensor` at frequency_points(), without construction.
template <arm::Formulation Model>
void time_responses(benchmark::State& state, const Model& model, const std::string& sensor) {
  const arm::Sensor read = arm::parse_sensor(sensor);
  const auto points = frequency_points();
  for (auto _ : state) benchmark::DoNotOptimize(responses(model, read, points));
  state.counters["s_per_point"] = seconds_each(static_cast<int>(points.size()));
}

}  // namespace flexarm::benchmarks
