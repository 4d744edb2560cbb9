#pragma once

#include "arm/formulation.hpp"
#include "assumed_modes/pencil_zeros.hpp"

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

namespace flexarm::assumed_modes {

/// A root of a discrete zero problem in the first quadrant, in units of the frequency scale.
struct CheckedRoot {
  std::complex<Real> s;
  double change = 0.0;  ///< largest relative distance to the nearest root with more functions
};

/// One root of each pair or quadruple, held against every member of `checks`.
std::vector<CheckedRoot> checked_roots(const PencilZeros& zeros,
                                       std::span<const PencilZeros> checks);

/// Sorts the roots of one discrete zero problem or several into zeros of the arm and rejected ones
/// by what more functions make of them. The problems are the same one in functions of different
/// rates of decay: each gives some zeros more accurately than the others do. A root s is trusted
/// when its change is `zero_change` or less; of the roots that stand for one zero that of least
/// change is kept.
class TrustedZeros {
 public:
  explicit TrustedZeros(double zero_change) : zero_change_(zero_change) {}

  /// The roots of a further problem. The first is that of functions that do not decay, whose
  /// rejected roots are reported.
  void add(const std::vector<CheckedRoot>& roots);
  /// The `count` first zeros are there to a relative change of `kSettled`, and no root between
  /// them is rejected without a zero beside it.
  bool are_settled(int count) const;
  /// The first `count` zeros, in units of `omega_scale_rad_per_s`, and all that were rejected.
  arm::ZeroSet zero_set(int count, double omega_scale_rad_per_s) const;

  static constexpr double kSettled = 1e-11;

 private:
  struct Root {
    CheckedRoot root;
    std::size_t problem;
  };
  bool is_explained(const CheckedRoot& rejected) const;

  double zero_change_;
  std::size_t problems_ = 0;
  std::vector<Root> trusted_;          ///< ascending in |s|
  std::vector<CheckedRoot> rejected_;  ///< of the first problem, ascending in |s|
};

}  // namespace flexarm::assumed_modes
