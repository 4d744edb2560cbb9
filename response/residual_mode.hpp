#pragma once

#include "response/any_formulation.hpp"

#include <span>

namespace flexarm::response {

/// `model`, the lowest mode and n flexible ones of `formulation` with values at `sensors`, with one
/// pseudo-mode more, which answers for all modes left out: modal truncation augmentation
/// [Dickens1997]. Its shape is the part that those
/// modes have in the static deflection under hub torque,
///
///     phi_r = sum_{i>n} a_i phi_i,   a_i = theta_i/(omega_i^2 sqrt(I_T A_1)),
///     A_k = 1/I_T sum_{i>n} theta_i^2/omega_i^(2 + 2 k),
///
/// theta_i the hub slopes: orthogonal to the modes kept, of modal mass I_T. Its frequency is the
/// Rayleigh quotient omega_r^2 = A_0/A_1, its hub slope theta_r = A_0 sqrt(I_T/A_1), and its value
/// at a sensor sigma_r = R theta_r/A_0 with R = 1/I_T sum_{i>n} sigma_i theta_i/omega_i^2, the
/// static response that the modes left out have in common. Between the modes kept the error of a
/// displacement falls with omega/omega_{n+1} as its square (without the pseudo-mode: not at all),
/// that of the hub angle as its fourth power; velocities gain a factor omega, accelerations two.
///
/// R, A_0 and A_1 are the Taylor coefficients in z = s^2 of the undamped transfer function less the
/// modes kept, taken on a circle (response/time/taylor_series.hpp). It lies midway between two kept
/// poles, |z| <= omega_{n+1}^2/2 where they allow it: points enough are then fifty or so, while
/// the response on the circle is of the size of what is left of it, so that few digits cancel.
/// A coefficient that is lost in the rounding of the response (R and A_k of a hub that hardly
/// moves) is taken as that of mode n + 1 alone.
///
/// Damping is projected on that shape, D_rj = sum a_i D_ij, over half as many further modes as are
/// kept, 8 at least. The rest of the shape, with hub slope theta, modal mass b^2 I_T and its share
/// w of omega_r^2, adds c theta theta_j/I_T to D_rj, and c theta^2/I_T + kv w + b^2 ca/m to D_rr:
/// the projection of hub friction and of Kelvin-Voigt damping, and a bound for the drag of air. D
/// stays positive semidefinite. What the modes kept do to those left out by their damping, where it
/// couples them (a beam that dissipates on a root that does not), is no response to the torque and
/// remains, an error of the order of the damping.
///
/// The displacements of the pseudo-mode are 0: what acts along the beam does not reach it. Returns
/// `model` as it is when the formulation has no further modes. Throws std::invalid_argument for a
/// model whose modes do not have a value at each of `sensors`, InputError as `modal_model` does.
arm::ModalModel with_residual_mode(const AnyFormulation& formulation, const arm::ModalModel& model,
                                   std::span<const arm::Sensor> sensors);

}  // namespace flexarm::response
