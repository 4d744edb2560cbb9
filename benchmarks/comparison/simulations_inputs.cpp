#include "benchmarks/comparison/friction_case.hpp"
#include "benchmarks/comparison/inputs.hpp"
#include "benchmarks/comparison/raw_files.hpp"
#include "benchmarks/simulation_case.hpp"
#include "response/state_space.hpp"

namespace flexarm::benchmarks {
namespace {

constexpr int kFlexibleModes = 10;

nlohmann::json document_of(const SimulationCase& timed, const response::ArmParts& parts,
                           int substeps) {
  const auto system = response::state_space(timed.model, timed.sensors);
  const auto made = response::simulate(
      timed.model, parts, timed.sensors, timed.torque_N_m,
      {.sample_time_s = timed.sample_time_s, .substeps = substeps, .energy = false});
  return {{"modes", kFlexibleModes},
          {"sample_time_s", timed.sample_time_s},
          {"torque_N_m", timed.torque_N_m},
          {"a", rows(system.a)},
          {"b", rows(system.b)},
          {"c", rows(system.c)},
          {"d", rows(system.d)},
          {"channels", made.channels}};
}

}  // namespace

void write_simulations(const std::filesystem::path& folder) {
  const auto linear = simulation_case(kFlexibleModes);
  response::ArmParts parts;
  parts.linear = linear.arm;
  write_json(folder / "simulation.json", document_of(linear, parts, 0));

  const auto friction = friction_case(kFlexibleModes);
  auto document = document_of(friction.timed, friction.parts, kReferenceSubsteps);
  document["coulomb_torque_N_m"] = kCoulombTorque_N_m;
  write_json(folder / "friction.json", document);
}

}  // namespace flexarm::benchmarks
