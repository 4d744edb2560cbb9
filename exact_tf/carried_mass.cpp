#include "exact_tf/carried_mass.hpp"

namespace flexarm::exact_tf {

template <class T>
CarriedMass<T>::CarriedMass(const ArmInBeamUnits<RealOf<T>>& arm, const BeamAtFrequency<T>& beam,
                            const typename ArmInBeamUnits<RealOf<T>>::Carried& mass)
    : resonance_(T(1)) {
  using R = RealOf<T>;
  if (!mass.is_suspended()) {
    force_y_ = -mass.mass * beam.square;
    return;
  }
  const R inverse = R(1) / mass.omega_squared;
  const T damped = R(1) + inverse * mass.damping * beam.decay;
  resonance_ = damped + inverse * beam.square;
  along_y_ = -inverse * beam.square;
  along_psi_ = T(-inverse * arm.gravity);
  // m_y y + m_psi psi = -g mk D u, q_y y + q_psi psi = -mk s^2 (D y + D u).
  const R weight = arm.gravity * mass.mass;
  moment_y_ = -weight * along_y_;
  moment_psi_ = -weight * along_psi_;
  force_y_ = -mass.mass * beam.square * damped;
  force_psi_ = -mass.mass * beam.square * along_psi_;
  both_ = inverse * weight * weight * beam.square;
}

template <class T>
BeamState<T> CarriedMass<T>::to_left(const BeamState<T>& at_right) const {
  const T& y = at_right[kDisplacement];
  const T& psi = at_right[kRotation];
  return {resonance_ * y, resonance_ * psi,
          resonance_ * at_right[kMoment] + moment_y_ * y + moment_psi_ * psi,
          resonance_ * at_right[kForce] + force_y_ * y + force_psi_ * psi};
}

template <class T>
Bivector<T> CarriedMass<T>::to_left(const Bivector<T>& at_right) const {
  const auto& [y_psi, y_moment, y_force, psi_moment, psi_force, moment_force] = at_right.minors;
  return {{resonance_ * y_psi, resonance_ * y_moment + moment_psi_ * y_psi,
           resonance_ * y_force + force_psi_ * y_psi, resonance_ * psi_moment - moment_y_ * y_psi,
           resonance_ * psi_force - force_y_ * y_psi,
           resonance_ * moment_force + moment_y_ * y_force + moment_psi_ * psi_force -
               force_y_ * y_moment - force_psi_ * psi_moment + both_ * y_psi}};
}

template <class T>
BeamState<T> CarriedMass<T>::to_right(const BeamState<T>& functional) const {
  const T& moment = functional[kMoment];
  const T& force = functional[kForce];
  return {resonance_ * functional[kDisplacement] + moment_y_ * moment + force_y_ * force,
          resonance_ * functional[kRotation] + moment_psi_ * moment + force_psi_ * force,
          resonance_ * moment, resonance_ * force};
}

template class CarriedMass<Real>;
template class CarriedMass<Complex>;
template class CarriedMass<double>;
template class CarriedMass<std::complex<double>>;

}  // namespace flexarm::exact_tf
