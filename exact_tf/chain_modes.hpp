#pragma once

#include "exact_tf/transfer_chain.hpp"

#include <optional>
#include <span>
#include <vector>

namespace flexarm::exact_tf {

/// How hub and rotor turn; as one where the drive is rigid.
struct HubMotion {
  Real angle = 0.0L;        ///< theta
  Real motor_angle = 0.0L;  ///< theta_m
};

/// How a mass on the beam moves, and how far it is from its place on it.
struct CarriedMotion {
  Real displacement = 0.0L;
  Real extension = 0.0L;
};

/// Modes of the undamped arm in units of the beam, scaled to the modal mass I_T/(m l^3) and a
/// positive angle of the rotor.
///
/// A mode's state at x is that of the plane of the tip's states at which the root's functional
/// vanishes (exact_tf/transfer_chain.hpp); within a segment it is the series from the segment's
/// right end. Integrals over the beam are Gauss's of 15 points a segment, which are exact to
/// rounding for products of two states: with K h <= 3 their error is that of exp(6 u) on [0, 1],
/// below 1e-26.
class ChainModes {
 public:
  /// `omega_squared` ascending, eigenvalues of the arm; 0 stands for the rigid-body mode of an arm
  /// that turns freely.
  ChainModes(const ArmInBeamUnits& arm, std::span<const Real> omega_squared);

  std::size_t size() const { return modes_.size(); }
  Real hub_angle(std::size_t mode) const { return modes_[mode].hub.angle; }
  Real motor_angle(std::size_t mode) const { return modes_[mode].hub.motor_angle; }
  Real tip_displacement(std::size_t mode) const;
  Real displacement(std::size_t mode, Real x) const;
  Real curvature(std::size_t mode, Real x) const;  ///< psi' = M

  /// D_ij of arm::ModalModel over omega_scale.
  Real damping(std::size_t i, std::size_t j) const;

 private:
  struct Mode {
    HubMotion hub;
    Real root_turn = 0.0L;                    ///< psi(0) - theta
    Real scale = 1.0L;                        ///< of `series`; of all else it is applied
    std::vector<SegmentSeries<Real>> series;  ///< one a segment, from the tip to the root
    BeamState<Real> tip{};
    std::vector<CarriedMotion> carried;
    std::vector<Real> displacements;  ///< here and below at the points of the integrals
    std::vector<Real> rotations;
    std::vector<Real> moments;
  };

  Mode rigid_body_mode() const;
  Mode mode_at(Real omega_squared) const;
  /// Of the mass k, from the states on both its sides.
  CarriedMotion motion_of(const TransferChain<Real>& chain, std::size_t k,
                          const BeamState<Real>& at_right, const BeamState<Real>& at_left) const;
  void sample(Mode& mode) const;
  void normalise(Mode& mode) const;
  BeamState<Real> state(std::size_t mode, Real x) const;
  Real integral(const std::vector<Real>& a, const std::vector<Real>& b) const;

  const ArmInBeamUnits& arm_;
  BeamAtFrequency<Real> highest_;
  std::vector<Segment> segments_;  ///< from the tip to the root
  std::vector<Mode> modes_;
};

}  // namespace flexarm::exact_tf
