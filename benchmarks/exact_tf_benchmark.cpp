// The exact transfer function: time a root with its certified distance, time of the certificate,
// time a value with its error against 30 digits.
#include "benchmarks/timing.hpp"
#include "exact_tf/certificate.hpp"
#include "exact_tf/exact_arm.hpp"
#include "tests/reference/effect_cases.hpp"
#include "tests/reference/reference_cases.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace flexarm::benchmarks {
namespace {

using exact_tf::Arithmetic;
using exact_tf::Certificate;
using exact_tf::ExactArm;

using Output = std::complex<double> reference::ReferenceResponse::*;

/// Largest distance of a root from the true one, in ulp of lambda; infinite where nothing is
/// proved.
double worst_ulp(const Certificate& certificate) {
  return certificate.proved ? certificate.largest_distance_ulp
                            : std::numeric_limits<double>::infinity();
}

Certificate pole_certificate(int count) {
  const ExactArm exact(arm::paper_arm());
  return exact_tf::certify_poles(exact.arm(), exact.pole_lambdas(count));
}

Certificate hub_zero_certificate(int count) {
  const ExactArm exact(arm::paper_arm());
  return exact_tf::certify_hub_zeros(exact.arm(), exact.hub_zero_lambdas(count));
}

/// A list is certified once, however often its search is timed.
double worst_ulp_of(Certificate (*certified)(int), int count) {
  static std::map<std::pair<Certificate (*)(int), int>, double> known;
  const auto key = std::pair(certified, count);
  if (!known.contains(key)) known[key] = worst_ulp(certified(count));
  return known[key];
}

/// Largest relative error of ten poles and ten hub zeros against the reference's digits, in Hz.
double error_of_reference_roots() {
  const ExactArm exact(arm::paper_arm());
  const auto& known = reference::case_named("paper");
  std::vector<double> found_Hz;
  std::vector<double> digits_Hz(known.pole_Hz.begin(), known.pole_Hz.end());
  digits_Hz.insert(digits_Hz.end(), known.hub_zero_Hz.begin(), known.hub_zero_Hz.end());
  for (const double omega_rad_per_s : exact.poles(kPoles).omega_rad_per_s) {
    found_Hz.push_back(omega_rad_per_s / (2.0 * std::numbers::pi));
  }
  for (const auto s : exact.zeros(kHubAngle, kHubZeros).s_rad_per_s) {
    found_Hz.push_back(s.imag() / (2.0 * std::numbers::pi));
  }
  return worst_relative_error(found_Hz, digits_Hz);
}

void poles_and_hub_zeros(benchmark::State& state) {
  time_poles_and_hub_zeros(state, [] { return ExactArm(arm::paper_arm()); });
  state.counters["error"] = error_of_reference_roots();
  state.counters["ulp"] = std::max(worst_ulp_of(pole_certificate, kPoles),
                                   worst_ulp_of(hub_zero_certificate, kHubZeros));
}

void tip_zeros(benchmark::State& state) {
  time_tip_zeros(
      state, [] { return ExactArm(arm::paper_arm()); }, kTipZeros);
  const ExactArm exact(arm::paper_arm());
  state.counters["ulp"] = worst_ulp(exact_tf::certify_zeros(
      exact.arm(), kTipAcceleration, exact.zeros(kTipAcceleration, kTipZeros).s_rad_per_s));
}

void poles(benchmark::State& state) {
  const auto count = static_cast<int>(state.range(0));
  for (auto _ : state) benchmark::DoNotOptimize(ExactArm(arm::paper_arm()).poles(count));
  state.counters["s_per_root"] = seconds_each(count);
  state.counters["ulp"] = worst_ulp_of(pole_certificate, count);
}

void hub_zeros(benchmark::State& state) {
  const auto count = static_cast<int>(state.range(0));
  for (auto _ : state) {
    benchmark::DoNotOptimize(ExactArm(arm::paper_arm()).zeros(kHubAngle, count));
  }
  state.counters["s_per_root"] = seconds_each(count);
  state.counters["ulp"] = worst_ulp_of(hub_zero_certificate, count);
}

void certificate_of_poles(benchmark::State& state) {
  const auto count = static_cast<int>(state.range(0));
  const ExactArm exact(arm::paper_arm());
  const auto lambdas = exact.pole_lambdas(count);
  for (auto _ : state) benchmark::DoNotOptimize(exact_tf::certify_poles(exact.arm(), lambdas));
  state.counters["s_per_root"] = seconds_each(count);
}

/// Largest relative error at the four frequencies of the reference's case "paper", whose
/// `output` times `unit` is what the sensor reads.
double reference_error(const arm::Sensor& sensor, Output output, double unit) {
  const ExactArm exact(arm::paper_arm());
  std::vector<std::complex<double>> found;
  std::vector<std::complex<double>> digits;
  for (const auto& point : reference::case_named("paper").responses) {
    found.push_back(exact.transfer_function(sensor, point.s_rad_per_s));
    digits.push_back(unit * point.*output);
  }
  return worst_relative_error(found, digits);
}

void response(benchmark::State& state, const char* sensor, Output output, double unit) {
  time_responses(state, ExactArm(damped_arm()), sensor);
  state.counters["error"] = reference_error(arm::parse_sensor(sensor), output, unit);
}

/// The case of effects.json that has these effects, without the closed forms' help.
const reference::EffectCase& effect_case(const std::string& name) {
  for (const auto& each : reference::effect_cases()) {
    if (each.name == name) return each;
  }
  throw std::invalid_argument("no case " + name + " in effects.json");
}

/// Ten poles, hub zeros and tip zeros of an arm with effects; error of the six poles and hub zeros
/// that the reference has.
void roots_with_effects(benchmark::State& state, const char* name,
                        Arithmetic arithmetic = Arithmetic::extended) {
  const auto& known = effect_case(name);
  for (auto _ : state) {
    const ExactArm exact(known.arm, arithmetic);
    benchmark::DoNotOptimize(exact.poles(kPoles));
    benchmark::DoNotOptimize(exact.zeros(kHubAngle, kHubZeros));
    benchmark::DoNotOptimize(exact.zeros(kTipAcceleration, kTipZeros));
  }
  const ExactArm exact(known.arm, arithmetic);
  const auto poles = exact.poles(kPoles);
  const auto zeros = exact.zeros(kHubAngle, kHubZeros);
  double error = 0.0;
  for (std::size_t i = 0; i < known.pole_rad_per_s.size(); ++i) {
    error = std::max(error, std::abs(poles.omega_rad_per_s[i] / known.pole_rad_per_s[i] - 1.0));
  }
  for (std::size_t i = 0; i < known.hub_zero_rad_per_s.size(); ++i) {
    error =
        std::max(error, std::abs(zeros.s_rad_per_s[i].imag() / known.hub_zero_rad_per_s[i] - 1.0));
  }
  state.counters["error"] = error;
}

void damped_poles_with_effects(benchmark::State& state, const char* name,
                               Arithmetic arithmetic = Arithmetic::extended) {
  const ExactArm exact(effect_case(name).arm, arithmetic);
  for (auto _ : state) benchmark::DoNotOptimize(exact.damped_poles(kPoles));
}

void modal_model_with_effects(benchmark::State& state, const char* name,
                              Arithmetic arithmetic = Arithmetic::extended) {
  const ExactArm exact(effect_case(name).arm, arithmetic);
  const std::vector<arm::Sensor> sensors = {kHubAngle, kTipAcceleration};
  for (auto _ : state) benchmark::DoNotOptimize(exact.modal_model(kPoles, sensors, {}));
}

/// The tip's response; error at the reference's points.
void response_with_effects(benchmark::State& state, const char* name,
                           Arithmetic arithmetic = Arithmetic::extended) {
  const auto& known = effect_case(name);
  const ExactArm exact(known.arm, arithmetic);
  time_responses(state, exact, "tip_displacement");
  std::vector<std::complex<double>> found;
  std::vector<std::complex<double>> digits;
  for (const auto& point : known.responses) {
    for (const auto& [sensor, value] : point.values) {
      found.push_back(exact.transfer_function(arm::parse_sensor(sensor), point.s_rad_per_s));
      digits.push_back(value);
    }
  }
  state.counters["error"] = worst_relative_error(found, digits);
}

void repeated(benchmark::internal::Benchmark* benchmark) {
  benchmark->Repetitions(kRepetitions)->MinTime(kMinimumTime_s)->Unit(benchmark::kMicrosecond);
}

void many_roots(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgName("roots")->Arg(10)->Arg(1000)->Arg(10000);
  repeated(benchmark);
}

BENCHMARK(poles_and_hub_zeros)->Apply(repeated);
BENCHMARK(tip_zeros)->Apply(repeated);
BENCHMARK(poles)->Apply(many_roots);
BENCHMARK(hub_zeros)->Apply(many_roots);
BENCHMARK(certificate_of_poles)->Apply(many_roots);
BENCHMARK_CAPTURE(roots_with_effects, root_compliance, "root_compliance")->Apply(repeated);
BENCHMARK_CAPTURE(roots_with_effects, crack, "local_stiffness_loss")->Apply(repeated);
BENCHMARK_CAPTURE(roots_with_effects, gravity, "gravity")->Apply(repeated);
BENCHMARK_CAPTURE(roots_with_effects, shear, "shear_and_rotary_inertia")->Apply(repeated);
BENCHMARK_CAPTURE(roots_with_effects, all, "all")->Apply(repeated);
BENCHMARK_CAPTURE(damped_poles_with_effects, all, "all")->Apply(repeated);
BENCHMARK_CAPTURE(modal_model_with_effects, crack, "local_stiffness_loss")->Apply(repeated);
BENCHMARK_CAPTURE(modal_model_with_effects, gravity, "gravity")->Apply(repeated);
BENCHMARK_CAPTURE(modal_model_with_effects, all, "all")->Apply(repeated);
BENCHMARK_CAPTURE(response_with_effects, crack, "local_stiffness_loss")->Apply(repeated);
BENCHMARK_CAPTURE(response_with_effects, gravity, "gravity")->Apply(repeated);
BENCHMARK_CAPTURE(response_with_effects, all, "all")->Apply(repeated);
BENCHMARK_CAPTURE(roots_with_effects, crack_working, "local_stiffness_loss", Arithmetic::working)
    ->Apply(repeated);
BENCHMARK_CAPTURE(roots_with_effects, gravity_working, "gravity", Arithmetic::working)
    ->Apply(repeated);
BENCHMARK_CAPTURE(roots_with_effects, all_working, "all", Arithmetic::working)->Apply(repeated);
BENCHMARK_CAPTURE(damped_poles_with_effects, all_working, "all", Arithmetic::working)
    ->Apply(repeated);
BENCHMARK_CAPTURE(modal_model_with_effects, crack_working, "local_stiffness_loss",
                  Arithmetic::working)
    ->Apply(repeated);
BENCHMARK_CAPTURE(modal_model_with_effects, gravity_working, "gravity", Arithmetic::working)
    ->Apply(repeated);
BENCHMARK_CAPTURE(modal_model_with_effects, all_working, "all", Arithmetic::working)
    ->Apply(repeated);
BENCHMARK_CAPTURE(response_with_effects, crack_working, "local_stiffness_loss", Arithmetic::working)
    ->Apply(repeated);
BENCHMARK_CAPTURE(response_with_effects, gravity_working, "gravity", Arithmetic::working)
    ->Apply(repeated);
BENCHMARK_CAPTURE(response_with_effects, all_working, "all", Arithmetic::working)->Apply(repeated);
BENCHMARK_CAPTURE(response, hub_angle, "hub_angle", &reference::ReferenceResponse::hub_angle, 1.0)
    ->Apply(repeated);
BENCHMARK_CAPTURE(response, tip_displacement, "tip_displacement",
                  &reference::ReferenceResponse::tip_displacement, 1.0)
    ->Apply(repeated);
BENCHMARK_CAPTURE(response, strain_at_quarter, "strain@0.24",
                  &reference::ReferenceResponse::curvature_quarter,
                  arm::paper_arm().beam.thickness_m.value() / 2.0)
    ->Apply(repeated);

}  // namespace
}  // namespace flexarm::benchmarks
