#pragma once

#include <Eigen/Core>

#include <complex>
#include <vector>

namespace flexarm::fem {

/// q_tt + C q_t + Omega^2 q = 0 for m real coordinates: an arm in some of its undamped modes.
struct ModalVibration {
  Eigen::VectorXd omega_squared;  ///< m, ascending; only the first may be 0 or less
  Eigen::MatrixXd damping;        ///< C, m x m, symmetric
};

/// The two roots that a pair +-i omega becomes, `first` with Im > 0 or the nearer to 0, and the
/// complex modes q that belong to them, m each.
struct DampedPair {
  std::complex<double> first;
  std::complex<double> second;
  Eigen::VectorXcd first_shape;
  Eigen::VectorXcd second_shape;
};

struct ContinuedPairs {
  std::vector<DampedPair> pairs;  ///< m, in the order of `omega_squared`
  int steps = 0;
  bool certain = true;  ///< no step was taken whose roots could be told apart by distance only
};

/// Follows every pair from no damping to C. The damping t C grows in steps, t from 0 to 1; complex
/// roots are told by where their last two places point, real ones by their order, which no
/// continuous motion changes. A pair that meets on the real axis remains a pair. When real roots of
/// two pairs meet and leave the axis, the later pair takes them, and the earlier one the rest.
/// An omega^2 of exactly 0 has the root 0 at every t.
ContinuedPairs continue_damping(const ModalVibration& vibration);

}  // namespace flexarm::fem
