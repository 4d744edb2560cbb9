#pragma once

#include "response/time/kalman_filter.hpp"
#include "response/time/lifted_block.hpp"

#include <Eigen/Core>

#include <optional>

namespace flexarm::response {

/// The Kalman filter of a linear arm for blocks of samples. With H, D and y0 of what is read at a
/// sample (readings of IntervalMap) and A, B and c of what its interval does,
///
///     e = y - H x - D u - y0,   x+ = x + K e,   x of the next sample = A x+ + B u + c
///
/// is a linear system itself, its inputs the torques u and the readings y.
class LiftedFilter {
 public:
  /// `interval` is of sensors without delay. Of a white disturbance `forgotten` is its row of X: it
  /// is 0 again at each sample. `shown` has a row for each combination of x+ that is of interest.
  LiftedFilter(const IntervalMap& interval, std::optional<Eigen::Index> forgotten,
               const Eigen::MatrixXd& shown);

  /// From rest: the innovations of all samples, a row each, and behind these `shown` x+. `torques`
  /// as TorquePath::whole_parts from sample 0 on, `measured` a row a sample and a column a sensor,
  /// none of which is missing.
  Eigen::MatrixXd follow(const Eigen::MatrixXd& torques, const Eigen::MatrixXd& measured,
                         const FilterGains& gains) const;

 private:
  /// The system above with this gain.
  IntervalMap closed_by(const FilterGain& filter) const;

  /// Products with the readings grow with it, those with the state fall.
  static constexpr Eigen::Index kSamples = 8;

  IntervalMap interval_;
  Eigen::MatrixXd shown_;
};

}  // namespace flexarm::response
