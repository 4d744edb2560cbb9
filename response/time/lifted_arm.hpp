#pragma once

#include "response/time/lifted_block.hpp"

#include <Eigen/Core>

#include <cstddef>

namespace flexarm::response {

/// The readings of a linear arm for blocks of samples.
class LiftedArm {
 public:
  /// `interval` is of a linear arm whose sensors are read at `times`.
  LiftedArm(const IntervalMap& interval, const ReadingTimes& times)
      : times_(times), block_(lifted_block(interval, kSamples)) {}

  /// Writes to `made`, a row a sample and a column a sensor, what is read in the sample intervals
  /// from `first` on, which may be before 0, with the state `initial` at the beginning of that.
  /// Readings of no such interval stay as they are. `torques` as TorquePath::whole_parts.
  void read(const Eigen::MatrixXd& torques, std::ptrdiff_t first, const Eigen::VectorXd& initial,
            Eigen::MatrixXd& made) const;

 private:
  /// Products with the state and products with the torques then cost about as much.
  static constexpr Eigen::Index kSamples = 16;

  ReadingTimes times_;
  LiftedBlock block_;
};

}  // namespace flexarm::response
