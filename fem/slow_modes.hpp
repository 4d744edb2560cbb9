#pragma once

#include "fem/discretisation.hpp"
#include "fem/flexible_solve.hpp"

#include <Eigen/Core>

namespace flexarm::fem {

/// The modes that are far slower than a beam's own, n x (0 to 6 and the suspended masses), slowest
/// first, u^T M u = 1: a heavy payload on the beam as on a spring, the beam on a soft drive or root
/// or beyond a crack, a mass on a soft suspension, the hub. They are those with 1/(omega^2 + shift)
/// above 10^4 times that of the clamped beam alone. Payload, springs, suspensions and hub add one
/// or two each to the rank of mass or flexibility, so that all other modes stay below that of the
/// beam alone (Weyl's inequality), or where the beam carries masses of up to kLargestCarriedRatio
/// not far above it. A Krylov space started beside such a mode spends its digits on it.
///
/// By subspace iteration from the responses to a force and a couple at the tip, couples beyond
/// drive, root and crack, forces on suspended masses, and the load that turns the arm; the gap
/// gains four digits a step at least. An arm that cannot be that slow costs nothing: by Dunkerley's
/// inequality 1/omega_1^2 is at most the sum of what each mass has on each flexibility alone.
Eigen::MatrixXd slow_modes(const Discretisation& discretisation, const FlexibleSolve& solve);

}  // namespace flexarm::fem
