#pragma once

#include "measured/modal/fitted_transfer.hpp"

#include <Eigen/Core>

#include <complex>
#include <vector>

namespace flexarm::measured {

/// A finite zero of a fitted transfer function.
struct FittedZero {
  std::complex<double> s_rad_per_s;  ///< Im >= 0: one of each pair; real ones each
  double frequency_Hz = 0.0;         ///< |s|/(2 pi)
  double frequency_std_Hz = 0.0;     ///< infinite where the fit says nothing of it
  double damping_ratio = 0.0;        ///< -Re s/|s|
  double damping_ratio_std = 0.0;
  bool in_band = false;
  /// Two standard errors of the transfer function leave it in a disc of kTold of its distance from
  /// the nearest pole or other zero. One that they do not might be anywhere, or not be there, and
  /// errors to first order say nothing of it.
  bool is_told = false;

  bool operator==(const FittedZero&) const = default;
};

inline constexpr double kTold = 0.2;

/// Zeros of `transfer`, ascending in |s|, those at s = 0 and at infinity left out: finite
/// eigenvalues of the Rosenbrock pencil [A - sE, B; C, D] of the blocks (QZ), each then a root of
/// the transfer function itself (Newton). `covariance` is that of the transfer's parameters;
/// standard errors by dz = -(dG/d parameters)/(dG/ds) to first order.
std::vector<FittedZero> fitted_zeros(const FittedTransfer& transfer,
                                     const Eigen::MatrixXd& covariance, double from_Hz,
                                     double to_Hz);

}  // namespace flexarm::measured
