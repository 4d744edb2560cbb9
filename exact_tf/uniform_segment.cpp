#include "exact_tf/uniform_segment.hpp"

#include <cmath>
#include <limits>

namespace flexarm::exact_tf {

namespace {

/// c0 to c3, the first two less 1.
template <class T>
struct ExponentialWeights {
  T c0_less_one{};
  T c1_less_one{};
  T c2{};
  T c3{};
};

template <class T>
ExponentialWeights<T> exponential_weights(const T& trace, const T& determinant) {
  using R = RealOf<T>;
  constexpr R kNegligible = R(0.01) * std::numeric_limits<R>::epsilon();
  const R size =
      R(0.5) * std::abs(trace) + std::sqrt(R(0.25) * std::norm(trace) + std::abs(determinant));
  ExponentialWeights<T> weights;
  T p(0);
  T r(1);
  R factorial = R(0.5);  // 1/(2m)!
  R bound = R(1);        // of the terms from the first on
  for (int m = 1; bound > kNegligible; ++m) {
    const R next = factorial / static_cast<R>(2 * m + 1);
    weights.c0_less_one += factorial * p;
    weights.c2 += factorial * r;
    weights.c1_less_one += next * p;
    weights.c3 += next * r;
    const T r_next = p + trace * r;
    p = -determinant * r;
    r = r_next;
    factorial = next / static_cast<R>(2 * m + 2);
    bound *= size / static_cast<R>((2 * m - 1) * (2 * m));
  }
  return weights;
}

/// A v without its factor -h.
template <class T>
BeamState<T> derivative(const ArmInBeamUnits<RealOf<T>>& arm, const BeamAtFrequency<T>& beam,
                        const BeamState<T>& v) {
  return {v[kRotation] + arm.shear_flexibility * v[kForce], beam.flexibility * v[kMoment],
          beam.rotary * v[kRotation] - v[kForce], beam.inertia * v[kDisplacement]};
}

}  // namespace

template <class T>
SegmentTransfer<T> uniform_transfer(const ArmInBeamUnits<RealOf<T>>& arm,
                                    const BeamAtFrequency<T>& beam, RealOf<T> length) {
  using R = RealOf<T>;
  const R square = length * length;
  const T shear = arm.shear_flexibility * beam.inertia;
  const T rotary = beam.rotary * beam.flexibility;
  const auto c =
      exponential_weights<T>(square * (shear + rotary),
                             square * square * (beam.inertia * beam.flexibility + shear * rotary));
  SegmentTransfer<T> transfer{};
  for (std::size_t j = 0; j < 4; ++j) {
    BeamState<T> unit{};
    unit[j] = T(1);
    const auto once = derivative(arm, beam, unit);
    const auto twice = derivative(arm, beam, once);
    const auto thrice = derivative(arm, beam, twice);
    // Less the unit state and, of a rotation, less the displacement -h.
    BeamState<T> bending{};
    for (std::size_t i = 0; i < 4; ++i) {
      bending[i] =
          square * c.c2 * twice[i] - length * (c.c1_less_one * once[i] + square * c.c3 * thrice[i]);
    }
    bending[j] += c.c0_less_one;
    BeamState<T>& column = transfer.columns[j];
    column = bending;
    column[j] += T(1);
    for (std::size_t i = 0; i < 4; ++i) column[i] -= length * once[i];
    if (j > kRotation) continue;
    for (std::size_t i = 0; i < 4; ++i) {
      const bool rigid = j == kRotation && i == kDisplacement;
      if (!rigid) bending[i] -= length * once[i];
    }
    transfer.bending[j] = bending;
  }
  return transfer;
}

template SegmentTransfer<Real> uniform_transfer(const ArmInBeamUnits<Real>&,
                                                const BeamAtFrequency<Real>&, Real);
template SegmentTransfer<Complex> uniform_transfer(const ArmInBeamUnits<Real>&,
                                                   const BeamAtFrequency<Complex>&, Real);
template SegmentTransfer<double> uniform_transfer(const ArmInBeamUnits<double>&,
                                                  const BeamAtFrequency<double>&, double);
template SegmentTransfer<std::complex<double>> uniform_transfer(
    const ArmInBeamUnits<double>&, const BeamAtFrequency<std::complex<double>>&, double);

}  // namespace flexarm::exact_tf
