// Writes the linear simulation of simulation_benchmark as JSON to standard output: state space,
// torque and what flexarm makes of it, for benchmarks/simulation_scipy.py.
#include "benchmarks/simulation_case.hpp"
#include "response/state_space.hpp"

#include <nlohmann/json.hpp>

#include <iostream>

namespace {

nlohmann::json rows(const Eigen::MatrixXd& matrix) {
  auto made = nlohmann::json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    made.push_back(std::vector<double>(static_cast<std::size_t>(matrix.cols())));
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
      made.back()[static_cast<std::size_t>(j)] = matrix(i, j);
    }
  }
  return made;
}

}  // namespace

int main() {
  using namespace flexarm;
  constexpr int kFlexibleModes = 10;
  const auto timed = benchmarks::simulation_case(kFlexibleModes);
  const auto system = response::state_space(timed.model, timed.sensors);
  response::ArmParts parts;
  parts.linear = timed.arm;
  const auto made = response::simulate(timed.model, parts, timed.sensors, timed.torque_N_m,
                                       {.sample_time_s = timed.sample_time_s, .energy = false});
  nlohmann::json document;
  document["modes"] = kFlexibleModes;
  document["sample_time_s"] = timed.sample_time_s;
  document["torque_N_m"] = timed.torque_N_m;
  document["a"] = rows(system.a);
  document["b"] = rows(system.b);
  document["c"] = rows(system.c);
  document["d"] = rows(system.d);
  document["channels"] = made.channels;
  std::cout << document << '\n';
  return 0;
}
