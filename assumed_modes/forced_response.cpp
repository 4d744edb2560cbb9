#include "assumed_modes/forced_response.hpp"

#include <Eigen/LU>

namespace flexarm::assumed_modes {

namespace {

using Complex = std::complex<Real>;
using ComplexVector = Eigen::Matrix<Complex, Eigen::Dynamic, 1>;
using ComplexMatrix = Eigen::Matrix<Complex, Eigen::Dynamic, Eigen::Dynamic>;

}  // namespace

std::complex<Real> forced_response(const RitzPairs& modes, const ModalDamping& damping,
                                   const Vector& output, std::complex<Real> sigma) {
  const ComplexVector undamped =
      sigma * sigma * modes.mass.cast<Complex>() + modes.stiffness.cast<Complex>();
  if (!damping.is_diagonal) {
    ComplexMatrix dynamic = sigma * damping.whole().cast<Complex>();
    dynamic.diagonal() += undamped;
    const ComplexVector torque = damping.hub_rotation.cast<Complex>();
    const ComplexVector motion = Eigen::PartialPivLU<ComplexMatrix>(dynamic).solve(torque);
    return output.cast<Complex>().cwiseProduct(motion).sum();
  }
  Complex hub = 0;
  Complex shown = 0;
  for (Eigen::Index k = 0; k < undamped.size(); ++k) {
    const Complex per_torque =
        damping.hub_rotation(k) / (undamped(k) + sigma * damping.of_beam(k, k));
    hub += damping.hub_rotation(k) * per_torque;
    shown += output(k) * per_torque;
  }
  return shown / (Real{1} + damping.hub_friction * sigma * hub);
}

}  // namespace flexarm::assumed_modes
