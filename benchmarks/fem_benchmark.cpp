// Finite elements: cost beside error, small models of high degree and long meshes of cubic
// elements.
#include "benchmarks/peak_memory.hpp"
#include "benchmarks/timing.hpp"
#include "fem/fem_arm.hpp"
#include "fem/vibration_modes.hpp"

#include <Eigen/Eigenvalues>
#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

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

/// How the error grows from the first tip zeros to the twelfth, degree 15; `missed` is what the
/// model's own count says it did not find.
void more_tip_zeros(benchmark::State& state) {
  const auto elements = static_cast<int>(state.range(0));
  const auto count = static_cast<int>(state.range(1));
  const auto make = [&] { return fem::FemArm(arm::paper_arm(), {.mesh = {.elements = elements}}); };
  score_tip_zeros(state, make, count);
  const arm::RootCount counted = make().zeros(kTipAcceleration, count).count;
  state.counters["missed"] = counted.expected - counted.found;
}

/// Errors of the first ten poles of the paper's arm, and of the first, which suffers most from
/// rounding.
void score_poles(benchmark::State& state, const std::vector<double>& omega_rad_per_s) {
  const auto exact = exact_tf::ExactArm(arm::paper_arm()).poles(kPoles).omega_rad_per_s;
  state.counters["error"] = worst_relative_error(omega_rad_per_s, exact);
  state.counters["error_of_first"] = std::abs(omega_rad_per_s.front() / exact.front() - 1.0);
}

/// Ten poles from the assembled matrices by a dense solver: what rounding of K = B^T D B costs.
void poles_of_assembled_stiffness(benchmark::State& state) {
  const fem::FemArm model(arm::paper_arm(),
                          {.mesh = {.elements = static_cast<int>(state.range(0))}, .degree = 3});
  const Eigen::MatrixXd stiffness(model.stiffness_N_m());
  const Eigen::MatrixXd mass(model.mass_kg_m2());
  Eigen::VectorXd omega_squared;
  for (auto _ : state) {
    omega_squared = Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(
                        stiffness, mass, Eigen::EigenvaluesOnly | Eigen::Ax_lBx)
                        .eigenvalues();
  }
  std::vector<double> omega;
  for (int i = 1; i <= kPoles; ++i) omega.push_back(std::sqrt(omega_squared[i]));
  score_poles(state, omega);
}

/// Ten modes of cubic elements from the factored stiffness, by the dense solver (singular values of
/// the whole problem) or by Spectra's Lanczos iteration, whatever the size.
void poles_by(benchmark::State& state, fem::Eigensolver eigensolver) {
  const arm::LinearArm arm = arm::linear_arm(arm::paper_arm());
  const fem::Discretisation model(arm, {.elements = static_cast<int>(state.range(0))}, 3);
  Eigen::VectorXd omega_squared;
  for (auto _ : state) {
    omega_squared = fem::vibration_modes(model, fem::HubSupport::free, kPoles,
                                         fem::FemArm::Options{}.eigen_tolerance, eigensolver)
                        .omega_squared;
  }
  std::vector<double> omega_rad_per_s;
  for (const double squared : omega_squared) {
    omega_rad_per_s.push_back(arm::omega_scale_rad_per_s(arm) * std::sqrt(squared));
  }
  score_poles(state, omega_rad_per_s);
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
BENCHMARK(more_tip_zeros)
    ->ArgNames({"elements", "zeros"})
    ->ArgsProduct({{4, 8}, {4, 8, 10, 12}})
    ->Apply(repeated);

void response(benchmark::State& state, const char* sensor) {
  const fem::FemArm model(damped_arm());
  time_responses(state, model, sensor);
  state.counters["error"] = error_of_responses(model, arm::parse_sensor(sensor));
}

BENCHMARK_CAPTURE(response, hub_angle, "hub_angle")->Apply(repeated);
BENCHMARK_CAPTURE(response, tip_displacement, "tip_displacement")->Apply(repeated);
BENCHMARK_CAPTURE(response, strain_at_quarter, "strain@0.24")->Apply(repeated);

/// Construction and ten poles of the default mesh, or of few cubic elements.
void ten_poles(benchmark::State& state, const fem::FemArm::Options& options) {
  const auto make = [&] { return fem::FemArm(arm::paper_arm(), options); };
  for (auto _ : state) benchmark::DoNotOptimize(make().poles(kPoles));
  score_poles(state, make().poles(kPoles).omega_rad_per_s);
}

BENCHMARK_CAPTURE(ten_poles, default_mesh, {})->Apply(repeated);
BENCHMARK_CAPTURE(ten_poles, cubic_elements_29, {.mesh = {.elements = 29}, .degree = 3})
    ->Apply(repeated);
BENCHMARK_CAPTURE(ten_poles, cubic_elements_300, {.mesh = {.elements = 300}, .degree = 3})
    ->Apply(repeated);

/// Construction and ten poles; the project's figure is an error of 1e-9 at 100,000 elements, and
/// time and memory linear in their number.
void poles_of_cubic_elements(benchmark::State& state) {
  const auto elements = static_cast<int>(state.range(0));
  const auto make = [&] {
    return fem::FemArm(arm::paper_arm(), {.mesh = {.elements = elements}, .degree = 3});
  };
  for (auto _ : state) benchmark::DoNotOptimize(make().poles(kPoles));
  const PeakMemory peak;
  const fem::FemArm model = make();
  score_poles(state, model.poles(kPoles).omega_rad_per_s);
  state.counters["bytes_per_element"] = peak.bytes() / elements;
  state.counters["s_per_element"] = seconds_each(elements);
  state.SetComplexityN(elements);
}

BENCHMARK(poles_of_cubic_elements)
    ->ArgName("elements")
    ->RangeMultiplier(10)
    ->Range(100, 100000)
    ->Apply(repeated);
BENCHMARK(poles_of_assembled_stiffness)
    ->ArgName("elements")
    ->ArgsProduct({{20, 40, 80, 160, 320}})
    ->Apply(repeated);
void poles_by_size(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgName("elements")->ArgsProduct({{20, 40, 80, 160, 320}});
  repeated(benchmark);
}
BENCHMARK_CAPTURE(poles_by, dense, fem::Eigensolver::dense)->Apply(poles_by_size);
BENCHMARK_CAPTURE(poles_by, lanczos, fem::Eigensolver::lanczos)->Apply(poles_by_size);

}  // namespace
}  // namespace flexarm::benchmarks
