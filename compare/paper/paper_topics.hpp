#pragma once

#include "compare/paper/paper_cells.hpp"
#include "compare/paper/paper_check.hpp"

#include <string>
#include <vector>

namespace flexarm::compare::paper {

/// (1)-(14): energies, Hamilton's principle, equation of motion and its conditions.
Topic check_motion();
/// (15)-(25) and the remarks on hub inertia and payload: roots, shapes, orthogonality.
Topic check_mode_shapes();
/// (26)-(35): modal energies, decoupled equations, state space.
Topic check_state_space();
/// (36)-(42): transformed problem, determinants, products of poles and zeros.
Topic check_transfer_functions();
/// (43)-(52): spectra, and identification from poles, zeros and resonances.
Topic check_identification();
/// Tables 1-7 against the paper's own equations.
Topic check_tables();

/// All topics in the paper's order, and the cells of its tables.
struct Findings {
  std::vector<Topic> topics;
  std::vector<CellCheck> cells;
};

/// Takes less than a second.
Findings check_paper();

/// What "payload", "damped" and the like stand for in the quantities' names.
std::string describe_arms();

/// Frequency at which transfer functions are compared: between the first hub zero and the first
/// pole of the paper's arm.
inline constexpr double kTestFrequency_Hz = 5.0;

/// Relative tolerances: for roots and transfer functions that each formulation finds on its own
/// (the formulations reach 1e-10; the paper prints 5 digits), for integrals over modes (the second
/// derivatives of discretised modes are good to 1e-8), and for sums and products cut at `kTerms`
/// modes (what is left out falls at least as the third power of the number).
inline constexpr double kRootTolerance = 1e-9;
inline constexpr double kIntegralTolerance = 1e-7;
inline constexpr double kSeriesTolerance = 1e-5;
inline constexpr int kTerms = 30;

}  // namespace flexarm::compare::paper
