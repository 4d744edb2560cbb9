#pragma once

#include "benchmarks/simulation_case.hpp"
#include "effects/registry/vocabulary.hpp"

#include <cstddef>

namespace flexarm::benchmarks {

inline constexpr double kCoulombTorque_N_m = 0.012;
/// A second: ten steps of torque, some of them below the friction, so that the hub sticks.
inline constexpr std::size_t kFrictionSamples = 10'000;
/// Inner steps a sample of what errors are measured against.
inline constexpr int kReferenceSubsteps = 10;

struct FrictionCase {
  SimulationCase timed;
  response::ArmParts parts;
};

/// The first second of simulation_case() with Coulomb friction at the hub.
inline FrictionCase friction_case(int flexible_modes) {
  FrictionCase made{simulation_case(flexible_modes, {}, kFrictionSamples), {}};
  made.parts = response::take_apart(made.timed.arm);
  response::add_effect(made.parts,
                       effects::effect("coulomb_friction", {{"torque", kCoulombTorque_N_m}}));
  return made;
}

}  // namespace flexarm::benchmarks
