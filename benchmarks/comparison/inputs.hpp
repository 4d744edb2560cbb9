#pragma once

#include <filesystem>

namespace flexarm::benchmarks {

// What the scripts of this folder read: arms, matrices, state spaces, torques, and what flexarm
// makes of them. Each writes into `folder` and throws std::runtime_error if it cannot.

/// roots.json: numbers of the paper's arm, 1000 roots lambda of poles and of hub zeros.
void write_roots(const std::filesystem::path& folder);

/// matrices.json and a file for each matrix: stiffness and mass of cubic elements and of assumed
/// modes.
void write_matrices(const std::filesystem::path& folder);

/// responses.json: frequencies, exact responses of the hub angle, modal state spaces.
void write_responses(const std::filesystem::path& folder);

/// simulation.json: the linear simulation of simulation_benchmark. friction.json: its first second
/// with Coulomb friction.
void write_simulations(const std::filesystem::path& folder);

}  // namespace flexarm::benchmarks
