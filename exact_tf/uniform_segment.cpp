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
  constexpr Real kNegligible = 0.01L * std::numeric_limits<Real>::epsilon();
  const Real size =
      0.5L * std::abs(trace) + std::sqrt(0.25L * std::norm(trace) + std::abs(determinant));
  ExponentialWeights<T> weights;
  T p(0.0L);
  T r(1.0L);
  Real factorial = 0.5L;  // 1/(2m)!
  Real bound = 1.0L;      // of the terms from the first on
  for (int m = 1; bound > kNegligible; ++m) {
    const Real next = factorial / static_cast<Real>(2 * m + 1);
    weights.c0_less_one += factorial * p;
    weights.c2 += factorial * r;
    weights.c1_less_one += next * p;
    weights.c3 += next * r;
    const T r_next = p + trace * r;
    p = -determinant * r;
    r = r_next;
    factorial = next / static_cast<Real>(2 * m + 2);
    bound *= size / static_cast<Real>((2 * m - 1) * (2 * m));
  }
  return weights;
}

/// A v without its factor -h.
template <class T>
BeamState<T> derivative(const ArmInBeamUnits& arm, const BeamAtFrequency<T>& beam,
                        const BeamState<T>& v) {
  return {v[kRotation] + arm.shear_flexibility * v[kForce], beam.flexibility * v[kMoment],
          beam.rotary * v[kRotation] - v[kForce], beam.inertia * v[kDisplacement]};
}

}  // namespace

template <class T>
SegmentTransfer<T> uniform_transfer(const ArmInBeamUnits& arm, const BeamAtFrequency<T>& beam,
                                    Real length) {
  const Real square = length * length;
  const T shear = arm.shear_flexibility * beam.inertia;
  const T rotary = beam.rotary * beam.flexibility;
  const auto c =
      exponential_weights<T>(square * (shear + rotary),
                             square * square * (beam.inertia * beam.flexibility + shear * rotary));
  SegmentTransfer<T> transfer{};
  for (std::size_t j = 0; j < 4; ++j) {
    BeamState<T> unit{};
    unit[j] = T(1.0L);
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
    column[j] += T(1.0L);
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

template SegmentTransfer<Real> uniform_transfer(const ArmInBeamUnits&, const BeamAtFrequency<Real>&,
                                                Real);
template SegmentTransfer<Complex> uniform_transfer(const ArmInBeamUnits&,
                                                   const BeamAtFrequency<Complex>&, Real);

}  // namespace flexarm::exact_tf
