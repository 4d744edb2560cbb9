#pragma once

#include "arm/arm.hpp"
#include "arm/sensor.hpp"

#include <complex>
#include <span>
#include <string>
#include <vector>

namespace flexarm::exact_tf {

struct CertificateOptions {
  /// A root counts as certified when |given - root| <= this many units in the last place of
  /// |lambda|.
  double max_distance_ulp = 4.0;
  /// Precision starts here and doubles until all signs are certain, precision <= the second.
  long precision_bits = 128;
  long max_precision_bits = 2048;
  /// The argument principle gives up after this many values of the numerator (some 10 us each). It
  /// needs a few hundred for each zero, but more where balls overestimate: for strain within some
  /// hundredths of the length from a tip without payload inertia.
  long max_function_values = 1'000'000;
};

/// A disc (an interval of its real diameter where the root is known to lie on an axis) that is
/// proved to hold exactly one root of the undamped boundary-value problem once the count is proved
/// too.
struct RootEnclosure {
  std::complex<double> lambda;  ///< midpoint; arg lambda in [0, pi/4], s = i lambda^2 omega_scale
  double radius = 0.0;          ///< in lambda, the rounding of the midpoint included
  double distance_ulp = 0.0;    ///< upper bound of |given - root| in ulp of |lambda|; infinity when
                                ///< no root was enclosed
  bool enclosed = false;
};

/// What was proved of a list of roots, by ball arithmetic (Arb) from the boundary-value problem.
struct Certificate {
  /// Every root is enclosed and within the distance allowed, the enclosures are disjoint, and the
  /// number of roots of modulus up to the last enclosure is the number given: none is missing.
  bool proved = false;
  std::string failure;  ///< the first reason why not; empty when proved
  int given = 0;        ///< roots in the list; a pair +-s or quadruple +-s, +-conj(s) is one
  /// Roots of the problem in z = lambda^4 up to the last enclosure, z = 0 left out; -1 when
  /// unknown. A quadruple counts twice, everything else once.
  long counted = -1;
  std::string method;
  std::vector<RootEnclosure> roots;  ///< one for each given, in the order given
  double largest_distance_ulp = 0.0;
  long precision_bits = 0;  ///< the highest used
};

/// Certifies that `lambdas` are the lowest flexible poles of the undamped arm, ascending, none left
/// out: lambda^4 = m l^4 omega^2/(EI). The doubles of arm::linear_arm(arm) count as exact numbers.
/// Roots are enclosed by a change of sign and counted by Wittrick and Williams's algorithm in
/// balls. Cost is linear in the number of roots. Throws arm::InputError for an invalid arm, and by
/// name for an effect that leaves an arm which is not plain, which it does not model.
Certificate certify_poles(const arm::Arm& arm, std::span<const double> lambdas,
                          const CertificateOptions& options = {});

/// The same for the zeros from torque to hub angle: the arm with its hub held.
Certificate certify_hub_zeros(const arm::Arm& arm, std::span<const double> lambdas,
                              const CertificateOptions& options = {});

/// Certifies that `s_rad_per_s` are the zeros of the undamped transfer function from torque to
/// `sensor` that are smallest in |s|, ascending, one of each pair or quadruple (Re >= 0, Im >= 0),
/// z = 0 and infinity left out. Zeros on the axes are enclosed by a change of sign, others by the
/// winding number of the numerator along a small circle; all are counted by its winding number
/// along |lambda| = const, on arcs whose image excludes zero. Cost is
/// linear in the number of zeros.
/// Throws arm::InputError as above, for a sensor that the arm cannot carry, and for strain at the
/// tip without payload inertia, which is zero at every s.
Certificate certify_zeros(const arm::Arm& arm, const arm::Sensor& sensor,
                          std::span<const std::complex<double>> s_rad_per_s,
                          const CertificateOptions& options = {});

}  // namespace flexarm::exact_tf
