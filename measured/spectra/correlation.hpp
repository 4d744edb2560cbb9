#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace flexarm::measured {

/// Correlations of a residual e with itself and with the input u of the model, about their means,
/// each over the geometric mean of the two variances, so that they are from -1 to 1:
///
///     r_ee(k) = sum_t e(t) e(t - k)/sum_t e(t)^2,
///     r_eu(k) = sum_t e(t) u(t - k)/sqrt(sum_t e(t)^2 sum_t u(t)^2).
///
/// A residual of a right model is white and independent of the input [Ljung1999]. Then r_ee(k),
/// k != 0, has the variance 1/N and, for any spectrum of e and u,
///
///     var r_eu(k) = 1/N sum_j r_ee(j) r_uu(j).
///
/// At positive lags of r_eu the residual follows the input: dynamics that the model lacks. At
/// negative ones it is ahead of it: feedback.
struct ResidualCorrelation {
  std::vector<double> auto_lag;        ///< r_ee(k), k = 0 to the greatest lag
  std::vector<double> cross_lag = {};  ///< r_eu(k), k = -(the greatest lag) to it; empty without u
  double auto_bound = 0.0;  ///< of |r_ee|, which noise stays within with kCorrelationLevel at a lag
  double cross_bound = 0.0;  ///< of |r_eu|
  std::size_t samples = 0;   ///< N, numbers that are finite
  std::size_t greatest_lag = 0;

  /// Lags from 1 on, and all of r_eu, beyond their bounds.
  std::size_t auto_beyond() const;
  std::size_t cross_beyond() const;
};
inline constexpr double kCorrelationLevel = 0.99;

/// By Fourier transforms, work N log N. A sample of `residual` that is not finite counts as none.
/// `input` has as many values, or none. The greatest lag is `most_lag`, or N - 1 if that is less.
/// All numbers are 0 where the residual is constant or has no finite sample.
ResidualCorrelation residual_correlation(std::span<const double> residual,
                                         std::span<const double> input, std::size_t most_lag);

/// n (n + 2) sum_l rho_l^2/(n - l stride), l = 1 to `lags`, of lags of `stride` numbers each
/// [LjungBox1978]: of white noise a chi-squared variable of `lags` degrees of freedom. The
/// autocorrelation is about zero, not the mean: a constant residual is no noise. 0 of zeros.
double ljung_box(std::span<const double> residual, int lags, std::size_t stride = 1);

}  // namespace flexarm::measured
