#include "benchmarks/comparison/inputs.hpp"
#include "benchmarks/comparison/raw_files.hpp"
#include "exact_tf/exact_arm.hpp"

namespace flexarm::benchmarks {

void write_roots(const std::filesystem::path& folder) {
  constexpr int kRoots = 1000;
  const arm::Arm arm = arm::paper_arm();
  const exact_tf::ExactArm exact(arm);
  write_json(folder / "roots.json",
             {{"flexural_rigidity_N_m2", arm.beam.flexural_rigidity_N_m2()},
              {"linear_density_kg_per_m", arm.beam.linear_density_kg_per_m()},
              {"length_m", arm.beam.length_m},
              {"hub_inertia_kg_m2", arm.hub.inertia_kg_m2},
              {"pole_lambda", exact.pole_lambdas(kRoots)},
              {"hub_zero_lambda", exact.hub_zero_lambdas(kRoots)}});
}

}  // namespace flexarm::benchmarks
