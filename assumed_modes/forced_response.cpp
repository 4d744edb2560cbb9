#include "assumed_modes/forced_response.hpp"

#include <Eigen/LU>

#include <cmath>
#include <limits>

namespace flexarm::assumed_modes {

namespace {

using Complex = std::complex<Real>;
using ComplexVector = Eigen::Matrix<Complex, Eigen::Dynamic, 1>;
using ComplexMatrix = Eigen::Matrix<Complex, Eigen::Dynamic, Eigen::Dynamic>;

/// The solution of (diag(undamped) + sigma damping) x = right.
ComplexVector dense_solution(const ComplexVector& undamped, const Matrix& damping, Complex sigma,
                             const Vector& right) {
  ComplexMatrix dynamic = sigma * damping.cast<Complex>();
  dynamic.diagonal() += undamped;
  const Eigen::PartialPivLU<Eigen::MatrixXcd> factors(dynamic.cast<std::complex<double>>());

  constexpr Real kEnough = 4 * std::numeric_limits<Real>::epsilon();
  constexpr Real kConverging = 0.1L;
  ComplexVector solution = ComplexVector::Zero(right.size());
  ComplexVector residual = right.cast<Complex>();
  Real former = std::numeric_limits<Real>::infinity();
  while (true) {
    const ComplexVector correction =
        factors.solve(residual.cast<std::complex<double>>()).cast<Complex>();
    const Real size = correction.norm();
    // At a pole double precision has no digit to begin with.
    if (!(size <= kConverging * former)) break;
    solution += correction;
    if (size <= kEnough * solution.norm()) return solution;
    former = size;
    residual = right.cast<Complex>() - undamped.cwiseProduct(solution);
    residual.real() -=
        (sigma.real() * (damping * solution.real()) - sigma.imag() * (damping * solution.imag()));
    residual.imag() -=
        (sigma.real() * (damping * solution.imag()) + sigma.imag() * (damping * solution.real()));
  }
  // What is left is rounding, or the matrix is nearly singular.
  if (former <= std::sqrt(kEnough) * solution.norm()) return solution;
  return Eigen::PartialPivLU<ComplexMatrix>(dynamic).solve(right.cast<Complex>());
}

}  // namespace

std::complex<Real> forced_response(const RitzPairs& modes, const ModalDamping& damping,
                                   const Vector& output, std::complex<Real> sigma) {
  const ComplexVector undamped =
      sigma * sigma * modes.mass.cast<Complex>() + modes.stiffness.cast<Complex>();
  if (damping.diagonal.size() == 0) {
    const ComplexVector motion =
        dense_solution(undamped, damping.whole, sigma, damping.hub_rotation);
    return output.cast<Complex>().cwiseProduct(motion).sum();
  }
  Complex hub = 0;
  Complex shown = 0;
  for (Eigen::Index k = 0; k < undamped.size(); ++k) {
    const Complex per_torque =
        damping.hub_rotation(k) / (undamped(k) + sigma * damping.diagonal(k));
    hub += damping.hub_rotation(k) * per_torque;
    shown += output(k) * per_torque;
  }
  return shown / (Real{1} + damping.hub_friction * sigma * hub);
}

}  // namespace flexarm::assumed_modes
