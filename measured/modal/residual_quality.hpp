#pragma once

#include "measured/modal/variable_projection.hpp"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace flexarm::measured {

/// What a fit leaves of one sensor's readings.
struct ResidualQuality {
  double standard_deviation = 0.0;  ///< noise, in the sensor's unit; over the given deviation (FRF)
  double relative = 0.0;            ///< root mean square over the reading's about its mean
  /// [LjungBox1978], kWhitenessLags lags: the probability that white noise looks as coloured.
  double whiteness_probability = 1.0;
  /// F test of what kTorqueLags past torques explain of the residual, time only: the probability
  /// that noise alone lets them explain as much.
  double explained_probability = 1.0;
  double explained_share = 0.0;  ///< of the residual's sum of squares

  /// Noise as the fit takes it to be: white, and nothing left that the torque explains.
  bool is_noise() const {
    return whiteness_probability >= kSignificance && explained_probability >= kSignificance;
  }
  static constexpr double kSignificance = 1e-3;
};
inline constexpr int kWhitenessLags = 20;
inline constexpr int kTorqueLags = 30;

struct ResidualStudy {
  std::vector<ResidualQuality> sensors;
  /// Covariance of theta and then each sensor's shared beta, all of one vector, from sums of scores
  /// over kBatches stretches of the data: right for coloured noise whose memory is shorter than a
  /// batch, and for a model that leaves something unexplained ([White1980, NeweyWest1987]
  /// with batches for lags).
  Eigen::MatrixXd robust_covariance;
};
inline constexpr int kBatches = 40;

/// One more pass over the data.
ResidualStudy study_residuals(std::span<const Stretch> stretches, const BlockFit& fit);

/// The same covariance for white noise: of theta and each sensor's shared beta.
Eigen::MatrixXd joint_covariance(const BlockFit& fit);

}  // namespace flexarm::measured
