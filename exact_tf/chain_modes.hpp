#pragma once

#include "exact_tf/transfer_chain.hpp"

#include <optional>
#include <span>
#include <vector>

namespace flexarm::exact_tf {

/// How hub and rotor turn; as one where the drive is rigid.
template <class R>
struct HubMotion {
  R angle = 0;        ///< theta
  R motor_angle = 0;  ///< theta_m
};

/// How a mass on the beam moves, and how far it is from its place on it.
template <class R>
struct CarriedMotion {
  R displacement = 0;
  R extension = 0;
};

/// Modes of the undamped arm in units of the beam, scaled to the modal mass I_T/(m l^3) and a
/// positive angle of the rotor.
///
/// A mode's state at x is that of the plane of the tip's states at which the root's functional
/// vanishes (exact_tf/transfer_chain.hpp); within a segment it is the series from the segment's
/// right end. Integrals over the beam are Gauss's of 15 points a segment, which are exact to
/// rounding for products of two states: with K h <= 3 their error is that of exp(6 u) on [0, 1],
/// below 1e-26.
template <class R>
class ChainModes {
 public:
  /// `omega_squared` ascending, eigenvalues of the arm; 0 stands for the rigid-body mode of an arm
  /// that turns freely.
  ChainModes(const ArmInBeamUnits<R>& arm, std::span<const R> omega_squared);

  std::size_t size() const { return modes_.size(); }
  R hub_angle(std::size_t mode) const { return modes_[mode].hub.angle; }
  R motor_angle(std::size_t mode) const { return modes_[mode].hub.motor_angle; }
  R tip_displacement(std::size_t mode) const;
  R displacement(std::size_t mode, R x) const;
  R curvature(std::size_t mode, R x) const;  ///< psi' = M

  /// D_ij of arm::ModalModel over omega_scale.
  R damping(std::size_t i, std::size_t j) const;

 private:
  struct Mode {
    HubMotion<R> hub;
    R root_turn = 0;                       ///< psi(0) - theta
    R scale = 1;                           ///< of `series`; of all else it is applied
    std::vector<SegmentSeries<R>> series;  ///< one a segment, from the tip to the root
    BeamState<R> tip{};
    std::vector<CarriedMotion<R>> carried;
    std::vector<R> displacements;  ///< here and below at the points of the integrals
    std::vector<R> rotations;
    std::vector<R> moments;
  };

  Mode rigid_body_mode() const;
  Mode mode_at(R omega_squared) const;
  /// Of the mass k, from the states on both its sides.
  CarriedMotion<R> motion_of(const TransferChain<R>& chain, std::size_t k,
                             const BeamState<R>& at_right, const BeamState<R>& at_left) const;
  void sample(Mode& mode) const;
  void normalise(Mode& mode) const;
  BeamState<R> state(std::size_t mode, R x) const;
  R integral(const std::vector<R>& a, const std::vector<R>& b) const;

  const ArmInBeamUnits<R>& arm_;
  BeamAtFrequency<R> highest_;
  std::vector<Segment<R>> segments_;  ///< from the tip to the root
  std::vector<Mode> modes_;
};

}  // namespace flexarm::exact_tf
