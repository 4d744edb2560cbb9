#pragma once

#include "diagnose/search/problem.hpp"

#include <Eigen/Core>

#include <vector>

namespace flexarm::diagnose {

/// The p-value of the hypothesis that the residuals of one sensor are independent of those of
/// another of the same run, as noise of sensors is: the residuals that a force on the arm leaves
/// are not. `residuals` are whitened (Problem::residuals), of `runs`. 1 where no run has two
/// sensors that are compared.
///
/// By the cross-correlations r_k of the residuals at lags within `kLags` [Haugh1976]: for each pair
///
///     n^2 sum_k r_k^2/(n - |k|)
///
/// is chi-squared with as many degrees of freedom as lags, and the sum over all pairs likewise; it
/// is noncentral with n a b for a pair, a and b the parts of the variances that errors of
/// kNegligibleDependence of the signal have: white, these are alike at one lag. Residuals are
/// compared without the slow part that cosines of up to `kSlowHalfPeriods` half periods a run have:
/// amplifiers that warm drift together.
///
/// Not compared are two sensors of the hub, and two of the tip, since one is often computed from
/// the other; nor the torque, which a controller makes of the noise of the sensors.
double independence_p_value(const Problem& problem, const Eigen::VectorXd& residuals,
                            const std::vector<bool>& runs);
inline constexpr int kSlowHalfPeriods = 9;

/// Whether a channel of a `time` run for estimation has more coloured noise than one sensor can
/// tell from a model error: more than `kMostOfOneSensor` times its white noise, and more than a
/// negligible dependence. So it is for channels whose independence of others is not tested: no
/// sensor of the run is at another place, or no recorded torque drives the arm. An autoregression
/// makes a smooth model error white too, and noise of a sensor has a white part not far below the
/// rest.
bool exceeds_noise_of_one_sensor(const Problem& coloured, const Problem& white);
/// White noise of 0.5 % beside noise of the first order of 3 % is a ratio of 6.
inline constexpr double kMostOfOneSensor = 10.0;

}  // namespace flexarm::diagnose
