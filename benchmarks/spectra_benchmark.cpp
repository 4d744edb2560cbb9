// Spectra and frequency responses of an hour at 1 kHz with five channels, on one core: processor
// time, values a second.
#include "benchmarks/spectra_case.hpp"
#include "benchmarks/timing.hpp"
#include "measured/spectra/period.hpp"
#include "measured/spectra/response_estimate.hpp"

#include <benchmark/benchmark.h>

#include <cstddef>
#include <vector>

namespace flexarm::benchmarks {
namespace {

const measured::TimeRecord& hour() {
  static const measured::TimeRecord record = spectra_record();
  return record;
}

std::vector<measured::Signal> signals(const measured::TimeRecord& record) {
  std::vector<measured::Signal> made;
  for (const auto& channel : record.channels) made.push_back({channel.values});
  return made;
}

void count_samples(benchmark::State& state) {
  const auto values = static_cast<double>(hour().torque_N_m.size() * (1 + hour().channels.size()));
  state.counters["values_per_s"] = {values, benchmark::Counter::kIsIterationInvariantRate};
}

void cross_spectra(benchmark::State& state) {
  const auto outputs = signals(hour());
  const auto run = [&] {
    return measured::cross_spectra({hour().torque_N_m}, outputs,
                                   measured::sampling_period_s(hour()), spectra_plan());
  };
  for (auto _ : state) benchmark::DoNotOptimize(run());
  count_samples(state);
}

void estimate(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(measured::estimate_frequency_response(hour()));
  count_samples(state);
}

void find_period(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(measured::find_period(hour().torque_N_m));
}

/// The same length, periodic: 60 periods of a minute.
void estimate_periodic(benchmark::State& state) {
  measured::TimeRecord record = hour();
  constexpr std::size_t kPeriod = 60'000;
  const auto repeat = [](std::vector<double>& values) {
    for (std::size_t j = kPeriod; j < values.size(); ++j) values[j] = values[j % kPeriod];
  };
  repeat(record.torque_N_m);
  for (auto& channel : record.channels) repeat(channel.values);
  for (auto _ : state) benchmark::DoNotOptimize(measured::estimate_frequency_response(record));
  count_samples(state);
}

void repeated(benchmark::internal::Benchmark* benchmark) {
  benchmark->Repetitions(kRepetitions)->Iterations(1)->Unit(benchmark::kMillisecond);
}

BENCHMARK(cross_spectra)->Apply(repeated);
BENCHMARK(estimate)->Apply(repeated);
BENCHMARK(find_period)->Apply(repeated);
BENCHMARK(estimate_periodic)->Apply(repeated);

}  // namespace
}  // namespace flexarm::benchmarks
