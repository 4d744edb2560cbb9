#pragma once

#include "exact_tf/bivector.hpp"

namespace flexarm::exact_tf {

/// A mass on the beam at one frequency: how it changes the state on the way from its side towards
/// the tip to that towards the root. y and psi are continuous,
///
///     D M(X-) = D M(X+) + m_y y + m_psi psi,   D Q(X-) = D Q(X+) + q_y y + q_psi psi,
///
/// D = 1 + ck s/kk + mk s^2/kk of a suspended mass, 1 of a fixed one. All is taken times D, so that
/// nothing has a pole where the mass resonates: the roots of every function of the state include
/// those that the mass brings.
template <class T>
class CarriedMass {
 public:
  CarriedMass(const ArmInBeamUnits<RealOf<T>>& arm, const BeamAtFrequency<T>& beam,
              const typename ArmInBeamUnits<RealOf<T>>::Carried& mass);

  /// D.
  const T& resonance() const { return resonance_; }
  /// D u of the mass on a beam that moves by y and psi there.
  T extension(const BeamState<T>& state) const {
    return along_y_ * state[kDisplacement] + along_psi_ * state[kRotation];
  }
  /// D times the state on the side towards the root.
  BeamState<T> to_left(const BeamState<T>& at_right) const;
  /// D times the plane of states there: its second compound has no more than one factor 1/D.
  Bivector<T> to_left(const Bivector<T>& at_right) const;
  /// D times the functional on the side towards the tip.
  BeamState<T> to_right(const BeamState<T>& functional) const;

 private:
  T resonance_;
  T along_y_{};  ///< D u over y and psi
  T along_psi_{};
  T moment_y_{};  ///< m_y, m_psi, q_y, q_psi
  T moment_psi_{};
  T force_y_{};
  T force_psi_{};
  T both_{};  ///< (m_y q_psi - m_psi q_y)/D
};

extern template class CarriedMass<Real>;
extern template class CarriedMass<Complex>;
extern template class CarriedMass<double>;
extern template class CarriedMass<std::complex<double>>;

}  // namespace flexarm::exact_tf
