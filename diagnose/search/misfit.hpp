#pragma once

#include "diagnose/observations.hpp"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace flexarm::diagnose {

/// What a stochastic grey-box model leaves of `time` runs to the disturbance of the hub torque.
struct DisturbanceLeft {
  double deviation_N_m = 0.0;   ///< most likely one, the rest of the noise model as it is
  double torque_rms_N_m = 0.0;  ///< of the commanded torque, above 0
  /// Root mean square of the filter's estimates of it, with the noise model as it is. Most of it
  /// may be slow, while the likelihood goes by what is fast: the deviation says little of it.
  double estimated_N_m = 0.0;
  double minus_two_log_likelihood = 0.0;  ///< with that deviation, without n ln 2 pi

  /// To the commanded torque: the deviation, and the estimates.
  double relative() const { return deviation_N_m / torque_rms_N_m; }
  double estimated_relative() const { return estimated_N_m / torque_rms_N_m; }
};
/// A relative deviation of this or less is nothing beside the torque.
inline constexpr double kNegligibleDisturbance = 0.01;

/// What residuals say of the runs that they are of.
struct Misfit {
  double count = 0.0;           ///< numbers in these runs
  double sum_of_squares = 0.0;  ///< of residuals in standard deviations of the noise
  /// Part of `count` that is independent (`independent`); in frequency and modal data all are.
  double independent = 0.0;
  /// Root mean square over the channels' root mean square of the signal, mean of the channels: the
  /// relative error, and that which the noise alone would make.
  double relative_error = 0.0;
  double noise_floor = 0.0;
  double numerical_error = 0.0;  ///< of the simulation, in the same measure
  double simulated = 0.0;        ///< part of the channels that are of `time` runs

  /// Uncertain numbers of the arm, and the squares of what they are off, in standard deviations.
  double nuisances = 0.0;
  double nuisance_squares = 0.0;

  /// Of a stochastic grey-box model. The residuals are then innovations of a scale that is free,
  /// and what is left is the disturbance.
  std::optional<DisturbanceLeft> disturbance = {};

  /// With noise of the recorded torques for the disturbance: squares of a simulation's errors, in
  /// units of what it is expected to err by, beyond kMostExpected of them in a channel. A filter
  /// follows what acts slowly, so that its residuals do not show it.
  double simulation_excess = 0.0;

  /// Squares beyond those of the noise, whose level is known to `kNoiseKnown` of its power, and
  /// beyond what chance adds to so many of them, `kChance` standard deviations sqrt(2 n); of
  /// nuisances those beyond chance; and those of the simulation. With a disturbance that is not
  /// negligible the mean square of its estimates, in units of the negligible variance.
  double excess() const;
  double nuisance_excess() const;
  bool is_noise() const { return excess() == 0.0; }
  /// Mean square of the residuals, never below that of the noise where this is known; and what it
  /// amounts to in the variance of an estimate, by the independent numbers among them.
  double variance() const;
  double variance_of_estimates() const;
  /// What is not noise, relative to the signal; the disturbance relative to the torque.
  double unexplained_error() const;
  /// Up to a constant: that of the disturbance, else the sum of squares with those of the
  /// simulation.
  double minus_two_log_likelihood() const;
};
/// Part of its power to which the level of a channel's noise is known.
inline constexpr double kNoiseKnown = 0.1;
/// Squares of 4 standard deviations: what errors of a torque add up to in a run is about one normal
/// number.
inline constexpr double kMostExpected = 16.0;
inline constexpr double kChance = 2.5;  ///< 0.6 % of normal numbers are beyond it

/// `runs` as in Problem::residuals.
Misfit misfit(const Observations& observations, const Experiment& experiment,
              const Eigen::VectorXd& residuals, const std::vector<bool>& runs);

/// Relative error of one channel, root mean square over root mean square of the signal; of modal
/// and frequency data each number counts relative to itself.
double relative_error(const Observations& observations, const Experiment& experiment,
                      const ObservedChannel& channel, const Eigen::VectorXd& residuals);

/// Numbers among the n residuals of a channel of a `time` run that are independent: the less of
///
///     n (1 - r_1)/(1 + r_1)                by the correlation of neighbours,
///     n / (1 + 2 (r_1 + r_2 + ... + r_m))  by all up to a lag m, about the mean,
///
/// m being where the sum of two neighbours is no longer above 0: the initial positive sequence of
/// [Geyer1992]. The first counts a vibration, the second what stays for long beside fast parts.
double independent(const Eigen::Ref<const Eigen::VectorXd>& residuals, measured::RunKind kind);

/// Sum of squares of residuals, in standard deviations of the noise, beyond noise; at least its
/// standard deviation by chance.
double beyond_noise(const Eigen::VectorXd& residuals);

/// Part of what is beyond noise before that is not after; 0 without anything beyond noise before,
/// or where what is left cannot be computed.
double share_taken(const Misfit& before, const Misfit& after);

/// How much better `fuller` explains the estimation data than `simpler`, in units of the Bayesian
/// information criterion: the scale of the residuals, never below the noise, is that of either
/// model, and the count of independent numbers that of `fuller`,
///
///     n ln(s_simpler^2/s_fuller^2) + d_simpler^2 - d_fuller^2 - k ln n
///
/// d^2 being the squares of nuisances, for k parameters more; with a disturbance the difference of
/// -2 ln L in the place of the first term, times the part of the numbers that is independent. Above
/// 10 is decisive (Kass & Raftery 1995).
double information_gain(const Misfit& simpler, const Misfit& fuller, int more_parameters);

}  // namespace flexarm::diagnose
