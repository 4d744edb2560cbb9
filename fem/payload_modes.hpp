#pragma once

#include "fem/discretisation.hpp"
#include "fem/flexible_solve.hpp"

#include <Eigen/Core>

namespace flexarm::fem {

/// The modes in which a heavy payload swings on the beam as on a spring, n x (0, 1 or 2), slowest
/// first, u^T M u = 1: those with 1/omega^2 above 10^4 times that of the clamped beam alone. The
/// payload adds two to the rank of the mass, so all other modes stay below that of the beam alone
/// (Weyl's inequality). A Krylov space started beside such a mode spends its digits on it.
///
/// By subspace iteration from the responses to a force and a couple at the tip; the gap gains four
/// digits a step at least. An arm whose payload cannot be that heavy costs nothing: by Dunkerley's
/// inequality 1/omega_1^2 is at most that of the beam plus mass/3 plus inertia.
Eigen::MatrixXd payload_modes(const Discretisation& discretisation, const FlexibleSolve& solve);

}  // namespace flexarm::fem
