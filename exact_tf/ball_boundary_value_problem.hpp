#pragma once

// Private to exact_tf: the boundary-value problem in ball arithmetic. Not installed.

#include "arm/linear_arm.hpp"
#include "arm/sensor.hpp"
#include "exact_tf/ball.hpp"

#include <optional>

namespace flexarm::exact_tf::ball {

/// The arm without dimensions, formed in balls from its doubles, which count as exact:
/// lambda^4 = m l^4 omega^2/(EI), lengths in l, displacements in l.
struct DimensionlessArm {
  RealBall hub_inertia;      ///< Ih/(m l^3)
  RealBall payload_mass;     ///< Mp/(m l)
  RealBall payload_inertia;  ///< Ip/(m l^3)
  RealBall omega_scale;      ///< sqrt(EI/(m l^4)) [rad/s]

  explicit DimensionlessArm(const arm::LinearArm& arm);
};

/// What is zero at a root beside y(0), the tip's shear force and the tip's bending moment.
enum class LastRow { hub_torque, hub_angle, tip_displacement, tip_deflection, strain };

/// An entire function N(z), z = lambda^4, whose zeros are the roots of one root problem. N is real
/// for real z and, but for a real constant factor,
///
///     N(z) = determinant(lambda) lambda^(q - 1) e^((1 - i) lambda)/i,
///
/// with the determinant of the four boundary conditions in the basis e^(i lambda x),
/// e^(i lambda (1 - x)), e^(-lambda x), e^(-lambda (1 - x)), the row of the k-th derivative divided
/// by lambda^k; q is the power of lambda that the last row was divided by. In the sector
/// 0 <= arg lambda <= pi/4 the basis is bounded by 1, so that nothing overflows and no two large
/// terms cancel.
class RootFunction {
 public:
  /// `position` is X/l, used by LastRow::strain alone.
  RootFunction(const DimensionlessArm& arm, LastRow last_row,
               const RealBall& position = RealBall(0));

  ComplexBall determinant(const ComplexBall& lambda) const;

  /// N(lambda^4) but for a positive factor, for lambda = modulus (z > 0).
  RealBall on_positive_axis(const RealBall& modulus) const;
  /// N(lambda^4) but for a positive factor, for lambda = modulus e^(i pi/4) (z < 0).
  RealBall on_negative_axis(const RealBall& modulus) const;

  /// Zeros of N with 0 < |z| < modulus^4, conjugates counted, by the argument principle; empty
  /// where the working precision or `values_left` (see `argument_change`) leaves the number open.
  std::optional<long> count_within(const RealBall& modulus, long& values_left) const;

 private:
  RealBall on_axis(const RealBall& modulus, const ComplexBall& direction) const;
  /// q - 1 above.
  int power_of_lambda() const;
  /// Order of N's zero at z = 0: 1 where the rigid arm's y = x gives no output.
  int order_at_zero() const;

  DimensionlessArm arm_;
  LastRow last_row_;
  RealBall position_;
};

/// Numbers of eigenvalues below lambda; the poles' count includes the rigid-body mode.
struct EigenvalueCount {
  long hub_zeros = 0;
  long poles = 0;
};

/// The count of [WittrickWilliams1971] at the real `lambda` > 0, from
/// the beam's dynamic stiffness for slope and displacement at its ends: clamped-clamped eigenvalues
/// below lambda plus negative pivots. Empty where the working precision leaves a sign open.
std::optional<EigenvalueCount> wittrick_williams(const DimensionlessArm& arm,
                                                 const RealBall& lambda);

}  // namespace flexarm::exact_tf::ball
