#pragma once

#include "measured/files/measurement.hpp"
#include "measured/modal/second_order_block.hpp"

#include <Eigen/Core>

namespace flexarm::measured {

/// Sampled response of a block and of its derivatives to a held torque u, exact:
///
///     x = (q, q', p, p'),   q = u/(s^2 + a1 s + a0),   p = u/(s^2 + a1 s + a0)^2,
///     x_(k+1) = Phi x_k + now u_k + next u_(k+1)
///
/// with Phi, now, next from one exponential of the 6 x 6 matrix of x, u and du/dt [VanLoan1978].
/// `next` is zero for a torque that is constant between samples. p is what derivatives take:
/// d(s^k q)/d a0 = -s^k p, d(s^k q)/d a1 = -s^(k+1) p.
class HeldResponse {
 public:
  HeldResponse(const SecondOrderBlock& block, double period_s, TorqueHold hold);

  /// x of the next sample.
  void step(Eigen::Vector4d& x, double torque, double next_torque) const {
    x = transition_ * x + now_ * torque + next_ * next_torque;
  }

 private:
  Eigen::Matrix4d transition_;
  Eigen::Vector4d now_;
  Eigen::Vector4d next_;
};

}  // namespace flexarm::measured
