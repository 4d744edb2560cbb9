#pragma once

#include "response/arm_parts.hpp"
#include "response/time/reading_times.hpp"
#include "response/time/step_plan.hpp"
#include "response/time/torque_path.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <span>

namespace flexarm::response {

/// The readings of a linear arm for blocks of samples: the lifted system [Bamieh1991]. A
/// block is one product with the state X at its beginning and the torques of its parts, so that the
/// state is formed once a block, not at each sample.
class LiftedArm {
 public:
  /// `plan` is of a linear arm, with no ledger; `path` and `times` are those of any run of it.
  LiftedArm(const StepPlan& plan, const ArmParts& parts, std::span<const arm::Sensor> sensors,
            const TorquePath& path, const ReadingTimes& times);

  /// Writes to `made`, a row a sample and a column a sensor, what is read in the sample intervals
  /// from `first` on, which may be before 0, with the state `initial` at the beginning of that.
  /// Readings of no such interval stay as they are. `torques` as TorquePath::whole_parts.
  void read(const Eigen::MatrixXd& torques, std::ptrdiff_t first, const Eigen::VectorXd& initial,
            Eigen::MatrixXd& made) const;

 private:
  /// Samples of a block: products with the state and products with the torques then cost about as
  /// much.
  static constexpr Eigen::Index kSamples = 16;

  ReadingTimes times_;
  // Of a block, with (X; torques of all its samples, one sample after the other; 1): X at its end,
  Eigen::MatrixXd end_by_state_;
  Eigen::MatrixXd end_by_torques_;
  Eigen::VectorXd end_constant_;
  // and the readings of all its samples, one sensor after the other.
  Eigen::MatrixXd readings_by_state_;
  Eigen::MatrixXd readings_by_torques_;
  Eigen::VectorXd readings_constant_;
};

}  // namespace flexarm::response
