#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace flexarm::response {

/// A linear system at its samples,
///
///     x_(k+1) = F x_k + w_k,   y_k = H x_k + v_k,
///
/// with white w and v, independent of each other.
struct SampledSystem {
  Eigen::MatrixXd transition;          ///< F, N x N
  Eigen::MatrixXd readings;            ///< H, p x N
  Eigen::MatrixXd process_covariance;  ///< of w, N x N
  Eigen::VectorXd reading_variances;   ///< of v, p, each above 0

  bool operator==(const SampledSystem& other) const;
};

/// The Kalman filter of a system at one sample. Its innovation e moves the state at that sample by
/// gain e.
struct FilterGain {
  Eigen::MatrixXd gain;                   ///< N x p
  Eigen::MatrixXd innovation_covariance;  ///< p x p
};

/// The filter of a run: its first samples one by one, and all others.
struct FilterGains {
  std::vector<FilterGain> first = {};
  FilterGain steady;

  const FilterGain& at(std::size_t sample) const {
    return sample < first.size() ? first[sample] : steady;
  }
};

/// Covariance of the state, N x N, a sample after it is `covariance` and without readings.
Eigen::MatrixXd covariance_after_step(const SampledSystem& system,
                                      const Eigen::MatrixXd& covariance);

/// The filter long after the first sample. By the structure-preserving doubling algorithm
/// [ChuFanLin2004] for the Riccati equation of the predicted covariance, from an exactly known
/// state: `kDoublings` of them are 2^kDoublings samples. Ends before where the covariance no longer
/// changes by `kSteady` of it. What no reading shows need not be steady: its covariance grows and
/// does not enter the gain.
///
/// Throws InputError for variances that are not above 0, and where the covariance overflows.
FilterGain filter_gain(const SampledSystem& system);
inline constexpr int kDoublings = 16;
inline constexpr double kSteady = 1e-12;

/// From a state at the first sample that is known with this covariance, N x N, until the gain is
/// within `kSettled` of the steady one, relative to its size, or for `samples`.
FilterGains filter_gains_from(const SampledSystem& system,
                              const Eigen::MatrixXd& initial_covariance, std::size_t samples);
inline constexpr double kSettled = 1e-6;

}  // namespace flexarm::response
