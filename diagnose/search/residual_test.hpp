#pragma once

#include "diagnose/observations.hpp"

#include <Eigen/Core>

#include <vector>

namespace flexarm::diagnose {

/// The test of the hypothesis that residuals are noise, and of its two parts.
///
/// Level. The power of the residuals over that of the noise, Q = sum r^2 of n numbers in standard
/// deviations of the noise. Under the hypothesis Q is at most
///
///     (1 + kNoiseKnown) chi^2_n(lambda),    lambda = sum_c n_c a_c,    a_c = (e/s_c)^2
///
/// chi^2_n(lambda) the noncentral chi-squared variable, s_c the noise of channel c over its signal
/// (of coloured noise the innovation) and e = `kSimulationError` the error over the signal that a
/// simulation in time is granted (0 for `frf` and `modal` runs). Tested for all channels of the
/// runs together, and for each channel by itself with twice that error.
///
/// Whiteness. The Ljung-Box statistic of each channel's first lags [LjungBox1978], of `time`
/// runs along time, of `frf` runs along the lines; its sum over the channels is at most a
/// noncentral chi-squared variable of as many degrees of freedom as lags, with
/// lambda = sum_c n_c lags_c (a_c/(1 + a_c))^2, the largest that the granted error makes.
struct ResidualTest {
  double level_p_value = 1.0;      ///< of all channels together or of the worst, after Bonferroni
  double whiteness_p_value = 1.0;  ///< 1 where no channel is a sequence
  double nuisance_p_value = 1.0;   ///< chi-squared of the arm's uncertain numbers

  bool is_noise() const;
};
/// The hypothesis is rejected below this, the family-wise level of the tests of one set of runs.
inline constexpr double kResidualLevel = 1e-3;
/// Of the signal, root mean square: what two converged simulations of one arm may differ by where
/// a torque steps within a sampling period.
inline constexpr double kSimulationError = 0.004;
/// An error of a `time` channel relative to its signal, squared, in variances of its residuals.
double residual_variance(const ObservedChannel& channel, double relative_error);
/// P(chi^2_n(lambda) > value) of the noncentral chi-squared variable.
double exceedance(double value, double n, double lambda);
/// A sum that is compared with a noncentral chi-squared variable.
struct ChiSquaredStatistic {
  double value = 0.0;
  double freedom = 0.0;
  double lambda = 0.0;

  /// 1 without degrees of freedom.
  double p_value() const { return freedom > 0.0 ? exceedance(value, freedom, lambda) : 1.0; }
};
/// Of the least p-value of so many tests.
double bonferroni(double p_value, double tests);
/// Lags of a channel <= this, and <= a quarter of its numbers.
inline constexpr int kLags = 25;

/// `residuals` in standard deviations of each number, the arm's nuisances behind them, as
/// Problem::residuals has them; tested are those of `runs`.
ResidualTest test_residuals(const Observations& observations, const Experiment& experiment,
                            const Eigen::VectorXd& residuals, const std::vector<bool>& runs);

}  // namespace flexarm::diagnose
