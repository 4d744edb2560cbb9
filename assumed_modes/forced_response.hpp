#pragma once

#include "assumed_modes/real.hpp"
#include "assumed_modes/ritz.hpp"
#include "assumed_modes/undamped_modes.hpp"

#include <complex>

namespace flexarm::assumed_modes {

/// What `output`, the value of a sensor in each mode, shows of a unit of torque over EI/l at
/// s = sigma sqrt(EI/(m l^4)). The modes' equations
///
///     (diag(mass) sigma^2 + D sigma + diag(stiffness)) eta = hub_rotation
///
/// are solved mode by mode where D is diagonal but for hub friction, whose rank is one (Sherman and
/// Morrison's formula), and as one dense system otherwise: factors in double, and residuals in long
/// double until the solution stays as it is.
std::complex<Real> forced_response(const RitzPairs& modes, const ModalDamping& damping,
                                   const Vector& output, std::complex<Real> sigma);

}  // namespace flexarm::assumed_modes
