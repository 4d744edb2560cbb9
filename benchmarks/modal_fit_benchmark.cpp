// Time and memory of a rational fit of all sensors: a minute at 200 Hz and, with `hour`, an hour at
// 1 kHz; errors of the first mode beside them.
//
// modal_fit_benchmark [hour]
#include "benchmarks/peak_memory.hpp"
#include "measured/modal/modal_fit.hpp"
#include "tests/fit_cases/fit_cases.hpp"

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <string_view>

namespace flexarm::benchmarks {
namespace {

void time_fit(const char* name, const measured::FitCase& fit_case) {
  const auto model = measured::model_of(fit_case);
  std::array records = {measured::clean_record(fit_case, model)};
  measured::add_noise(records[0], fit_case.relative_noise, fit_case.seed);
  const PeakMemory memory;
  const auto begin = std::chrono::steady_clock::now();
  const auto fit = measured::fit_modes(records);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
  const auto pole = measured::exact_roots(model, 0).poles.front();
  const double frequency_Hz = std::abs(pole) / (2.0 * std::numbers::pi);
  const double damping_ratio = -pole.real() / std::abs(pole);
  fmt::print(
      "{}: {} samples, {} channels, {} blocks: {:.3f} s, {:.0f} MB; mode 1: frequency {:+.1e}, "
      "damping "
      "{:+.1e} of itself off{}\n",
      name, records[0].time_s.size(), records[0].channels.size(), fit.blocks.blocks.size(),
      elapsed.count(), 1e-6 * memory.bytes(), fit.poles.front().frequency_Hz / frequency_Hz - 1.0,
      fit.poles.front().damping_ratio / damping_ratio - 1.0,
      fit.converged ? "" : "; not converged");
}

}  // namespace
}  // namespace flexarm::benchmarks

int main(int argc, char** argv) {
  using namespace flexarm;
  measured::FitCase minute;
  minute.modes = 4;
  minute.relative_noise = 0.01;
  benchmarks::time_fit("a minute at 200 Hz", minute);
  if (argc > 1 && std::string_view(argv[1]) == "hour") {
    measured::FitCase hour = minute;
    hour.sensors = measured::sensors_named(
        {"hub_angle", "hub_velocity", "tip_acceleration", "strain@0.05", "strain@0.25"});
    hour.duration_s = 3600.0;
    hour.sample_time_s = 1e-3;
    hour.excitation = response::RandomNoise{.to_Hz = 150.0};
    benchmarks::time_fit("an hour at 1 kHz", hour);
  }
}
